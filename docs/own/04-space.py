def transform(matrix, point):
    """A matrix of four rows, times a point x, y, z, w."""
    return [sum(row[i] * point[i] for i in range(4)) for row in matrix]


NEAR, FAR = 1.0, 20.0


def perspective():
    """An eye at the origin that looks along z; w becomes the old z."""
    scale, span = 2.0, FAR - NEAR
    return [
        [scale * HEIGHT / WIDTH, 0.0, 0.0, 0.0],
        [0.0, scale, 0.0, 0.0],
        [0.0, 0.0, (FAR + NEAR) / span, -2.0 * FAR * NEAR / span],
        [0.0, 0.0, 1.0, 0.0],
    ]


def place(corner):
    """The place of a point of clip space in the window, in pixels: divided by w, then stretched."""
    x, y, _, w = corner[:4]
    return (x / w + 1.0) / 2.0 * WIDTH, (1.0 - y / w) / 2.0 * HEIGHT


def cube_corner(number):
    """The corners of a cube of side 2, as bits: x is bit 0, y bit 1, z bit 2."""
    return [1.0 if number >> axis & 1 else -1.0 for axis in range(3)]


def stage4():
    """The twelve edges of a cube, straight ahead."""
    picture = empty()

    def pixel(number):
        x, y, z = cube_corner(number)
        px = place(transform(perspective(), [x + 0.5, y - 0.3, z + 4.0, 1.0]))
        return math.floor(px[0]), math.floor(px[1])

    for corner in range(8):
        for axis in range(3):
            if not corner >> axis & 1:
                ends = *pixel(corner), *pixel(corner | 1 << axis)
                line(*ends, WIDTH, HEIGHT, lambda x, y: put(picture, x, y, (160, 230, 160)))
    return picture
