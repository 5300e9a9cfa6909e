/* OpenGL in Mesa's off-screen software renderer: GL_TRIANGLES, and GL_LINES from centre to centre.
   cc -O2 osmesa_triangles.c -o osmesa_triangles -lOSMesa -lm

   OpenGL's y axis points up, and it promises 1 / 2^GL_SUBPIXEL_BITS px: both are declared. Which side of an
   edge has the samples on it, it leaves to the driver. */
#include <GL/osmesa.h>
#include "rasterproof.h"

static OSMesaContext context;
static unsigned *pixels;
static int pixels_wide, pixels_high;

static void begin(int width, int height) {
    if (width != pixels_wide || height != pixels_high) {
        pixels_wide = width;
        pixels_high = height;
        pixels = (unsigned *)realloc(pixels, (size_t)width * (size_t)height * sizeof *pixels);
        if (!pixels || !OSMesaMakeCurrent(context, pixels, GL_UNSIGNED_BYTE, width, height)) {
            fputs("OSMesa has no context of this size\n", stderr);
            exit(1);
        }
        glViewport(0, 0, width, height);
        glMatrixMode(GL_PROJECTION);
        glLoadIdentity();
        glOrtho(0, width, height, 0, -1, 1);
        glDisable(GL_DITHER);
    }
    glClear(GL_COLOR_BUFFER_BIT);
}

/* Row 0 of the picture is at the bottom. */
static void end(rasterproof_set_pixel set_pixel) {
    glFinish();
    for (int y = 0; y < pixels_high; y++)
        for (int x = 0; x < pixels_wide; x++)
            if (pixels[(size_t)(pixels_high - 1 - y) * (size_t)pixels_wide + (size_t)x] & 0xff) set_pixel(x, y);
}

static void triangle(double x0, double y0, double x1, double y1, double x2, double y2, int width, int height,
                     rasterproof_set_pixel set_pixel) {
    begin(width, height);
    glBegin(GL_TRIANGLES);
    glVertex2d(x0, y0);
    glVertex2d(x1, y1);
    glVertex2d(x2, y2);
    glEnd();
    end(set_pixel);
}

static void line(int x0, int y0, int x1, int y1, int width, int height, rasterproof_set_pixel set_pixel) {
    begin(width, height);
    glBegin(GL_LINES);
    glVertex2d(x0 + 0.5, y0 + 0.5);
    glVertex2d(x1 + 0.5, y1 + 0.5);
    glEnd();
    end(set_pixel);
}

int main(void) {
    char name[100], declares[100], version[32] = "", renderer[32] = "";
    GLint bits = 0;
    context = OSMesaCreateContextExt(OSMESA_RGBA, 0, 0, 0, NULL);
    if (!context) { fputs("OSMesa has no context\n", stderr); return 1; }
    begin(64, 64);
    glGetIntegerv(GL_SUBPIXEL_BITS, &bits);
    /* "4.5 (Compatibility Profile) Mesa 22.3.6" and "llvmpipe (LLVM 15.0.6, 256 bits)". */
    sscanf((const char *)glGetString(GL_VERSION), "%*[^M]Mesa %31s", version);
    sscanf((const char *)glGetString(GL_RENDERER), "%31s", renderer);
    snprintf(name, sizeof name, "mesa-%s-%s", version, renderer);
    snprintf(declares, sizeof declares, "grid=%d yup mask line-set batch=64", 1 << (bits < 8 ? bits : 8));
    return rasterproof_serve(name, declares, triangle, line);
}
