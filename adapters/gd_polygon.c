/* libgd: gdImageFilledPolygon and gdImageLine on a palette image. Corners are int, and crossings are
   quotients of products of int, which overflow from 46341 px on: the range is the power of two below half of that.
   cc -O2 gd_polygon.c -o gd_polygon -lgd -lm */
#include <gd.h>
#include "rasterproof.h"

static gdImagePtr image;

static int begin(int width, int height) {
    if (image) gdImageDestroy(image);
    image = gdImageCreate(width, height);
    if (!image) { fputs("gd: no image\n", stderr); exit(1); }
    gdImageColorAllocate(image, 0, 0, 0);
    return gdImageColorAllocate(image, 255, 255, 255);
}

static void end(rasterproof_set_pixel set_pixel) {
    for (int y = 0; y < gdImageSY(image); y++)
        for (int x = 0; x < gdImageSX(image); x++) if (gdImageGetPixel(image, x, y)) set_pixel(x, y);
}

static void triangle(double x0, double y0, double x1, double y1, double x2, double y2, int width, int height,
                     rasterproof_set_pixel set_pixel) {
    gdPoint corners[3] = {{(int)x0, (int)y0}, {(int)x1, (int)y1}, {(int)x2, (int)y2}};
    const int white = begin(width, height);
    gdImageFilledPolygon(image, corners, 3, white);
    end(set_pixel);
}

static void line(int x0, int y0, int x1, int y1, int width, int height, rasterproof_set_pixel set_pixel) {
    const int white = begin(width, height);
    gdImageLine(image, x0, y0, x1, y1, white);
    end(set_pixel);
}

int main(void) {
    char name[64];
    snprintf(name, sizeof name, "libgd-%s", gdVersionString());
    return rasterproof_serve(name, "grid=1 range=16383 mask line-set batch=64", triangle, line);
}
