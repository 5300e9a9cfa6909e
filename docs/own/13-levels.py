def halved(texture):
    """The next level: half as wide and half as high, with the means of four texels."""
    return [[(upper[x] + upper[x + 1] + lower[x] + lower[x + 1]) / 4.0 for x in range(0, len(upper), 2)]
            for upper, lower in zip(texture[::2], texture[1::2])]


def texel_at(texture, u, v):
    """The nearest texel of a texture that repeats."""
    size = len(texture)
    return texture[math.floor(v * size) % size][math.floor(u * size) % size]


def read(levels, u, v, number):
    """What is read at a level between two: the nearest texel of both, mixed by the fraction."""
    number = min(max(number, 0.0), len(levels) - 1.0)
    near, far = (texel_at(levels[of], u, v) for of in (math.floor(number), math.ceil(number)))
    return near + (far - near) * (number - math.floor(number))


def stage13():
    """A floor that goes far: on the left by the texture alone, on the right by its levels."""
    picture = empty()
    levels = [[[0.9 if (x // 4 + y // 4) % 2 == 0 else 0.2 for x in range(32)] for y in range(32)]]
    while len(levels[-1]) > 1:
        levels.append(halved(levels[-1]))
    floor = (-8.0, 2.0, 0.0, 0.0), (8.0, 2.0, 3.0, 0.0), (8.0, 60.0, 3.0, 11.0), (-8.0, 60.0, 0.0, 11.0)
    corners = []
    for x, z, u, v in floor:
        clip = transform(perspective(), [x, -1.0, z, 1.0])
        corners.append((*place(clip), clip[3], u, v))
    for triangle in corners[:3], [corners[0], corners[2], corners[3]]:
        for x, y, window in covered([corner[:2] for corner in triangle], WIDTH, HEIGHT):
            shares = [weight / corner[2] for weight, corner in zip(window, triangle)]
            u, v = (sum(s / sum(shares) * corner[n] for s, corner in zip(shares, triangle)) for n in (3, 4))
            # The formula of step 13.
            [number] = level(32, 32, *sum(triangle, ()), x + 0.5, y + 0.5) if x >= WIDTH // 2 else [0.0]
            put(picture, x, y, colour([read(levels, u, v, number)] * 3))
    return picture
