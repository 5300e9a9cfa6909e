// A rasterizer that draws no pixel whose centre lies on an edge: neighbours leave holes.
#include "rasterproof.h"

inline void triangle(double ax, double ay, double bx, double by, double cx, double cy, int width, int height,
                     rasterproof_set_pixel set_pixel) {
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const double px = x + 0.5, py = y + 0.5;
            const double u = (bx - ax) * (py - ay) - (by - ay) * (px - ax);
            const double v = (cx - bx) * (py - by) - (cy - by) * (px - bx);
            const double w = (ax - cx) * (py - cy) - (ay - cy) * (px - cx);
            if ((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0)) set_pixel(x, y);
        }
}
