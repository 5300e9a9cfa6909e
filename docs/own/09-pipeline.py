def mix(weights, values):
    """The weighted mean of the values of three corners."""
    return sum(weight * value for weight, value in zip(weights, values))


def colour(channels):
    return tuple(math.floor(255.0 * min(max(channel, 0.0), 1.0) + 0.5) for channel in channels)


def checker(u, v):
    """Light and dark squares, eight on each side."""
    is_light = (math.floor(8.0 * u) + math.floor(8.0 * v)) % 2 == 0
    return (0.9, 0.85, 0.7) if is_light else (0.25, 0.3, 0.45)


def draw(picture, nearest, triangle, shade):
    """Clip, divide, snap, leave out back faces, cover, interpolate, test, shade. A corner is x, y, z, w and five values."""
    polygon = clip(triangle)
    # A polygon with n corners is a fan of n - 2 triangles.
    for i in range(2, len(polygon)):
        corners = polygon[0], polygon[i - 1], polygon[i]
        places = [place(corner) for corner in corners]
        if edge(*map(grid, places)) <= 0:
            continue
        for x, y, window in covered(places, WIDTH, HEIGHT):
            depth = mix(window, [corner[2] / corner[3] for corner in corners])
            if depth < nearest.get((x, y), math.inf):
                nearest[x, y] = depth
                shares = [weight / corner[3] for weight, corner in zip(window, corners)]
                values = [mix(shares, column) / sum(shares) for column in list(zip(*corners))[4:]]
                put(picture, x, y, shade(*values))


def stage9():
    """A floor that begins behind the eye, and a wall with its back to us, which is left out."""
    picture, nearest = empty(), {}

    def vertex(x, y, z, u, v):
        return transform(perspective(), [x, y, z, 1.0]) + [u, v, 0.0, 0.0, 0.0]

    a, b = vertex(-3.0, -1.0, -4.0, 0.0, 0.0), vertex(-3.0, -1.0, 12.0, 0.0, 1.0)
    c, d = vertex(3.0, -1.0, 12.0, 1.0, 1.0), vertex(3.0, -1.0, -4.0, 1.0, 0.0)
    for triangle in [a, b, c], [a, c, d]:
        draw(picture, nearest, triangle, lambda u, v, *_: colour(checker(u, v)))
    wall = [vertex(x, y, 6.0, 0.0, 0.0) for x, y in ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0))]
    draw(picture, nearest, wall, lambda *_: (255, 255, 255))
    return picture
