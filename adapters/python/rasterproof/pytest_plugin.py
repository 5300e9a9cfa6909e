"""The fixture `rasterproof` of pytest, whose cases and seed the command line chooses."""

from __future__ import annotations

import pytest

from . import Judge


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("rasterproof")
    group.addoption("--rasterproof-cases", type=int, default=100, metavar="N", help="cases of each family")
    group.addoption("--rasterproof-seed", type=int, default=1, metavar="N", help="decides every generated case")


@pytest.fixture
def rasterproof(request: pytest.FixtureRequest) -> Judge:
    """The four functions with the cases and the seed of the command line."""
    option = request.config.getoption
    return Judge(cases=option("--rasterproof-cases"), seed=option("--rasterproof-seed"))
