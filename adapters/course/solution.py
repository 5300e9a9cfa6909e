# The course, solved: written from the pages of the steps alone (docs/steps.md).


def edge(a, b, p):
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])


def owns(a, b):
    """Whether a sample on the edge from a to b is drawn: on top and left edges (step 2b.2)."""
    return b[1] < a[1] or b[1] == a[1] and b[0] > a[0]


def grid(p):
    """A corner in whole subpixels of 1/256 (step 2b.1)."""
    return round(p[0] * 256), round(p[1] * 256)


def weights(corners, p):
    """The weights of three corners at a point, all in subpixels; nothing where the point is not drawn."""
    a, b, c = corners
    area = edge(a, b, c)
    if area == 0:
        return None
    if area < 0:
        b, c = c, b
    e = edge(b, c, p), edge(c, a, p), edge(a, b, p)
    sides = (b, c), (c, a), (a, b)
    if not all(e[i] > 0 or e[i] == 0 and owns(*sides[i]) for i in range(3)):
        return None
    l = [e[i] / abs(area) for i in range(3)]
    return l if area > 0 else [l[0], l[2], l[1]]


def box(corners, width, height):
    xs, ys = [c[0] for c in corners], [c[1] for c in corners]
    for y in range(max(0, min(ys) // 256), min(height, -(-max(ys) // 256))):
        for x in range(max(0, min(xs) // 256), min(width, -(-max(xs) // 256))):
            yield x, y


def covered(corners, width, height):
    """The pixels of a triangle with the weights of its corners."""
    corners = [grid(c) for c in corners]
    for x, y in box(corners, width, height):
        l = weights(corners, (256 * x + 128, 256 * y + 128))
        if l:
            yield x, y, l


def line(x0, y0, x1, y1, width, height, set_pixel):
    steep = abs(y1 - y0) > abs(x1 - x0)
    start, end = ((y0, x0), (y1, x1)) if steep else ((x0, y0), (x1, y1))
    turned = end[0] < start[0]
    if turned:
        start, end = end, start
    du, dv = end[0] - start[0], abs(end[1] - start[1])
    sign = 1 if end[1] >= start[1] else -1
    steps = range(max(0, -start[0]), min(du, (height if steep else width) - 1 - start[0]) + 1)
    for k in reversed(steps) if turned else steps:
        u = start[0] + k
        v = start[1] + sign * ((2 * k * dv + du) // (2 * du) if du else 0)
        if 0 <= v < (width if steep else height):
            set_pixel(*((v, u) if steep else (u, v)))


def triangle(x0, y0, x1, y1, x2, y2, width, height, set_pixel):
    for x, y, _ in covered([(x0, y0), (x1, y1), (x2, y2)], width, height):
        set_pixel(x, y)


def values(corners, width, height, set_pixel):
    for x, y, l in covered(corners, width, height):
        z = sum(l[i] * corners[i][2] for i in range(3))
        q = [l[i] / corners[i][3] for i in range(3)]
        a, b = (sum(q[i] * corners[i][n] for i in range(3)) / sum(q) for n in (4, 5))
        set_pixel(x, y, z, a, b)


def samples(x0, y0, x1, y1, x2, y2, width, height, set_pixel):
    corners = [grid(p) for p in ((x0, y0), (x1, y1), (x2, y2))]
    for x, y in box(corners, width, height):
        at = zip((96, 224, 32, 160), (32, 96, 160, 224))
        mask = sum(1 << s for s, (dx, dy) in enumerate(at) if weights(corners, (256 * x + dx, 256 * y + dy)))
        set_pixel(x, y, mask)


def depth(triangles, width, height, set_pixel):
    nearest = {}
    for t, corners in enumerate(triangles):
        for x, y, l in covered(corners, width, height):
            z = sum(l[i] * corners[i][2] for i in range(3))
            if z < nearest.get((x, y), (math.inf, 0))[0]:
                nearest[x, y] = (z, t)
    for (x, y), (_, t) in nearest.items():
        set_pixel(x, y, t)


def clip(corners):
    polygon = []
    for a, b in zip(corners, corners[1:] + corners[:1]):
        da, db = a[2] + a[3], b[2] + b[3]
        if da >= 0:
            polygon.append(a)
        if (da >= 0) != (db >= 0):
            polygon.append([p + (q - p) * da / (da - db) for p, q in zip(a, b)])
    return polygon


clip_attributes = clip


def project(n, x, y, z):
    return n * x / z, n * y / z, z


def window(width, height, n, f, x, y, z):
    depth = ((f + n) * z - 2 * n * f) / (f - n) / z
    return (n * x / z + 1) / 2 * width, (1 - n * y / z) / 2 * height, (depth + 1) / 2


def winding(*numbers):
    area = edge(*(grid(numbers[i : i + 2]) for i in (0, 2, 4)))
    return [(area > 0) - (area < 0)]


def turn(axis, cos, sin, *numbers):
    centre, point = numbers[:3], list(numbers[3:])
    i, j = int(axis + 1) % 3, int(axis + 2) % 3
    u, v = point[i] - centre[i], point[j] - centre[j]
    point[i], point[j] = centre[i] + cos * u - sin * v, centre[j] + sin * u + cos * v
    return point


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def cross(a, b):
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def normal(*numbers):
    a, b, c, n = (numbers[i : i + 3] for i in (0, 3, 6, 9))
    # The rows of the inverse, transposed, times the determinant.
    rows = cross(b, c), cross(c, a), cross(a, b)
    return [dot(row, n) / dot(a, rows[0]) for row in rows]


def light(*numbers):
    n, towards, (ambient, diffuse) = numbers[:3], numbers[3:6], numbers[6:]
    length = math.sqrt(dot(n, n))
    cosine = dot(n, towards) / length if length > 0 else 0.0
    return [ambient + diffuse * max(cosine, 0.0)]


def texel(u, *texels):
    place = u * len(texels)
    left = math.floor(place - 0.5)
    share = place - 0.5 - left
    a, b = (texels[i % len(texels)] for i in (left, left + 1))
    return texels[math.floor(place) % len(texels)], a + (b - a) * share


def slopes(corners, values):
    """Of the plane through three values at the corners: how much it grows to the right, and downwards."""
    a, b, c = corners
    df1, df2 = values[1] - values[0], values[2] - values[0]
    area = edge(a, b, c)
    return (df1 * (c[1] - a[1]) - df2 * (b[1] - a[1])) / area, (df2 * (b[0] - a[0]) - df1 * (c[0] - a[0])) / area


def level(width, height, *numbers):
    corners = [numbers[i : i + 5] for i in (0, 5, 10)]
    planes = []
    for values in [1 / c[2] for c in corners], [c[3] / c[2] for c in corners], [c[4] / c[2] for c in corners]:
        right, down = slopes(corners, values)
        here = values[0] + right * (numbers[15] - corners[0][0]) + down * (numbers[16] - corners[0][1])
        planes.append((here, right, down))
    q, u, v = planes
    derivative = lambda plane, way: (plane[way] - plane[0] / q[0] * q[way]) / q[0]
    steps = [math.hypot(derivative(u, way) * width, derivative(v, way) * height) for way in (1, 2)]
    return [math.log2(max(steps))]


def formula(name, numbers):
    known = {f.__name__: f for f in (project, window, winding, turn, normal, light, texel, level)}
    return known[name](*numbers)
