"""Starts the judge and answers what it asks, in batches."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sysconfig
import tempfile
from contextlib import suppress
from typing import Any, Callable, List, Mapping, NamedTuple, Optional, Tuple

from ._shapes import Judged

__tracebackhide__ = True


class Kind(NamedTuple):
    """What one of the functions judges: the letters of request and answer, what it declares, and a first request."""

    call: str
    verb: str
    reply: str
    capability: str
    # From the words of requests, without verb and id, to answers; nothing for a request that is not taken.
    ask: Callable[[Judged, List[List[str]]], List[Optional[str]]]
    probe: str


def program() -> str:
    """The program of this wheel, or the one that RASTERPROOF names."""
    name = "rasterproof.exe" if os.name == "nt" else "rasterproof"
    places = [sysconfig.get_path("scripts"), sysconfig.get_path("scripts", f"{os.name}_user")]
    found = os.environ.get("RASTERPROOF") or next((p for d in places if (p := shutil.which(name, path=d))), None)
    found = found or shutil.which(name)
    if found is None:
        raise RuntimeError("the program rasterproof is not installed: install the wheel again, or name it in RASTERPROOF")
    return found


def judge(kind: Kind, fn: Callable[..., Any], options: Mapping[str, Any]) -> None:
    if not callable(fn):
        raise TypeError(f"{kind.call} takes a function; got {type(fn).__name__}")
    judged = Judged(fn)
    header = ["language python", f"call rasterproof.{kind.call}({judged.name}"]
    for option, value in {"cases": 100, **options}.items():
        values = value if isinstance(value, (list, tuple)) else [value]
        header += [" ".join([option, *str(one).split()]) for one in values if one is not None]
    # What it returns for one case, in a window that is no square, says what can be seen in its answers.
    kind.ask(judged, [kind.probe.split()])
    words = " mask" * (judged.kind == "masks of bool") + " line-set" * (kind.capability == "line" and "masks" in judged.kind)
    name = re.sub(r"[^!-~]+", "-", judged.name) or "function"

    def answers(requests: List[List[str]]) -> str:
        texts = iter(kind.ask(judged, [words[2:] for words in requests if words[0] == kind.verb]))
        replies = ((id, next(texts) if asked == kind.verb else None) for asked, id, *_ in requests)
        return "".join(f"E {id} unsupported\n" if text is None else f"{kind.reply} {id} {text}\n" for id, text in replies)

    status, said = run("\n".join([*header, f"HELLO 2 {name} {kind.capability} batch=1024{words}\n"]), answers)
    if status == 1:
        raise AssertionError(said)
    if status == 2:
        raise ValueError(said)
    if status:
        raise RuntimeError(f"rasterproof gave no verdict (exit status {status}):\n{said}")


def run(header: str, answers: Callable[[List[List[str]]], str]) -> Tuple[int, str]:
    """The exit status of the judge, and what it said."""
    pipe, requests = subprocess.PIPE, []
    with tempfile.TemporaryFile() as said:
        # Where the judge ends too early, its status says so.
        with suppress(BrokenPipeError), subprocess.Popen([program(), "hosted-judge"], stdin=pipe, stdout=pipe, stderr=said) as started:
            assert started.stdin and started.stdout
            try:
                started.stdin.write(header.encode())
                started.stdin.flush()
                for line in started.stdout:
                    if words := line.decode().split():
                        requests.append(words)
                        continue
                    # An empty line ends what is sent at once.
                    started.stdin.write(answers(requests).encode())
                    started.stdin.flush()
                    requests.clear()
            except BaseException:
                started.kill()
                raise
        said.seek(0)
        return started.returncode, said.read().decode("utf-8", "replace").strip()
