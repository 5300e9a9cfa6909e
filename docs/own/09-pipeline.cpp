// A corner: x, y, z, w of clip space, then u, v and the normal.
typedef std::array<double, 9> Vertex;

// The part of a triangle beyond the near plane: stage 7 for all nine numbers.
static std::vector<Vertex> clip_near(const std::array<Vertex, 3> &corners) {
    std::vector<Vertex> polygon;
    for (int i = 0; i < 3; i++) {
        const Vertex &a = corners[i], &b = corners[(i + 1) % 3];
        const double da = a[2] + a[3], db = b[2] + b[3];
        if (da >= 0) polygon.push_back(a);
        if ((da >= 0) == (db >= 0)) continue;
        Vertex cut;
        for (int n = 0; n < 9; n++) cut[n] = a[n] + (b[n] - a[n]) * da / (da - db);
        polygon.push_back(cut);
    }
    return polygon;
}

// The weighted mean of a value of three corners.
static double mix(const double l[3], double a, double b, double c) { return l[0] * a + l[1] * b + l[2] * c; }

static Colour colour(double red, double green, double blue) {
    const auto byte = [](double c) { return (unsigned char)std::floor(255 * std::min(std::max(c, 0.0), 1.0) + 0.5); };
    return {byte(red), byte(green), byte(blue)};
}

// Light and dark squares, eight on each side.
static std::array<double, 3> checker(double u, double v) {
    if (std::fmod(std::abs(std::floor(8 * u) + std::floor(8 * v)), 2) == 0) return {0.9, 0.85, 0.7};
    return {0.25, 0.3, 0.45};
}

// For each pixel the depth of what it shows.
static std::vector<double> nearest;

static void empty_scene() {
    empty();
    nearest.assign(WIDTH * HEIGHT, INFINITY);
}

// Draws a triangle: clip, divide, snap, leave out back faces, cover, interpolate, test, shade.
template <class Shade> static void draw(const std::array<Vertex, 3> &corners, Shade shade) {
    const std::vector<Vertex> polygon = clip_near(corners);
    // A polygon with n corners is a fan of n - 2 triangles.
    for (size_t i = 2; i < polygon.size(); i++) {
        const Vertex p[3] = {polygon[0], polygon[i - 1], polygon[i]};
        Grid places[3];
        for (int k = 0; k < 3; k++) {
            const Place px = place(p[k][0], p[k][1], p[k][3]);
            places[k] = grid(px.x, px.y);
        }
        if (edge(places[0], places[1], places[2]) <= 0) continue;
        box(places, WIDTH, HEIGHT, [&](int x, int y) {
            double l[3];
            if (!weigh(places, {256 * x + 128, 256 * y + 128}, l)) return;
            const double depth = mix(l, p[0][2] / p[0][3], p[1][2] / p[1][3], p[2][2] / p[2][3]);
            if (!(depth < nearest[y * WIDTH + x])) return;
            nearest[y * WIDTH + x] = depth;
            for (int k = 0; k < 3; k++) l[k] /= p[k][3];
            const double sum = l[0] + l[1] + l[2];
            std::array<double, 5> values;
            for (int n = 0; n < 5; n++) values[n] = mix(l, p[0][4 + n], p[1][4 + n], p[2][4 + n]) / sum;
            put(x, y, shade(values));
        });
    }
}

static Vertex vertex(Point clip, double u, double v, Point normal) {
    return {clip[0], clip[1], clip[2], clip[3], u, v, normal[0], normal[1], normal[2]};
}

// A floor that begins behind the eye, and a wall with its back to us, which is left out.
static void stage9() {
    empty_scene();
    const auto at = [](double x, double y, double z, double u, double v) {
        return vertex(transform(perspective(), {x, y, z, 1}), u, v, {});
    };
    const Vertex a = at(-3, -1, -4, 0, 0), b = at(-3, -1, 12, 0, 1), c = at(3, -1, 12, 1, 1), d = at(3, -1, -4, 1, 0);
    const auto shade = [](std::array<double, 5> v) {
        const std::array<double, 3> texel = checker(v[0], v[1]);
        return colour(texel[0], texel[1], texel[2]);
    };
    draw({a, b, c}, shade);
    draw({a, c, d}, shade);
    const auto white = [](std::array<double, 5>) { return Colour{255, 255, 255}; };
    draw({at(-1, -1, 6, 0, 0), at(1, -1, 6, 0, 0), at(1, 1, 6, 0, 0)}, white);
}
