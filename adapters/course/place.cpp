// The course. Write the function of your step, then: rasterproof course check

// ---- YOUR PLACE: seven functions, empty as they stand ----

// Whole pixels from one to another, both drawn, in drawing order, and nothing outside the window (steps 1 and 2a).
static void line(int x0, int y0, int x1, int y1, int width, int height, rasterproof_set_pixel set_pixel) {
    (void)x0, (void)y0, (void)x1, (void)y1, (void)width, (void)height, (void)set_pixel;
}

// Corners in pixels, y down; set_pixel(x, y) for every pixel drawn (steps 2b, 2c and 7).
static void triangle(double x0, double y0, double x1, double y1, double x2, double y2, int width, int height,
                     rasterproof_set_pixel set_pixel) {
    (void)x0, (void)y0, (void)x1, (void)y1, (void)x2, (void)y2, (void)width, (void)height, (void)set_pixel;
}

// Corners have x, y, z, w, a, b; set_pixel(x, y, z, a, b) for every pixel drawn (steps 3 to 7).
static void values(const rasterproof_corner corners[3], int width, int height, rasterproof_set_values set_pixel) {
    (void)corners, (void)width, (void)height, (void)set_pixel;
}

// As triangle, with four samples: set_pixel(x, y, mask), bit s of the mask is sample s (step 12).
static void samples(double x0, double y0, double x1, double y1, double x2, double y2, int width, int height,
                    rasterproof_set_samples set_pixel) {
    (void)x0, (void)y0, (void)x1, (void)y1, (void)x2, (void)y2, (void)width, (void)height, (void)set_pixel;
}

// Three corners x, y, z of each triangle; set_pixel(x, y, t) once where triangle t is nearest (step 6).
static void depth(const rasterproof_point (*triangles)[3], int count, int width, int height,
                  rasterproof_set_seen set_pixel) {
    (void)triangles, (void)count, (void)width, (void)height, (void)set_pixel;
}

// Corners x, y, z, w of clip space; add_corner for each corner of what z >= -w leaves of them (step 7).
static void clip(const rasterproof_clip_corner corners[3], rasterproof_add_corner add_corner) {
    (void)corners, (void)add_corner;
}

// What the formula "project", "window" and so on gives for these numbers, 16 at most, and how many they are (steps 4, 8 to 11 and 13).
static int formula(const char *name, const double *numbers, int count, double *answer) {
    (void)name, (void)numbers, (void)count, (void)answer;
    return 0;
}

// To be judged with attributes, too, let it be a function of rasterproof_carried_corner (step 7).
static const rasterproof_clip_attributes clip_attributes = nullptr;
static const rasterproof_wide_line wide_line = nullptr;
static const rasterproof_samples area = nullptr;
static const rasterproof_sample_values sample_values = nullptr;

