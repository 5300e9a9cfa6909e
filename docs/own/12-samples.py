def blade(i):
    """Triangle i of a fan of twelve around a point, and its colour."""
    def rim(i):
        angle = i * math.tau / 12.0
        return [round((middle + 50.0 * part) * 256.0) / 256.0
                for middle, part in ((80.5, math.cos(angle)), (60.5, math.sin(angle)))]

    return [80.5, 60.5] + rim(i) + rim(i + 1), (60 + 15 * i, 220 - 15 * i, 90 + 60 * (i % 2))


def resolve(pictures):
    """The mean of the four samples of each pixel, halves rounded up."""
    return [[tuple((sum(channel) + 2) // 4 for channel in zip(*pixel)) for pixel in zip(*rows)] for rows in zip(*pictures)]


def stage12():
    """A fan with four samples in each pixel, each of one triangle."""
    pictures = [empty() for _ in range(4)]
    for corners, colour in map(blade, range(12)):
        def paint(x, y, mask):
            for s, picture in enumerate(pictures):
                if mask >> s & 1:
                    put(picture, x, y, colour)

        samples(*corners, WIDTH, HEIGHT, paint)
    return resolve(pictures)
