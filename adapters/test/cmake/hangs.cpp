// The same, but in windows of 16 columns it never comes back.
#include "rasterproof.h"
#include "mine.h"

static void hangs(double ax, double ay, double bx, double by, double cx, double cy, int width, int height,
                  rasterproof_set_pixel set_pixel) {
    while (width == 16) sleep(1);
    triangle(ax, ay, bx, by, cx, cy, width, height, set_pixel);
}
int main() { return rasterproof_serve("hangs", "batch=64 range=4096", hangs, nullptr); }
