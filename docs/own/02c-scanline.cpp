// The first column or row whose centre lies at or beyond a coordinate, which is a quotient.
static long long first_centre(wide above, wide below) {
    const wide n = 128 * below - above, steps = 256 * below;
    return -(long long)(n / steps - (n % steps < 0 ? 1 : 0));
}

// The first column whose centre lies on the edge from a down to b or to the right of it, at the height y.
static long long first_column(Grid a, Grid b, long long y) {
    const wide rise = b.y - a.y, run = b.x - a.x;
    return first_centre(a.x * rise + (y - a.y) * run, rise);
}

static void triangle(double x0, double y0, double x1, double y1, double x2, double y2, int width, int height,
                     rasterproof_set_pixel set_pixel) {
    Grid c[3] = {grid(x0, y0), grid(x1, y1), grid(x2, y2)};
    std::stable_sort(c, c + 3, [](Grid a, Grid b) { return a.y < b.y; });
    const long long first = std::max(0ll, first_centre(c[0].y, 1));
    const long long last = std::min<long long>(height, first_centre(c[2].y, 1));
    for (long long y = first; y < last; y++) {
        const long long centre = 256 * y + 128, edge = first_column(c[0], c[2], centre);
        const int upper = centre < c[1].y ? 0 : 1;
        const long long other = first_column(c[upper], c[upper + 1], centre);
        const long long end = std::min<long long>(width, std::max(edge, other));
        for (long long x = std::max(0ll, std::min(edge, other)); x < end; x++) set_pixel(int(x), int(y));
    }
}
