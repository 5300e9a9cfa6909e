/* 1. Put your code into triangle() and line() below; give NULL to rasterproof_serve for what you have not got.
   2. Say in its second argument what your code promises, for example "origin=0,0 rule=none" (docs/protocol.md).
   3. Judge it: cc -O2 starter.c -o starter -lm && rasterproof judge -- ./starter */
#include "rasterproof.h"

/* ---- YOUR PLACE: replace the bodies of these two functions ---- */

static double side(double ax, double ay, double bx, double by, double x, double y) {
    return (bx - ax) * (y - ay) - (by - ay) * (x - ax);
}

/* Corners in pixels, y down; set_pixel(x, y) for every pixel drawn. As it stands it draws every sample on an
   edge, so two neighbours both draw the edge they share. */
static void triangle(double x0, double y0, double x1, double y1, double x2, double y2, int width, int height,
                     rasterproof_set_pixel set_pixel) {
    int left = (int)fmax(0, floor(fmin(x0, fmin(x1, x2)))), right = (int)fmin(width, ceil(fmax(x0, fmax(x1, x2))));
    int top = (int)fmax(0, floor(fmin(y0, fmin(y1, y2)))), bottom = (int)fmin(height, ceil(fmax(y0, fmax(y1, y2))));
    for (int y = top; y < bottom; y++)
        for (int x = left; x < right; x++) {
            double e0 = side(x0, y0, x1, y1, x + 0.5, y + 0.5);
            double e1 = side(x1, y1, x2, y2, x + 0.5, y + 0.5);
            double e2 = side(x2, y2, x0, y0, x + 0.5, y + 0.5);
            if ((e0 >= 0 && e1 >= 0 && e2 >= 0) || (e0 <= 0 && e1 <= 0 && e2 <= 0)) set_pixel(x, y);
        }
}

/* From one pixel to another, both drawn, in drawing order. As it stands, a plain DDA. */
static void line(int x0, int y0, int x1, int y1, int width, int height, rasterproof_set_pixel set_pixel) {
    double dx = (double)x1 - x0, dy = (double)y1 - y0, steps = fmax(fabs(dx), fabs(dy));
    /* Of the longer direction, only the steps inside the window. */
    int along_x = fabs(dx) >= fabs(dy);
    double start = along_x ? x0 : y0, size = along_x ? width : height, forwards = (along_x ? dx : dy) >= 0;
    double first = fmax(0, forwards ? -start : start - size + 1);
    double last = fmin(steps, forwards ? size - 1 - start : start);
    for (double i = first; i <= last; i++)
        set_pixel((int)floor(x0 + dx * i / fmax(steps, 1) + 0.5), (int)floor(y0 + dy * i / fmax(steps, 1) + 0.5));
}

int main(void) { return rasterproof_serve("mine", "batch=64", triangle, line); }
