def first_centre(above, below):
    """The first column or row whose centre lies at or beyond a coordinate, which is a quotient."""
    return -((128 * below - above) // (256 * below))


def first_column(a, b, y):
    """The first column whose centre lies on the edge from a down to b or to the right of it, at the height y."""
    rise, run = b[1] - a[1], b[0] - a[0]
    return first_centre(a[0] * rise + (y - a[1]) * run, rise)


def triangle(x0, y0, x1, y1, x2, y2, width, height, set_pixel):
    corners = sorted((grid(p) for p in ((x0, y0), (x1, y1), (x2, y2))), key=lambda corner: corner[1])
    top, middle, bottom = corners
    for y in range(max(0, first_centre(top[1], 1)), min(height, first_centre(bottom[1], 1))):
        centre = 256 * y + 128
        short = (top, middle) if centre < middle[1] else (middle, bottom)
        ends = sorted((first_column(top, bottom, centre), first_column(*short, centre)))
        for x in range(max(0, ends[0]), min(width, ends[1])):
            set_pixel(x, y)
