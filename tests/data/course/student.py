# What a student writes above the line protocol of `starter.py`.

def edge(a, b, x, y):
    return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])


def inside(a, b, e):
    return e > 0 or e == 0 and (b[1] < a[1] or b[1] == a[1] and b[0] > a[0])


def weights(p, x, y):
    """Of each corner; nothing where the point is not drawn."""
    area = edge(p[0], p[1], p[2][0], p[2][1])
    p = p if area > 0 else [p[0], p[2], p[1]]
    e = [edge(p[i - 2], p[i - 1], x, y) for i in range(3)]
    if area == 0 or not all(inside(p[i - 2], p[i - 1], e[i]) for i in range(3)):
        return None
    l = [value / abs(area) for value in e]
    return l if area > 0 else [l[0], l[2], l[1]]


def box(p, width, height):
    for y in range(max(0, math.floor(min(c[1] for c in p))), min(height, math.ceil(max(c[1] for c in p)))):
        for x in range(max(0, math.floor(min(c[0] for c in p))), min(width, math.ceil(max(c[0] for c in p)))):
            yield x, y


def line(x0, y0, x1, y1, width, height, set_pixel):
    n = max(abs(x1 - x0), abs(y1 - y0))
    for i in range(n + 1 if n < 10000 else 0):
        set_pixel((2 * n * x0 + 2 * (x1 - x0) * i + n) // max(2 * n, 1) if n else x0,
                  (2 * n * y0 + 2 * (y1 - y0) * i + n) // max(2 * n, 1) if n else y0)


def triangle(x0, y0, x1, y1, x2, y2, width, height, set_pixel):
    p = [(x0, y0), (x1, y1), (x2, y2)]
    for x, y in box(p, width, height):
        if weights(p, x + 0.5, y + 0.5):
            set_pixel(x, y)


def values(corners, width, height, set_pixel):
    for x, y in box(corners, width, height):
        l = weights(corners, x + 0.5, y + 0.5)
        if l:
            q = [l[i] / corners[i][3] for i in range(3)]
            mean = lambda w, n: sum(w[i] * corners[i][n] for i in range(3)) / sum(w)
            set_pixel(x, y, mean(l, 2), mean(q, 4), mean(q, 5))


def samples(x0, y0, x1, y1, x2, y2, width, height, set_pixel):
    p = [(x0, y0), (x1, y1), (x2, y2)]
    for x, y in box(p, width, height):
        at = [(6, 2), (14, 6), (2, 10), (10, 14)]
        mask = sum(1 << s for s, (u, v) in enumerate(at) if weights(p, x + u / 16, y + v / 16))
        set_pixel(x, y, mask)


def depth(triangles, width, height, set_pixel):
    nearest = {}
    for t, corners in enumerate(triangles):
        for x, y in box(corners, width, height):
            l = weights(corners, x + 0.5, y + 0.5)
            if l:
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
