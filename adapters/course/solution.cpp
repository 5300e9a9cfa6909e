// The course, solved: written from the pages of the steps alone (docs/steps.md).
#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

typedef __int128 wide;

// A position in whole subpixels of 1/256 (step 2b.1).
struct Grid { long long x, y; };

static Grid grid(double x, double y) { return {std::llround(x * 256), std::llround(y * 256)}; }

static wide edge(Grid a, Grid b, Grid p) {
    return wide(b.x - a.x) * (p.y - a.y) - wide(b.y - a.y) * (p.x - a.x);
}

// Whether a sample on the edge from a to b is drawn: on top and left edges (step 2b.2).
static bool owns(Grid a, Grid b) { return b.y < a.y || (b.y == a.y && b.x > a.x); }

// The weights of three corners at a point; false where the point is not drawn.
static bool weigh(const Grid corners[3], Grid p, double l[3]) {
    const wide area = edge(corners[0], corners[1], corners[2]);
    if (area == 0) return false;
    // The places of the corners, clockwise.
    const int order[3] = {0, area > 0 ? 1 : 2, area > 0 ? 2 : 1};
    for (int i = 0; i < 3; i++) {
        const Grid a = corners[order[(i + 1) % 3]], b = corners[order[(i + 2) % 3]];
        const wide e = edge(a, b, p);
        if (!(e > 0 || (e == 0 && owns(a, b)))) return false;
        l[order[i]] = double(e) / double(area > 0 ? area : -area);
    }
    return true;
}

// Calls draw(x, y) for the pixels around a triangle that lie in the window.
template <class Draw> static void box(const Grid c[3], int width, int height, Draw draw) {
    const auto low = [](long long v) { return v >= 0 ? v / 256 : -((-v + 255) / 256); };
    const auto high = [&](long long v) { return -low(-v); };
    const long long left = std::max(0ll, low(std::min({c[0].x, c[1].x, c[2].x})));
    const long long right = std::min<long long>(width, high(std::max({c[0].x, c[1].x, c[2].x})));
    const long long top = std::max(0ll, low(std::min({c[0].y, c[1].y, c[2].y})));
    const long long bottom = std::min<long long>(height, high(std::max({c[0].y, c[1].y, c[2].y})));
    for (long long y = top; y < bottom; y++)
        for (long long x = left; x < right; x++) draw(int(x), int(y));
}

static void line(int x0, int y0, int x1, int y1, int width, int height, rasterproof_set_pixel set_pixel) {
    long long u0 = x0, v0 = y0, u1 = x1, v1 = y1, size = width;
    const bool steep = std::llabs(v1 - v0) > std::llabs(u1 - u0);
    if (steep) std::swap(u0, v0), std::swap(u1, v1), size = height;
    const bool turned = u1 < u0;
    if (turned) std::swap(u0, u1), std::swap(v0, v1);
    const long long du = u1 - u0, dv = std::llabs(v1 - v0), sign = v1 >= v0 ? 1 : -1;
    const long long first = std::max(0ll, -u0), last = std::min(du, size - 1 - u0);
    for (long long i = first; i <= last; i++) {
        const long long k = turned ? first + last - i : i;
        const wide along = du == 0 ? wide(0) : (wide(2) * k * dv + du) / (wide(2) * du);
        const long long u = u0 + k, v = v0 + sign * (long long)(along);
        if (v < 0 || v >= (steep ? width : height)) continue;
        set_pixel(int(steep ? v : u), int(steep ? u : v));
    }
}

static void triangle(double x0, double y0, double x1, double y1, double x2, double y2, int width, int height,
                     rasterproof_set_pixel set_pixel) {
    const Grid corners[3] = {grid(x0, y0), grid(x1, y1), grid(x2, y2)};
    double l[3];
    box(corners, width, height, [&](int x, int y) {
        if (weigh(corners, {256 * x + 128, 256 * y + 128}, l)) set_pixel(x, y);
    });
}

static void values(const rasterproof_corner p[3], int width, int height, rasterproof_set_values set_pixel) {
    const Grid corners[3] = {grid(p[0].x, p[0].y), grid(p[1].x, p[1].y), grid(p[2].x, p[2].y)};
    double l[3];
    box(corners, width, height, [&](int x, int y) {
        if (!weigh(corners, {256 * x + 128, 256 * y + 128}, l)) return;
        const double z = l[0] * p[0].z + l[1] * p[1].z + l[2] * p[2].z;
        for (int i = 0; i < 3; i++) l[i] /= p[i].w;
        const double q = l[0] + l[1] + l[2];
        set_pixel(x, y, z, (l[0] * p[0].a + l[1] * p[1].a + l[2] * p[2].a) / q,
                  (l[0] * p[0].b + l[1] * p[1].b + l[2] * p[2].b) / q);
    });
}

static void samples(double x0, double y0, double x1, double y1, double x2, double y2, int width, int height,
                    rasterproof_set_samples set_pixel) {
    const Grid corners[3] = {grid(x0, y0), grid(x1, y1), grid(x2, y2)};
    const int dx[4] = {96, 224, 32, 160}, dy[4] = {32, 96, 160, 224};
    double l[3];
    box(corners, width, height, [&](int x, int y) {
        int mask = 0;
        for (int s = 0; s < 4; s++) mask |= int(weigh(corners, {256 * x + dx[s], 256 * y + dy[s]}, l)) << s;
        set_pixel(x, y, mask);
    });
}

static void depth(const rasterproof_point (*triangles)[3], int count, int width, int height,
                  rasterproof_set_seen set_pixel) {
    std::vector<double> nearest(size_t(width) * height, INFINITY);
    std::vector<int> seen(size_t(width) * height, -1);
    double l[3];
    for (int t = 0; t < count; t++) {
        const rasterproof_point *p = triangles[t];
        const Grid corners[3] = {grid(p[0].x, p[0].y), grid(p[1].x, p[1].y), grid(p[2].x, p[2].y)};
        box(corners, width, height, [&](int x, int y) {
            if (!weigh(corners, {256 * x + 128, 256 * y + 128}, l)) return;
            const double z = l[0] * p[0].z + l[1] * p[1].z + l[2] * p[2].z;
            const size_t at = size_t(y) * width + x;
            if (z < nearest[at]) nearest[at] = z, seen[at] = t;
        });
    }
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            if (seen[size_t(y) * width + x] >= 0) set_pixel(x, y, seen[size_t(y) * width + x]);
}

static const rasterproof_wide_line wide_line = nullptr;
static const rasterproof_samples area = nullptr;
static const rasterproof_sample_values sample_values = nullptr;

static void clip_attributes(const rasterproof_carried_corner corners[3], rasterproof_add_carried add_corner) {
    for (int i = 0; i < 3; i++) {
        const rasterproof_carried_corner a = corners[i], b = corners[(i + 1) % 3];
        const double da = a.z + a.w, db = b.z + b.w, t = da / (da - db);
        if (da >= 0) add_corner(a.x, a.y, a.z, a.w, a.a);
        if ((da >= 0) != (db >= 0))
            add_corner(a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t, a.w + (b.w - a.w) * t,
                       a.a + (b.a - a.a) * t);
    }
}

static rasterproof_add_corner add_without;

static void clip(const rasterproof_clip_corner corners[3], rasterproof_add_corner add_corner) {
    rasterproof_carried_corner carried[3];
    for (int i = 0; i < 3; i++) carried[i] = {corners[i].x, corners[i].y, corners[i].z, corners[i].w, 0};
    add_without = add_corner;
    clip_attributes(carried, [](double x, double y, double z, double w, double) { add_without(x, y, z, w); });
}

static int project(double n, double x, double y, double z, double *answer) {
    answer[0] = n * x / z, answer[1] = n * y / z, answer[2] = z;
    return 3;
}

static int window(const double v[7], double *answer) {
    const double n = v[2], f = v[3], z = v[6], depth = ((f + n) * z - 2 * n * f) / (f - n) / z;
    answer[0] = (n * v[4] / z + 1) / 2 * v[0], answer[1] = (1 - n * v[5] / z) / 2 * v[1], answer[2] = (depth + 1) / 2;
    return 3;
}

static int winding(const double v[6], double *answer) {
    const wide area = edge(grid(v[0], v[1]), grid(v[2], v[3]), grid(v[4], v[5]));
    answer[0] = (area > 0) - (area < 0);
    return 1;
}

static int turn(const double v[9], double *answer) {
    const double cos = v[1], sin = v[2], *centre = v + 3, *point = v + 6;
    const int axis = int(v[0]), i = (axis + 1) % 3, j = (axis + 2) % 3;
    const double a = point[i] - centre[i], b = point[j] - centre[j];
    answer[axis] = point[axis], answer[i] = centre[i] + cos * a - sin * b, answer[j] = centre[j] + sin * a + cos * b;
    return 3;
}

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static int normal(const double v[12], double *answer) {
    double determinant = 0;
    for (int i = 0; i < 3; i++) {
        // Row i of the inverse, transposed, times the determinant: the cross product of the two other rows.
        const double *a = v + 3 * ((i + 1) % 3), *b = v + 3 * ((i + 2) % 3);
        const double row[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
        if (i == 0) determinant = dot(v, row);
        answer[i] = dot(row, v + 9) / determinant;
    }
    return 3;
}

static int light(const double v[8], double *answer) {
    const double length = std::sqrt(dot(v, v)), cosine = length > 0 ? dot(v, v + 3) / length : 0;
    answer[0] = v[6] + v[7] * std::max(cosine, 0.0);
    return 1;
}

static int texel(double u, const double *texels, int count, double *answer) {
    // A texel of a row that repeats.
    const auto at = [&](double i) { return texels[int(i - count * std::floor(i / count))]; };
    const double place = u * count, left = std::floor(place - 0.5), share = place - 0.5 - left;
    answer[0] = at(std::floor(place)), answer[1] = at(left) + (at(left + 1) - at(left)) * share;
    return 2;
}

// Of the plane through three values at the corners x, y, w, u, v: its value at a place, and how much it grows to the right and down.
struct Plane { double here, slope[2]; };

static Plane plane(const double *corners, const double values[3], const double place[2]) {
    const double *a = corners, dx1 = a[5] - a[0], dy1 = a[6] - a[1], dx2 = a[10] - a[0], dy2 = a[11] - a[1];
    const double df1 = values[1] - values[0], df2 = values[2] - values[0], area = dx1 * dy2 - dx2 * dy1;
    const double right = (df1 * dy2 - df2 * dy1) / area, down = (df2 * dx1 - df1 * dx2) / area;
    return {values[0] + right * (place[0] - a[0]) + down * (place[1] - a[1]), {right, down}};
}

static int level(const double v[19], double *answer) {
    double inverse[3], u_over_w[3], v_over_w[3], longest = 0;
    for (int i = 0; i < 3; i++) {
        const double *corner = v + 2 + 5 * i;
        inverse[i] = 1 / corner[2], u_over_w[i] = corner[3] / corner[2], v_over_w[i] = corner[4] / corner[2];
    }
    const Plane q = plane(v + 2, inverse, v + 17);
    const Plane over_w[2] = {plane(v + 2, u_over_w, v + 17), plane(v + 2, v_over_w, v + 17)};
    for (int way = 0; way < 2; way++) {
        double step[2];
        for (int k = 0; k < 2; k++)
            step[k] = (over_w[k].slope[way] - over_w[k].here / q.here * q.slope[way]) / q.here * v[k];
        longest = std::max(longest, std::hypot(step[0], step[1]));
    }
    answer[0] = std::log2(longest);
    return 1;
}

static int formula(const char *name, const double *v, int count, double *answer) {
    const auto is = [&](const char *known) { return std::strcmp(name, known) == 0; };
    if (is("project")) return project(v[0], v[1], v[2], v[3], answer);
    if (is("window")) return window(v, answer);
    if (is("winding")) return winding(v, answer);
    if (is("turn")) return turn(v, answer);
    if (is("normal")) return normal(v, answer);
    if (is("light")) return light(v, answer);
    if (is("texel")) return texel(v[0], v + 1, count - 1, answer);
    return is("level") ? level(v, answer) : 0;
}

