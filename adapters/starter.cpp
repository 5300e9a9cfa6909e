// 1. Put your code into triangle() and line() below; nullptr in main() is what you have not got.
// 2. Say in main() what your code promises, for example "origin=0,0 rule=none" (docs/protocol.md).
// 3. Judge it: c++ -O2 starter.cpp -o starter && rasterproof judge -- ./starter
#include <algorithm>
#include <cmath>

#include "rasterproof.h"

// ---- YOUR PLACE: replace the bodies of these two functions ----

struct Point { double x, y; };

static double side(Point a, Point b, Point p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); }

// Corners in pixels, y down; set_pixel(x, y) for every pixel drawn. As it stands it draws every sample on an
// edge, so two neighbours both draw the edge they share.
static void triangle(double x0, double y0, double x1, double y1, double x2, double y2, int width, int height,
                     rasterproof_set_pixel set_pixel) {
    const Point a{x0, y0}, b{x1, y1}, c{x2, y2};
    const int left = std::max(0.0, std::floor(std::min({x0, x1, x2})));
    const int right = std::min<double>(width, std::ceil(std::max({x0, x1, x2})));
    const int top = std::max(0.0, std::floor(std::min({y0, y1, y2})));
    const int bottom = std::min<double>(height, std::ceil(std::max({y0, y1, y2})));
    for (int y = top; y < bottom; y++)
        for (int x = left; x < right; x++) {
            const Point centre{x + 0.5, y + 0.5};
            const double e0 = side(a, b, centre), e1 = side(b, c, centre), e2 = side(c, a, centre);
            if ((e0 >= 0 && e1 >= 0 && e2 >= 0) || (e0 <= 0 && e1 <= 0 && e2 <= 0)) set_pixel(x, y);
        }
}

// From one pixel to another, both drawn, in drawing order. As it stands, a plain DDA.
static void line(int x0, int y0, int x1, int y1, int width, int height, rasterproof_set_pixel set_pixel) {
    const double dx = double(x1) - x0, dy = double(y1) - y0, steps = std::max(std::abs(dx), std::abs(dy));
    // Of the longer direction, only the steps inside the window.
    const bool along_x = std::abs(dx) >= std::abs(dy), forwards = (along_x ? dx : dy) >= 0;
    const double start = along_x ? x0 : y0, size = along_x ? width : height;
    const double first = std::max(0.0, forwards ? -start : start - size + 1);
    const double last = std::min(steps, forwards ? size - 1 - start : start);
    for (double i = first; i <= last; i++)
        set_pixel(int(std::floor(x0 + dx * i / std::max(steps, 1.0) + 0.5)),
                  int(std::floor(y0 + dy * i / std::max(steps, 1.0) + 0.5)));
}

// What else there is (verbs I, S, D, N and A): write functions in their stead, as `rasterproof course start` has them. And verbs
// W and R: a rasterproof_wide_line, which draws a line with a width, and a rasterproof_samples whose masks are levels from 0 to 255.
// And verb X: a rasterproof_sample_values, which gives covered samples their values.
static const rasterproof_values values = nullptr;
static const rasterproof_samples samples = nullptr;
static const rasterproof_depth depth = nullptr;
static const rasterproof_clip clip = nullptr;
static const rasterproof_clip_attributes clip_attributes = nullptr;
static const rasterproof_wide_line wide_line = nullptr;
static const rasterproof_samples area = nullptr;
static const rasterproof_sample_values sample_values = nullptr;
// And verb Q: the formulas of the pipeline.
static const rasterproof_formula formula = nullptr;

// ---- the line protocol ----

int main() {
    return rasterproof_serve_all("mine", "batch=64",
                                 {triangle, line, values, samples, depth, clip, clip_attributes, wide_line, area, sample_values,
                                  formula});
}
