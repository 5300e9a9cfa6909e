def borders(clip):
    """How far a point of clip space lies inside the six borders of the view volume; negative beyond one of them."""
    x, y, z, w = clip
    return [w + x, w - x, w + y, w - y, w + z, w - z]


def in_window(clip, x0, y0, x1, y1):
    """The place in a window of the picture, in pixels, and the depth from 0 to 1."""
    x, y, z, w = clip
    across = x0 + (x / w + 1.0) / 2.0 * (x1 - x0)
    down = y0 + (1.0 - y / w) / 2.0 * (y1 - y0)
    return across, down, (z / w + 1.0) / 2.0


def stage8():
    """Points in two windows. What is outside the view volume is left out, and what is far is dark."""
    picture = empty()
    for bounds in (5.0, 5.0, 65.0, 115.0), (75.0, 30.0, 155.0, 90.0):
        for i in range(1000):
            layer, row, column = i // 100, i // 10 % 10, i % 10
            point = [0.9 * (column - 4.5), 0.9 * (row - 4.5), 19.5 - 2.0 * layer, 1.0]
            clip = transform(perspective(), point)
            if min(borders(clip)) >= 0.0:
                x, y, depth = in_window(clip, *bounds)
                light = int(min(90.0 + 900.0 * (1.0 - depth), 255.0))
                put(picture, math.floor(x), math.floor(y), (light, light, 90))
    return picture
