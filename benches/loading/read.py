"""Loads a model with a reader of PyPI, and prints the seconds: read.py READER FILE."""

import sys
import time
from importlib import import_module

MODULES = {"numpy-stl": "stl.mesh", "vtk": "vtkmodules.vtkIOGeometry", "libigl": "igl", "stl-reader": "stl_reader",
           "assimp-py": "assimp_py"}
name, path = sys.argv[1:]
module = import_module(MODULES.get(name, name))
form = path.rsplit(".", 1)[-1]


def vtk():
    if form == "ply":
        reader = import_module("vtkmodules.vtkIOPLY").vtkPLYReader()
    else:
        reader = {"stl": "vtkSTLReader", "obj": "vtkOBJReader", "glb": "vtkGLTFReader"}[form]
        reader = getattr(module, reader)()
    reader.SetFileName(path)
    reader.Update()
    return reader


def pymeshlab():
    meshes = module.MeshSet()
    meshes.load_new_mesh(path)
    return meshes


READERS = {
    "trimesh": lambda: module.load(path, process=False),
    "meshio": lambda: module.read(path),
    "numpy-stl": lambda: module.Mesh.from_file(path),
    "open3d": lambda: module.io.read_triangle_mesh(path),
    "pymeshlab": pymeshlab,
    "vtk": vtk,
    "libigl": lambda: module.read_triangle_mesh(path),
    "stl-reader": lambda: module.read(path),
    "assimp-py": lambda: module.import_file(path, 0),
    # By itself it maps the file into memory and reads nothing of it.
    "plyfile": lambda: module.PlyData.read(path, mmap=False),
}
start = time.perf_counter()
model = READERS[name]()
print(f"0 {time.perf_counter() - start:.4f}")
