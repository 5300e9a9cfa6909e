# The course. Write the function of your step, then: rasterproof course check


# ---- YOUR PLACE: seven functions, empty as they stand ----

# To be judged with attributes, too, let it be clip, of corners (x, y, z, w, a) then (step 7).
clip_attributes = None


def line(x0, y0, x1, y1, width, height, set_pixel):
    """Whole pixels from one to another, both drawn, in drawing order, and nothing outside the window (steps 1 and 2a)."""


def triangle(x0, y0, x1, y1, x2, y2, width, height, set_pixel):
    """Corners in pixels, y down; set_pixel(x, y) for every pixel drawn (steps 2b, 2c and 7)."""


def values(corners, width, height, set_pixel):
    """Three corners (x, y, z, w, a, b); set_pixel(x, y, z, a, b) for every pixel drawn (steps 3 to 7)."""


def samples(x0, y0, x1, y1, x2, y2, width, height, set_pixel):
    """As triangle, with four samples: set_pixel(x, y, mask), bit s of the mask is sample s (step 12)."""


def depth(triangles, width, height, set_pixel):
    """Triangles of three corners (x, y, z); set_pixel(x, y, t) once where triangle t is nearest (step 6)."""


def clip(corners):
    """Three corners (x, y, z, w) of clip space; the corners of what z >= -w leaves of them (step 7)."""
    return []


def formula(name, numbers):
    """What the formula "project", "window" and so on gives for these numbers, as a list (steps 4, 8 to 11 and 13)."""
    return []

