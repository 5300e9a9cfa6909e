import math

WIDTH, HEIGHT = 160, 120
BACKGROUND = 18, 18, 24


def empty():
    """A picture: a list of rows, each a list of colours."""
    return [[BACKGROUND] * WIDTH for _ in range(HEIGHT)]


def put(picture, x, y, colour):
    """Sets a pixel; one outside the picture is ignored."""
    if 0 <= x < WIDTH and 0 <= y < HEIGHT:
        picture[y][x] = colour


def save(picture, path):
    """Stores a picture as PPM, a format without compression."""
    with open(path, "wb") as file:
        file.write(b"P6\n%d %d\n255\n" % (WIDTH, HEIGHT))
        file.write(bytes(channel for row in picture for colour in row for channel in colour))


def stage1():
    """A disc: every pixel whose centre lies in it. In half pixels the centre of pixel x is 2 x + 1."""
    picture = empty()
    for y in range(HEIGHT):
        for x in range(WIDTH):
            dx, dy = 2 * x + 1 - WIDTH, 2 * y + 1 - HEIGHT
            if dx * dx + dy * dy < 100 * 100:
                put(picture, x, y, (240, 200, 60))
    return picture
