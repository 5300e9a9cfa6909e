#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

static const int WIDTH = 160, HEIGHT = 120;

struct Colour { unsigned char red, green, blue; };

// The picture, row by row.
static std::vector<Colour> picture;

static void empty() { picture.assign(WIDTH * HEIGHT, {18, 18, 24}); }

// Sets a pixel; one outside the picture is ignored.
static void put(int x, int y, Colour colour) {
    if (x >= 0 && x < WIDTH && y >= 0 && y < HEIGHT) picture[y * WIDTH + x] = colour;
}

// Stores the picture as PPM, a format without compression.
static void save(const char *path) {
    FILE *file = std::fopen(path, "wb");
    if (!file) return std::perror(path);
    std::fprintf(file, "P6\n%d %d\n255\n", WIDTH, HEIGHT);
    for (Colour c : picture) std::putc(c.red, file), std::putc(c.green, file), std::putc(c.blue, file);
    std::fclose(file);
}

// A disc: every pixel whose centre lies in it. In half pixels the centre of pixel x is 2 x + 1.
static void stage1() {
    empty();
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const int dx = 2 * x + 1 - WIDTH, dy = 2 * y + 1 - HEIGHT;
            if (dx * dx + dy * dy < 100 * 100) put(x, y, {240, 200, 60});
        }
}
