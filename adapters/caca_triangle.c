/* libcaca: caca_fill_triangle and caca_draw_line on a canvas of characters, each of which is a pixel here. Corners are int;
   slopes are their differences times 65536, which overflow from 32768 px on: the range is half of that.
   cc -O2 caca_triangle.c -o caca_triangle -lcaca -lm */
#include <caca.h>
#include "rasterproof.h"

static caca_canvas_t *canvas;

static void begin(int width, int height) {
    if (!canvas && !(canvas = caca_create_canvas(width, height))) { perror("caca"); exit(1); }
    caca_set_canvas_size(canvas, width, height);
    caca_clear_canvas(canvas);
}

static void end(rasterproof_set_pixel set_pixel) {
    for (int y = 0; y < caca_get_canvas_height(canvas); y++)
        for (int x = 0; x < caca_get_canvas_width(canvas); x++) if (caca_get_char(canvas, x, y) == '#') set_pixel(x, y);
}

static void triangle(double x0, double y0, double x1, double y1, double x2, double y2, int width, int height,
                     rasterproof_set_pixel set_pixel) {
    begin(width, height);
    caca_fill_triangle(canvas, (int)x0, (int)y0, (int)x1, (int)y1, (int)x2, (int)y2, '#');
    end(set_pixel);
}

static void line(int x0, int y0, int x1, int y1, int width, int height, rasterproof_set_pixel set_pixel) {
    begin(width, height);
    caca_draw_line(canvas, x0, y0, x1, y1, '#');
    end(set_pixel);
}

int main(void) {
    char name[64];
    snprintf(name, sizeof name, "libcaca-%s", caca_get_version());
    return rasterproof_serve(name, "grid=1 range=16383 mask line-set batch=64", triangle, line);
}
