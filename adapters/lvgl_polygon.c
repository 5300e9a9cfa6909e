/* LVGL: lv_canvas_draw_polygon and lv_canvas_draw_line on a canvas of 32 bits; drawn is what is at least half white.
   Corners are lv_coord_t, of which 13 bits are positions. Its source is in the crate lvgl-sys; league.json has the build. */
#include <lvgl.h>
#include "rasterproof.h"

enum { SIDE = 1024 };
static lv_color_t pixels[SIDE * SIDE], screen[SIDE * 10];
static lv_obj_t *canvas;

static void flush(lv_disp_drv_t *driver, const lv_area_t *area, lv_color_t *color) {
    (void)area, (void)color;
    lv_disp_flush_ready(driver);
}

static void begin(int width, int height) {
    static lv_disp_draw_buf_t buffer;
    static lv_disp_drv_t driver;
    if (!canvas) {
        lv_init();
        lv_disp_draw_buf_init(&buffer, screen, NULL, SIDE * 10);
        lv_disp_drv_init(&driver);
        driver.draw_buf = &buffer, driver.flush_cb = flush, driver.hor_res = SIDE, driver.ver_res = SIDE;
        lv_disp_drv_register(&driver);
        canvas = lv_canvas_create(lv_scr_act());
    }
    lv_canvas_set_buffer(canvas, pixels, (lv_coord_t)width, (lv_coord_t)height, LV_IMG_CF_TRUE_COLOR);
    lv_canvas_fill_bg(canvas, lv_color_black(), LV_OPA_COVER);
}

static void end(int width, int height, rasterproof_set_pixel set_pixel) {
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) if (pixels[y * width + x].ch.green >= 128) set_pixel(x, y);
}

static void triangle(double x0, double y0, double x1, double y1, double x2, double y2, int width, int height,
                     rasterproof_set_pixel set_pixel) {
    const lv_point_t corners[3] = {
        {(lv_coord_t)x0, (lv_coord_t)y0}, {(lv_coord_t)x1, (lv_coord_t)y1}, {(lv_coord_t)x2, (lv_coord_t)y2}};
    lv_draw_rect_dsc_t how;
    begin(width, height);
    lv_draw_rect_dsc_init(&how);
    how.bg_color = lv_color_white();
    lv_canvas_draw_polygon(canvas, corners, 3, &how);
    end(width, height, set_pixel);
}

static void line(int x0, int y0, int x1, int y1, int width, int height, rasterproof_set_pixel set_pixel) {
    const lv_point_t ends[2] = {{(lv_coord_t)x0, (lv_coord_t)y0}, {(lv_coord_t)x1, (lv_coord_t)y1}};
    lv_draw_line_dsc_t how;
    begin(width, height);
    lv_draw_line_dsc_init(&how);
    how.color = lv_color_white();
    lv_canvas_draw_line(canvas, ends, 2, &how);
    end(width, height, set_pixel);
}

int main(void) {
    char name[64];
    snprintf(name, sizeof name, "lvgl-%d.%d.%d", lv_version_major(), lv_version_minor(), lv_version_patch());
    return rasterproof_serve(name, "grid=1 range=8191 mask line-set batch=64", triangle, line);
}
