#include "rasterproof.h"
#include "mine.h" // void triangle(double x0, ..., double y2, int width, int height, rasterproof_set_pixel set_pixel)
int main() { return rasterproof_serve("mine", "batch=64 range=4096", triangle, nullptr); }
