"""The fixture `rasterproof` of pytest, whose cases and seed the command line or the ini file chooses."""

from __future__ import annotations

import pytest

from . import Judge


CHOICES = (("cases", 50, "cases of each family"), ("seed", 1, "decides every generated case"))


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("rasterproof")
    for name, default, text in CHOICES:
        group.addoption(f"--rasterproof-{name}", type=int, metavar="N", help=text)
        parser.addini(f"rasterproof_{name}", text, default=str(default))


@pytest.fixture
def rasterproof(request: pytest.FixtureRequest) -> Judge:
    """The four functions with the cases and the seed of the command line, or of the ini file where it names none."""
    chosen = {}
    for name, _, _ in CHOICES:
        given = request.config.getoption(f"--rasterproof-{name}")
        # The judge says what it expects of a number.
        chosen[name] = request.config.getini(f"rasterproof_{name}") if given is None else given
    return Judge(**{name: int(value) if str(value).isdecimal() else value for name, value in chosen.items()})
