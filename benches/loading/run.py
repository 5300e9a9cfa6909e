"""Loads the models of make.py with each reader in turns: run.py FOLDER [ROUNDS] [FILE...].

Prints the median seconds of loading, the peak memory of the process, and how many times the fastest other reader's time
ours is. The Rust programs have to be built before:

    cargo build --release -p rasterproof-models --example load
    cargo build --release --manifest-path benches/loading/Cargo.toml --target-dir target

Readers of PyPI that are not installed are left out.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median

HERE = Path(__file__).parent
BUILT = HERE.parent.parent / "target/release"
OURS = BUILT / "examples/load"
CRATES = BUILT / "rasterproof-loading"
READERS = {
    "grid.obj": (["tobj", "tobj-single-index", "obj", "obj-rs", "mesh-loader"],
                 ["open3d", "pymeshlab", "vtk", "libigl", "assimp-py"]),
    "grid.stl": (["stl_io", "stl_io-unmerged", "nom_stl", "mesh-loader"],
                 ["trimesh", "numpy-stl", "stl-reader", "open3d", "pymeshlab", "vtk", "libigl", "assimp-py"]),
    "grid-text.stl": (["stl_io", "stl_io-unmerged", "nom_stl", "mesh-loader"], ["numpy-stl", "vtk", "assimp-py"]),
    "grid.ply": (["ply-rs-bw"], ["trimesh", "meshio", "plyfile", "open3d", "pymeshlab", "vtk", "libigl", "assimp-py"]),
    "grid-text.ply": (["ply-rs-bw"], ["trimesh", "open3d", "pymeshlab", "vtk", "libigl", "assimp-py"]),
    "grid.glb": (["gltf"], ["trimesh", "open3d", "vtk", "assimp-py"]),
}


def load(command):
    """The seconds that a program prints as its last word but a unit, and the megabytes of its peak."""
    with tempfile.TemporaryFile() as out:
        process = subprocess.Popen(command, stdout=out, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        words = out.read().split()
    if process.returncode != 0:
        return None
    return float(words[-2] if words[-1] == b"s" else words[-1]), usage.ru_maxrss / 1000


folder, rounds = Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 5
for file in sys.argv[3:] or READERS:
    crates, modules = READERS[file]
    path = str(folder / file)
    commands = {"rasterproof": [OURS, path]}
    commands |= {f"{name} (Rust)": [CRATES, name, path] for name in crates}
    commands |= {f"{name} (Python)": [sys.executable, HERE / "read.py", name, path] for name in modules}
    found = {name: [] for name in commands}
    for _ in range(rounds):
        for name, command in list(commands.items()):
            result = load(command)
            if result is None:
                del commands[name], found[name]
            else:
                found[name].append(result)
    rows = sorted((median(s for s, _ in runs), max(m for _, m in runs), name) for name, runs in found.items())
    ours = next(seconds for seconds, _, name in rows if name == "rasterproof")
    best = next(seconds for seconds, _, name in rows if name != "rasterproof")
    print(f"{file}: rasterproof takes {ours / best:.2f} times the fastest other reader's time")
    for seconds, megabytes, name in rows:
        print(f"  {seconds:8.3f} s {megabytes:8.0f} MB  {name}")
