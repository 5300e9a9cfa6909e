"""What bounds a frame in tiles, and what fills cost beside each other: started by `benches/peers/run --limits [FILE]`.

Of each mesh it counts the instructions of a frame by valgrind, function by function as they were compiled into each other, and
the lines that a cache of 1 MB fetches. It compares the first with the most instructions that a loop of this machine reaches, and
the bytes that every renderer moves, the picture and the mesh, with a copy of much memory. Frames are timed in between, and the
fastest of 15 medians of 5 frames is taken, since others on the machine only add to it. Of each who fills antialiased in a process of
Rust it counts instructions for each triangle.

valgrind has no AVX-512, so all of it is with AVX2. Times need a machine that does nothing else.
"""

import json
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

PROGRAM = "target/release/rasterproof-peers"
COUNTS = "target/peers/callgrind.out"
MESHES = ["torus-2000", "bumps-4000", "knot-50000", "bumps-70000"]
CLASSES = ["medium", "tiny"]
FILLERS = ["4 x 4 samples", "exact area", "tiny-skia", "raqote", "vello_cpu", "zeno", "ab_glyph_rasterizer"]
SET, SIDE, ROUNDS = "AVX2", 1024, 15
CACHES = ["--cache-sim=yes", "--LL=1048576,16,64"]

# What the functions of the tiles do, by the innermost one that is named here.
TERMS = {
    "texels": "texels bytes_at nearest nearest_bytes texels_at_levels",
    "values": "colours block_colours byte intensity highlights",
    "depth": "pixels sample_pair",
    "pairs": "rows add samples centres finish finish_centres used clear_masks",
    "still seen": "colour",
    "planes": "brush depth surface varyings",
    "hidden": "hides draws blocks farthest_of tile",
    "clear, resolve": "clear resolve canvases",
}
TERM = {function: term for term, functions in TERMS.items() for function in functions.split()}


def program(*words, by=()):
    done = subprocess.run([*by, PROGRAM, *map(str, words)], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"error: {' '.join(map(str, words))}: {done.stderr.strip()}")
    return done.stdout


def counted(*words, caches=()):
    """Instructions by their addresses in the program, those outside of it at None, and lines that are fetched."""
    flags = ["--dump-instr=yes", "--compress-pos=no", "--compress-strings=no", *caches]
    program(*words, by=["valgrind", "--tool=callgrind", f"--callgrind-out-file={COUNTS}", *flags])
    own, fetched, inside, called = Counter(), 0, False, False
    for line in open(COUNTS):
        if line.startswith("ob="):
            inside = line.strip().endswith(PROGRAM)
        elif line.startswith("calls="):
            called = True
        elif line.startswith("summary:"):
            fetched = sum(map(int, line.split()[7:]))
        elif line.startswith("0x"):
            # What follows a call is what was called, which is counted there.
            if not called:
                address, _, count = line.split()[:3]
                own[address if inside else None] += int(count)
            called = False
    return own, fetched


def difference(words, fewer, more, caches=()):
    """Of one of what is repeated."""
    (less, less_fetched), (much, much_fetched) = (counted(*words(count), caches=caches) for count in (fewer, more))
    times = more - fewer
    return {at: (much[at] - less[at]) / times for at in much}, (much_fetched - less_fetched) / times


def functions(addresses):
    """For each address the functions that were compiled into each other there, the innermost first, with their files."""
    asked = "\n".join(addresses)
    said = subprocess.run(["addr2line", "-afiCe", PROGRAM], input=asked, capture_output=True, text=True, check=True).stdout
    found, last = {}, []
    lines = iter(said.splitlines())
    for line in lines:
        if re.fullmatch("0x[0-9a-f]+", line):
            last = found[hex(int(line, 16))] = []
        else:
            last.append((re.sub("<.*", "", line).split("::")[-1], next(lines)))
    return found


def term(chain):
    for function, file in chain:
        if "crates/tiles/src/coverage" in file:
            return "coverage"
        if "frames/bins" in file:
            return "vertices, bins"
        if "crates/" in file and function in TERM:
            return TERM[function]
    return "vertices, bins"


def terms(own):
    chains = functions(at for at in own if at)
    by = Counter()
    for at, count in own.items():
        by["vertices, bins" if at is None else term(chains[hex(int(at, 16))])] += count
    return dict(by)


def frames():
    rows = [{"mesh": mesh, "samples": samples} for mesh in MESHES for samples in (1, 4)]
    times = [[] for _ in rows]
    for _ in range(ROUNDS):
        for row, found in zip(rows, times):
            found.append(float(program("--only", row["mesh"], row["samples"], SIDE, 5, SET)))
    for row, found in zip(rows, times):
        words = lambda count: ("--only", row["mesh"], row["samples"], SIDE, count, SET)
        own, fetched = difference(words, 1, 3, CACHES)
        row |= {"ms": min(found), "instructions": sum(own.values()), "fetched": 64 * fetched, "terms": terms(own)}
        row["moved"] = 4 * SIDE * SIDE + int(program("--rates", "mesh", row["mesh"]))
        print(f"{row['mesh']:<12} {row['samples']} samples {row['ms']:6.2f} ms {row['instructions'] / 1e6:6.1f} M", flush=True)
    return rows


def fills():
    rows = []
    for name in CLASSES:
        for by in FILLERS:
            own, _ = difference(lambda count: ("--only", name, by, count), 1, 3)
            rows.append({"class": name, "name": by, "instructions": sum(own.values()) / 2})
            print(f"{name:<8} {by:<20} {rows[-1]['instructions'] / 1e6:8.2f} M", flush=True)
    return rows


def main():
    words = lambda count: ("--rates", "loop", count)
    loop, _ = difference(words, 10**5, 2 * 10**5)
    seconds = min(float(program("--rates", "loop", 10**4)) / 10**4 for _ in range(ROUNDS))
    found = json.loads(program("--rates", "machine"))
    found |= {
        "command": " ".join(["benches/peers/run", "--limits", *sys.argv[1:]]),
        "instructions": SET,
        "copy": max(float(program("--rates", "copy")) for _ in range(3)),
        "rate": sum(loop.values()) / 9 / seconds,
        "frames": frames(),
        "fills": fills(),
    }
    print(f"copy {found['copy'] / 1e9:.1f} GB/s, {found['rate'] / 1e9:.1f} G instructions/s")
    if sys.argv[1:]:
        Path(sys.argv[1]).write_text(json.dumps(found, indent=2) + "\n")


if __name__ == "__main__":
    main()
