"""MuPDF: a page whose content fills the path, rendered with Page.get_pixmap at antialiasing level 0 (PyMuPDF)."""

import numpy
import pymupdf
from rasterproof import serve

pymupdf.TOOLS.set_aa_level(0)


def triangle(points, width, height):
    # A page's y points up. Eight digits are exact on the 1/256 px grid.
    corners = [f"{x:.8f} {height - y:.8f}" for x, y in points]
    with pymupdf.open() as document:
        page = document.new_page(width=width, height=height)
        content = document.get_new_xref()
        document.update_object(content, "<<>>")
        document.update_stream(content, f"0 g {corners[0]} m {corners[1]} l {corners[2]} l h f".encode())
        page.set_contents(content)
        pixels = page.get_pixmap(colorspace=pymupdf.csGRAY, alpha=False)
        return numpy.frombuffer(pixels.samples, numpy.uint8).reshape(height, width) < 128


serve(f"mupdf-{pymupdf.mupdf_version}", "grid=256 mask batch=64", triangle)
