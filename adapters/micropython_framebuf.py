"""MicroPython's framebuf: FrameBuffer.poly with fill and FrameBuffer.line, GS8, in the interpreter's Unix port.

Corners are an array of integers, here of 16 bits ('h'), as the documentation has it. The interpreter runs PROGRAM: it reads
'poly width height corners' or 'line ...' and writes the buffer.
"""

import subprocess
import sys
from pathlib import Path

import numpy
from rasterproof import serve, walkable

PROGRAM = """
import array, framebuf, sys
sys.stdout.buffer.write("%d.%d.%d\\n" % sys.implementation.version[:3])
while words := sys.stdin.readline().split():
    width, height, *numbers = map(int, words[1:])
    pixels = bytearray(width * height)
    buffer = framebuf.FrameBuffer(pixels, width, height, framebuf.GS8)
    if words[0] == "poly":
        buffer.poly(0, 0, array.array("h", numbers), 255, True)
    else:
        buffer.line(*numbers, 255)
    sys.stdout.buffer.write(pixels)
"""
interpreter = subprocess.Popen(
    [Path(sys.executable).with_name("micropython"), "-c", PROGRAM], stdin=subprocess.PIPE, stdout=subprocess.PIPE
)
version = interpreter.stdout.readline().decode().strip()


def drawn(call, points, width, height):
    numbers = " ".join(str(int(value)) for point in points for value in point)
    interpreter.stdin.write(f"{call} {width} {height} {numbers}\n".encode())
    interpreter.stdin.flush()
    mask = interpreter.stdout.read(width * height)
    return numpy.frombuffer(mask, numpy.uint8).reshape(height, width)


serve(
    f"micropython-{version}-framebuf",
    "grid=1 range=32767 mask line-set batch=64",
    lambda *request: drawn("poly", *request),
    lambda points, *window: drawn("line", walkable(points), *window),
)
