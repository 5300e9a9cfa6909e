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
    options = {"cases": 50, **options}
    hits = options.pop("hits", False)
    if not isinstance(hits, bool):
        raise ValueError(f"hits is {hits!r}; expected True or False")
    judged = Judged(fn, hits)
    header = ["language python", f"call rasterproof.{kind.call}({judged.name}"]
    if hits:
        options["hits"] = True
    for option, value in options.items():
        values = value if isinstance(value, (list, tuple)) else [value]
        header += [" ".join([option, *str(one).split()]) for one in values if one is not None]
    # What it returns for one case, in a window that is no square, says what can be seen in its answers.
    try:
        kind.ask(judged, [kind.probe.split()])
    except Exception as error:
        if judged.raised:
            note(error, f"rasterproof asked: {described(kind, kind.probe.split())}, the first request, which is no generated case")
        raise
    words = " mask" * (judged.kind == "masks of bool") + " line-set" * (kind.capability == "line" and "masks" in judged.kind)
    name = re.sub(r"[^!-~]+", "-", judged.name) or "function"

    def answers(requests: List[List[str]]) -> str:
        mine = [words[2:] for words in requests if words[0] == kind.verb]
        try:
            texts = iter(kind.ask(judged, mine))
        except Exception as error:
            if judged.raised:
                explain(error, kind, judged, mine, [*header, hello])
            raise
        replies = ((id, next(texts) if asked == kind.verb else None) for asked, id, *_ in requests)
        return "".join(reply(id, text) for id, text in replies)

    def reply(id: str, text: Optional[str]) -> str:
        if text is None:
            return f"E {id} unsupported\n"
        # Runs with their hits have a letter of their own.
        return f"H {id} {text[1:]}\n" if text[0] == "H" else f"{kind.reply} {id} {text}\n"

    hello = f"HELLO 2 {name} {kind.capability} batch=1024{words}\n"
    status, said = run("\n".join([*header, hello]), answers)
    if status == 1:
        raise AssertionError(said)
    if status == 2:
        raise ValueError(said)
    if status:
        raise RuntimeError(f"rasterproof gave no verdict (exit status {status}):\n{said}")


def note(error: BaseException, text: str) -> None:
    """Adds lines that a traceback shows below the exception; before Python 3.11 nothing shows them."""
    if hasattr(error, "add_note"):
        error.add_note(text)


def described(kind: Kind, words: List[str]) -> str:
    """The corners of a request, as Python writes them."""
    if kind.verb == "Y":
        return f"contours {' '.join(words)}"
    wide = {"T": 2, "L": 2, "I": 6}[kind.verb]
    numbers = [float(word) for word in words[2:]]
    corners = [numbers[i : i + wide] for i in range(0, len(numbers), wide)]
    return f"corners {corners}, window ({words[0]}, {words[1]})"


def explain(error: BaseException, kind: Kind, judged: Judged, requests: List[List[str]], header: List[str]) -> None:
    """Adds to an exception of the function the case for which it is raised."""
    for words in requests:
        try:
            kind.ask(judged, [words])
        except Exception:
            if not judged.raised:
                continue
            # The judge looks up the case, and judges nothing.
            request = f"{kind.verb} 1 {' '.join(words)}"
            status, said = run("\n".join([*header[:-1], f"locate {request}", header[-1]]), lambda _: "")
            case = said if status == 0 else "a case that was not found"
            note(error, f"rasterproof asked: {described(kind, words)}\nfor {case}")
            return
    note(error, f"rasterproof asked {len(requests)} requests at once; for each alone it raises nothing. Try cases=1")


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
