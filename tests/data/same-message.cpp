#include "mine.h"
#include <algorithm>
typedef rasterproof_corner Corner;
static double edge(const Corner &p, const Corner &q, double x, double y) { return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x); }
static bool draws(const Corner &p, const Corner &q, double x, double y) {
    const double e = edge(p, q, x, y), dx = q.x - p.x, dy = q.y - p.y;
    return e > 0 || (e == 0 && (dy < 0 || (dy == 0 && dx > 0)));
}
static void affine(const Corner given[3], int width, int height, rasterproof_set_values set) {
    Corner c[] = {given[0], given[1], given[2], given[0], given[1]};
    if (edge(c[0], c[1], c[2].x, c[2].y) < 0) std::swap(c[1], c[2]), c[4] = c[1];
    const double area = edge(c[0], c[1], c[2].x, c[2].y);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double z = 0, a = 0, b = 0;
            bool inside = area != 0;
            for (int i = 0; i < 3; i++) {
                const double part = edge(c[i + 1], c[i + 2], x + 0.5, y + 0.5) / area;
                inside = inside && draws(c[i + 1], c[i + 2], x + 0.5, y + 0.5);
                z += part * c[i].z, a += part * c[i].a, b += part * c[i].b;
            }
            if (inside) set(x, y, z, a, b);
        }
}
static void short_line(int x0, int y0, int x1, int y1, int width, int height, rasterproof_set_pixel set) {
    const int dx = x1 - x0, dy = y1 - y0, n = std::max(abs(dx), abs(dy)), tie = n - ((abs(dx) == n ? dx : dy) < 0);
    for (int i = 0; i < n; i++) {
        const int x = (2 * i * abs(dx) + tie) / (2 * n), y = (2 * i * abs(dy) + tie) / (2 * n);
        set(x0 + (dx < 0 ? -x : x), y0 + (dy < 0 ? -y : y));
    }
}
int main(int, char **words) {
    rasterproof_drawers drawers = {};
    if (*words[1] == 'c') drawers.triangle = triangle;
    if (*words[1] == 'l') drawers.line = short_line;
    if (*words[1] == 'a') drawers.values = affine;
    return rasterproof_serve_all("mine", "batch=1024 range=4096", drawers);
}
