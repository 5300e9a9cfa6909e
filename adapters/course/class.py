"""Writes a class of 60 submissions in Python, to try `rasterproof course grade` with: 24 right, 12 wrong, 24 hostile or broken.

python3 adapters/course/class.py RASTERPROOF FOLDER     (RASTERPROOF: the program, which writes the right ones)
"""

import shutil
import subprocess
import sys
from pathlib import Path

# A wrong submission: what is exchanged in the right one.
WRONG = {
    "strict": ("e[i] > 0 or e[i] == 0 and owns(*sides[i])", "e[i] > 0"),
    "inclusive": ("e[i] > 0 or e[i] == 0 and owns(*sides[i])", "e[i] >= 0"),
    "corner-samples": ("(256 * x + 128, 256 * y + 128)", "(256 * x, 256 * y)"),
    "truncated": ("round(p[0] * 256), round(p[1] * 256)", "int(p[0]) * 256, int(p[1]) * 256"),
    "one-winding": ("if area == 0:", "if area <= 0:"),
    "weights-stay": ("l if area > 0 else [l[0], l[2], l[1]]", "l"),
    "affine": ("q = [l[i] / corners[i][3]", "q = [l[i]"),
    "depth-twice": ("z = sum(l[i] * corners[i][2] for i in range(3))\n        q", "z = sum(l[i] * corners[i][2] / corners[i][3] for i in range(3))\n        q"),
    "farthest": ("if z < nearest.get((x, y), (math.inf, 0))[0]:", "if z > nearest.get((x, y), (-math.inf, 0))[0]:"),
    "end-lost": ("- 1 - start[0]) + 1)", "- 1 - start[0]))"),
    "plane": ("da, db = a[2] + a[3], b[2] + b[3]", "da, db = a[2], b[2]"),
    "bits": ("1 << s for", "8 >> s for"),
}

# What stands before a right submission, or in its place where it begins with an exclamation mark; FUNCTION: is for its first line.
SLEEP = "import time; time.sleep(100000)\n"
MANY = "import os, time\nfor _ in range(200):\n    if os.fork() == 0:\n        {}time.sleep(100000)\n"
HOSTILE = {
    "hangs-at-once": SLEEP,
    "hangs-in-lines": "line:    " + SLEEP,
    "hangs-in-triangles": "triangle:    " + SLEEP,
    "hangs-in-values": "values:    " + SLEEP,
    "starts-200": MANY.format(""),
    "starts-200-that-leave": MANY.format("os.setsid(); "),
    "floods-output": "import os\nwhile True: os.write(1, b'x' * 65536)\n",
    "floods-lines": "import os\nwhile True: os.write(1, b'x\\n' * 32768)\n",
    "floods-errors": "import os\nwhile True: os.write(2, b'x' * 65536)\n",
    "floods-in-a-step": "triangle:    while True: os.write(1, b'x' * 65536)\n",
    "crashes-at-once": "raise SystemError\n",
    "crashes-in-lines": "line:    os.kill(os.getpid(), 11)\n",
    "exits-in-triangles": "triangle:    os._exit(0)\n",
    "asks-8-gib": "bytearray(8 << 30)\n",
    "asks-8-gib-in-values": "values:    bytearray(8 << 30)\n",
    "grows": "depth:    l = []\n    while True: l.append(bytearray(1 << 20))\n",
    "never-rests": "while True: pass\n",
    "never-rests-in-clip": "clip:    while True: pass\n",
    "never-rests-in-samples": "samples:    while True: pass\n",
    "closes-its-output": "import os\nos.close(1)\n",
    "no-python": "! this is no program\n",
    "empty": "!",
}
BUILDS = {"build-hangs": "sleep 100000 & sleep 100000", "build-floods": "while :; do echo much >&2; done"}


def write(folder, text):
    folder.mkdir()
    (folder / "starter.py").write_text(text)
    (folder / "course.toml").write_text((solved / "course.toml").read_text())


program, folder = sys.argv[1], Path(sys.argv[2])
folder.mkdir()
solved = folder / "right-00"
subprocess.run([program, "course", "start", "--solution", "--language", "python", solved], check=True, capture_output=True)
right = (solved / "starter.py").read_text()
for number in range(1, 24):
    shutil.copytree(solved, folder / f"right-{number:02}")
for name, (old, new) in WRONG.items():
    assert right.count(old) >= 1, name
    write(folder / f"wrong-{name}", right.replace(old, new))
for name, code in HOSTILE.items():
    function, colon, body = code.partition(":    ")
    if code.startswith("!"):
        text = code[1:]
    elif colon and function.isidentifier():
        head = next(line for line in right.splitlines(True) if line.startswith(f"def {function}("))
        text = right.replace(head, head + "    " + body)
    else:
        text = code + right
    write(folder / f"hostile-{name}", text)
for name, line in BUILDS.items():
    write(folder / f"hostile-{name}", right)
    toml = folder / f"hostile-{name}" / "course.toml"
    toml.write_text(toml.read_text().replace("build = []", f'build = ["sh", "-c", "{line}"]'))
