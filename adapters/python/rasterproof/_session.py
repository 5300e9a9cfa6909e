"""Starts the judge and answers what it asks, in batches."""

from __future__ import annotations

import itertools
import os
import re
import secrets
import select
import shutil
import socket
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path
from typing import Any, Callable, Dict, Iterator, List, Optional, Sequence, Tuple

# The words of one request, without its id: its numbers, and its window.
Answer = Callable[[List[List[float]], Tuple[int, int]], List[Optional[str]]]

RELAY = Path(__file__).with_name("_relay.py")
PIECE = 1 << 18
# Pixels that are drawn by one call.
MOST_PIXELS = 1 << 24


def program() -> str:
    """The program of this wheel, or the one that RASTERPROOF names."""
    name = "rasterproof.exe" if os.name == "nt" else "rasterproof"
    places = [sysconfig.get_path("scripts"), sysconfig.get_path("scripts", f"{os.name}_user")]
    found = os.environ.get("RASTERPROOF") or next((p for d in places if (p := shutil.which(name, path=d))), None)
    found = found or shutil.which(name)
    if found is None:
        raise RuntimeError("the program rasterproof is not installed: install the wheel again, or name it in RASTERPROOF")
    return found


class Session:
    """One run of the judge."""

    def __init__(self, verb: str, capability: str, declares: str, name: str, answer: Answer) -> None:
        self.verb, self.answer = verb, answer
        name = re.sub(r"[^!-~]+", "-", name) or "function"
        self.hello = f"HELLO 2 {name} {capability} batch=1024 {declares}".strip()

    def judge(self, options: Sequence[str], timeout: float) -> Tuple[int, str, str]:
        """The judge's exit status, and what it wrote on its standard output and error."""
        token = secrets.token_hex(16)
        with socket.create_server(("127.0.0.1", 0)) as listener, tempfile.TemporaryFile() as said, tempfile.TemporaryFile() as wrong:
            relay = [sys.executable, "-S", "-E", str(RELAY), str(listener.getsockname()[1]), token]
            command = [program(), "judge", *options, "--timeout", str(timeout), "--", *relay]
            with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=said, stderr=wrong) as judge:
                try:
                    self.serve(listener, token, judge)
                finally:
                    judge.kill()
            texts = []
            for file in (said, wrong):
                file.seek(0)
                texts.append(file.read().decode("utf-8", "replace"))
        return judge.returncode, texts[0], texts[1]

    def serve(self, listener: socket.socket, token: str, judge: "subprocess.Popen[bytes]") -> None:
        """Answers each relay that the judge starts, until the judge has ended."""
        listener.settimeout(0.02)
        while judge.poll() is None:
            try:
                relay, _ = listener.accept()
            except socket.timeout:
                continue
            with relay:
                relay.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                try:
                    # Others on this machine could connect, too.
                    relay.settimeout(5)
                    blocks = requests(relay)
                    first = next(blocks, [])
                    if first[:1] != [token.encode()]:
                        continue
                    relay.settimeout(None)
                    for block in itertools.chain([first[1:]], blocks):
                        relay.sendall("".join(reply + "\n" for reply in self.answers(block)).encode())
                except (ConnectionError, socket.timeout):
                    # The judge has ended its relay.
                    continue

    def answers(self, block: List[bytes]) -> List[str]:
        """The answers to these requests, in order; those with one window are drawn together."""
        replies: List[Optional[str]] = [None] * len(block)
        groups: Dict[Tuple[int, int], List[int]] = {}
        words = [line.decode("latin-1").split() for line in block]
        for i, request in enumerate(words):
            if request[0] == self.verb == "Y":
                # A polygon has no window.
                reply = self.answer([[float(word) for word in request[2:]]], (0, 0))[0]
                replies[i] = f"E {request[1]} unsupported" if reply is None else f"Z {request[1]} {reply}"
            elif request[0] == self.verb:
                groups.setdefault((int(request[2]), int(request[3])), []).append(i)
            else:
                replies[i] = self.hello if request == ["HELLO", "2"] else f"E {request[1]} unsupported"
        for window, members in groups.items():
            most = max(1, MOST_PIXELS // (window[0] * window[1]))
            for first in range(0, len(members), most):
                part = members[first : first + most]
                numbers = [[float(word) for word in words[i][4:]] for i in part]
                for i, reply in zip(part, self.answer(numbers, window)):
                    replies[i] = f"{LETTERS[self.verb]} {words[i][1]} {reply}"
        return [reply or "E - unsupported" for reply in replies]


LETTERS = {"T": "C", "L": "P", "I": "F"}


def requests(relay: socket.socket) -> Iterator[List[bytes]]:
    """Blocks of whole lines, each as long as what has come in the meantime."""
    rest = b""
    while piece := relay.recv(PIECE):
        while len(piece) < PIECE and select.select([relay], [], [], 0)[0]:
            more = relay.recv(PIECE)
            piece += more
            if not more:
                break
        *lines, rest = (rest + piece).split(b"\n")
        if lines:
            yield lines


def run(session: Session, options: Dict[str, Any], call: str, timeout: float) -> None:
    """Judges, and raises what came of it."""
    # pytest shows the line of the test.
    __tracebackhide__ = True
    words: List[str] = []
    for option, value in options.items():
        for one in value if isinstance(value, (list, tuple)) else [value]:
            words += [f"--{option}", str(one)]
    status, said, wrong = session.judge(words, timeout)
    # The command would name the relay.
    pattern = re.compile(r"rasterproof judge ((?:--[^\n]*? )?)-- [^\n]*_relay\.py[^\n]*")
    said = pattern.sub(lambda found: call.format(arguments(found.group(1))), said)
    said = re.sub(r"--declare (.[^\n]*.)", r"declare=\1", said)
    if status == 1:
        raise AssertionError(said.strip())
    if status:
        raise RuntimeError(f"rasterproof gave no verdict (exit status {status}):\n{wrong.strip() or said.strip()}")


def arguments(words: str) -> str:
    """Options of the command as arguments of the function: '--case 3' as ', case=3'."""
    found = re.findall(r"--(cases|seed|case|family|declare) (?:'([^']*)'|(\S+))", words)
    values = ((name, quoted or word) for name, quoted, word in found)
    given: Dict[str, List[str]] = {}
    for name, value in values:
        given.setdefault(name, []).append(value if value.isdigit() else repr(value))
    # Of families there may be several.
    lists = ((name, all[0] if len(all) == 1 else f"[{', '.join(all)}]") for name, all in given.items())
    return "".join(f", {name}={value}" for name, value in lists)
