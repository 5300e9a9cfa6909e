/* SDL 2: SDL_RenderGeometry and SDL_RenderDrawLine with the software renderer on a surface.
   Its triangles are products of int: with corners within 11585 px all pixels of 100 huge ones were those of its rule,
   within 16383 px a quarter were not. So a range is declared, the power of two below.
   With -DWITH_GFX: SDL2_gfx's filledTrigonRGBA and lineRGBA on the same renderer. Their corners are Sint16,
   and rows are multiplied by 65536 in an int, which overflows in triangles of 32768 rows: the range is half of that.
   cc -O2 sdl2_geometry.c -o sdl2_geometry $(sdl2-config --cflags --libs) -lm
   cc -O2 -DWITH_GFX sdl2_geometry.c -o sdl2_gfx $(sdl2-config --cflags --libs) -lSDL2_gfx -lm */
#include <SDL.h>
#ifdef WITH_GFX
#include <SDL2_gfxPrimitives.h>
#endif
#include "rasterproof.h"

static SDL_Surface *surface;
static SDL_Renderer *renderer;

static void begin(int width, int height) {
    if (!surface || surface->w != width || surface->h != height) {
        if (renderer) SDL_DestroyRenderer(renderer);
        SDL_FreeSurface(surface);
        surface = SDL_CreateRGBSurfaceWithFormat(0, width, height, 32, SDL_PIXELFORMAT_ARGB8888);
        renderer = surface ? SDL_CreateSoftwareRenderer(surface) : NULL;
        if (!renderer) { fprintf(stderr, "SDL: %s\n", SDL_GetError()); exit(1); }
    }
    SDL_SetRenderDrawColor(renderer, 0, 0, 0, 255);
    SDL_RenderClear(renderer);
    SDL_SetRenderDrawColor(renderer, 255, 255, 255, 255);
}

static void end(rasterproof_set_pixel set_pixel) {
    SDL_RenderFlush(renderer);
    for (int y = 0; y < surface->h; y++) {
        const Uint32 *row = (const Uint32 *)((const char *)surface->pixels + y * surface->pitch);
        for (int x = 0; x < surface->w; x++) if (row[x] & 0xffffff) set_pixel(x, y);
    }
}

#ifdef WITH_GFX
static void triangle(double x0, double y0, double x1, double y1, double x2, double y2, int width, int height,
                     rasterproof_set_pixel set_pixel) {
    begin(width, height);
    filledTrigonRGBA(renderer, (Sint16)x0, (Sint16)y0, (Sint16)x1, (Sint16)y1, (Sint16)x2, (Sint16)y2, 255, 255, 255, 255);
    end(set_pixel);
}

static void line(int x0, int y0, int x1, int y1, int width, int height, rasterproof_set_pixel set_pixel) {
    begin(width, height);
    lineRGBA(renderer, (Sint16)x0, (Sint16)y0, (Sint16)x1, (Sint16)y1, 255, 255, 255, 255);
    end(set_pixel);
}
#else
static void triangle(double x0, double y0, double x1, double y1, double x2, double y2, int width, int height,
                     rasterproof_set_pixel set_pixel) {
    const SDL_Color white = {255, 255, 255, 255};
    const SDL_Vertex corners[3] = {{{(float)x0, (float)y0}, white, {0, 0}},
                                   {{(float)x1, (float)y1}, white, {0, 0}},
                                   {{(float)x2, (float)y2}, white, {0, 0}}};
    begin(width, height);
    SDL_RenderGeometry(renderer, NULL, corners, 3, NULL, 0);
    end(set_pixel);
}

static void line(int x0, int y0, int x1, int y1, int width, int height, rasterproof_set_pixel set_pixel) {
    begin(width, height);
    SDL_RenderDrawLine(renderer, x0, y0, x1, y1);
    end(set_pixel);
}
#endif

int main(void) {
    char name[64];
#ifdef WITH_GFX
    snprintf(name, sizeof name, "sdl2_gfx-%d.%d.%d", SDL2_GFXPRIMITIVES_MAJOR, SDL2_GFXPRIMITIVES_MINOR,
             SDL2_GFXPRIMITIVES_MICRO);
    return rasterproof_serve(name, "grid=1 range=16383 mask line-set batch=64", triangle, line);
#else
    SDL_version version;
    SDL_GetVersion(&version);
    snprintf(name, sizeof name, "sdl-%d.%d.%d-software", version.major, version.minor, version.patch);
    return rasterproof_serve(name, "range=8191 mask line-set batch=64", triangle, line);
#endif
}
