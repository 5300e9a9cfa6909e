typedef std::array<double, 4> Point;
// Four rows.
typedef std::array<Point, 4> Matrix;

static Point transform(const Matrix &matrix, Point p) {
    Point result;
    for (int i = 0; i < 4; i++)
        result[i] = matrix[i][0] * p[0] + matrix[i][1] * p[1] + matrix[i][2] * p[2] + matrix[i][3] * p[3];
    return result;
}

static const double NEAR = 1, FAR = 20;

// An eye at the origin that looks along z; w becomes the old z.
static Matrix perspective() {
    const double scale = 2, span = FAR - NEAR;
    return {{
        {scale * HEIGHT / WIDTH, 0, 0, 0},
        {0, scale, 0, 0},
        {0, 0, (FAR + NEAR) / span, -2 * FAR * NEAR / span},
        {0, 0, 1, 0},
    }};
}

struct Place { double x, y; };

// The place of a point of clip space in the window, in pixels: divided by w, then stretched.
static Place place(double x, double y, double w) {
    return {(x / w + 1) / 2 * WIDTH, (1 - y / w) / 2 * HEIGHT};
}

// The corners of a cube of side 2, as bits: x is bit 0, y bit 1, z bit 2.
static Point cube_corner(int number) {
    return {number & 1 ? 1. : -1., number & 2 ? 1. : -1., number & 4 ? 1. : -1., 1};
}

// The pixel of a corner of the cube, straight ahead.
static std::array<int, 2> cube_pixel(int number) {
    const Point p = cube_corner(number);
    const Point clip = transform(perspective(), {p[0] + 0.5, p[1] - 0.3, p[2] + 4, 1});
    const Place px = place(clip[0], clip[1], clip[3]);
    return {int(std::floor(px.x)), int(std::floor(px.y))};
}

// The twelve edges of the cube.
static void stage4() {
    empty();
    for (int corner = 0; corner < 8; corner++)
        for (int axis = 0; axis < 3; axis++) {
            if (corner >> axis & 1) continue;
            const std::array<int, 2> a = cube_pixel(corner), b = cube_pixel(corner | 1 << axis);
            line(a[0], a[1], b[0], b[1], WIDTH, HEIGHT, [](int x, int y) { put(x, y, {160, 230, 160}); });
        }
}
