// The course, solved: written from the pages of the steps alone (docs/steps.md).
#include <algorithm>
#include <cmath>
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

