"""Writes a displaced grid of 5,000,000 triangles in each format: make.py FOLDER. Needs numpy."""

import json
import struct
import sys
from pathlib import Path

import numpy as np

COLUMNS, ROWS = 2500, 1000
folder = Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)

j, i = np.meshgrid(np.arange(ROWS + 1), np.arange(COLUMNS + 1), indexing="ij")
u, v = (i / COLUMNS).ravel(), (j / ROWS).ravel()
y = 0.3 * np.sin(9 * u) * np.cos(7 * v) + 0.02 * np.sin(171 * u + 93 * v)
positions = np.stack([10 * u - 5, y, 4 * v - 2], 1).astype("<f4")
slopes = [np.gradient(y.reshape(j.shape), axis=axis).ravel() for axis in (1, 0)]
normals = np.stack([-slopes[0] * COLUMNS / 10, np.ones_like(y), -slopes[1] * ROWS / 4], 1)
normals = (normals / np.linalg.norm(normals, axis=1)[:, None]).astype("<f4")
uvs = np.stack([u, v], 1).astype("<f4")
a = (j * (COLUMNS + 1) + i)[:-1, :-1].ravel()
below = a + COLUMNS + 1
faces = np.stack([a, below, a + 1, a + 1, below, below + 1], 1).reshape(-1, 3).astype("<u4")


def glb():
    lists = [positions, normals, uvs, faces]
    ends = np.cumsum([part.nbytes for part in lists]).tolist()
    accessor = lambda view, kind, count, form: {
        "bufferView": view, "componentType": kind, "count": count, "type": form}
    accessors = [accessor(0, 5126, len(positions), "VEC3"), accessor(1, 5126, len(positions), "VEC3"),
                 accessor(2, 5126, len(positions), "VEC2"), accessor(3, 5125, faces.size, "SCALAR")]
    accessors[0] |= {"min": positions.min(0).tolist(), "max": positions.max(0).tolist()}
    primitive = {"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3}
    document = json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [primitive]}], "accessors": accessors, "buffers": [{"byteLength": ends[-1]}],
        "bufferViews": [{"buffer": 0, "byteOffset": end - part.nbytes, "byteLength": part.nbytes}
                        for part, end in zip(lists, ends)],
    }).encode()
    document += b" " * (-len(document) % 4)
    with open(folder / "grid.glb", "wb") as out:
        out.write(struct.pack("<4sII", b"glTF", 2, 28 + len(document) + ends[-1]))
        out.write(struct.pack("<I4s", len(document), b"JSON") + document)
        out.write(struct.pack("<I4s", ends[-1], b"BIN\0"))
        for part in lists:
            out.write(part.tobytes())


def stl():
    records = np.zeros(len(faces), dtype=[("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")])
    records["v"] = positions[faces]
    with open(folder / "grid.stl", "wb") as out:
        out.write(b"a displaced grid".ljust(80) + struct.pack("<I", len(faces)) + records.tobytes())
    vertex = b"vertex %.6e %.6e %.6e\n"
    facet = b"facet normal 0 0 0\nouter loop\n" + 3 * vertex + b"endloop\nendfacet\n"
    with open(folder / "grid-text.stl", "wb") as out:
        out.write(b"solid grid\n")
        for triangles in np.array_split(positions[faces].reshape(-1, 9), 100):
            out.writelines(facet % tuple(row) for row in triangles.tolist())
        out.write(b"endsolid grid\n")


def ply(name, form):
    coordinates = "".join(f"property float {axis}\n" for axis in "xyz")
    head = (f"ply\nformat {form} 1.0\nelement vertex {len(positions)}\n{coordinates}element face {len(faces)}\n"
            "property list uchar int vertex_indices\nend_header\n")
    records = np.zeros(len(faces), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    records["count"], records["corners"] = 3, faces
    with open(folder / name, "wb") as out:
        out.write(head.encode())
        if form == "ascii":
            out.writelines(b"%.6f %.6f %.6f\n" % tuple(row) for row in positions.tolist())
            out.writelines(b"3 %d %d %d\n" % tuple(row) for row in faces.tolist())
        else:
            out.write(positions.tobytes() + records.tobytes())


def obj():
    with open(folder / "grid.obj", "wb") as out:
        out.writelines(b"v %.6f %.6f %.6f\n" % tuple(row) for row in positions.tolist())
        out.writelines(b"vt %.6f %.6f\n" % tuple(row) for row in uvs.tolist())
        out.writelines(b"vn %.4f %.4f %.4f\n" % tuple(row) for row in normals.tolist())
        for a, b, c in (faces + 1).tolist():
            out.write(b"f %d/%d/%d %d/%d/%d %d/%d/%d\n" % (a, a, a, b, b, b, c, c, c))


glb()
stl()
ply("grid.ply", "binary_little_endian")
ply("grid-text.ply", "ascii")
obj()
