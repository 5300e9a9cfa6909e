// The course. Write the function of your step, then: rasterproof course check

// ---- YOUR PLACE: four functions, empty as they stand ----

// Whole pixels from one to another, both drawn, in drawing order (steps 1 to 3).
static void line(int x0, int y0, int x1, int y1, int width, int height, rasterproof_set_pixel set_pixel) {
    (void)x0, (void)y0, (void)x1, (void)y1, (void)width, (void)height, (void)set_pixel;
}

// Corners in pixels, y down; set_pixel(x, y) for every pixel drawn (steps 4 to 7, and 11).
static void triangle(double x0, double y0, double x1, double y1, double x2, double y2, int width, int height,
                     rasterproof_set_pixel set_pixel) {
    (void)x0, (void)y0, (void)x1, (void)y1, (void)x2, (void)y2, (void)width, (void)height, (void)set_pixel;
}

// Corners have x, y, z, w, a, b; set_pixel(x, y, z, a, b) for every pixel drawn (steps 8 to 11).
static void values(const rasterproof_corner corners[3], int width, int height, rasterproof_set_values set_pixel) {
    (void)corners, (void)width, (void)height, (void)set_pixel;
}

// As triangle, with four samples: set_pixel(x, y, mask), bit s of the mask is sample s (step 12).
static void samples(double x0, double y0, double x1, double y1, double x2, double y2, int width, int height,
                    rasterproof_set_samples set_pixel) {
    (void)x0, (void)y0, (void)x1, (void)y1, (void)x2, (void)y2, (void)width, (void)height, (void)set_pixel;
}

