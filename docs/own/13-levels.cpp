// A square texture of grey texels, row by row.
typedef std::vector<std::vector<double>> Texture;

// The next level: half as wide and half as high, with the means of four texels.
static Texture halved(const Texture &texture) {
    const size_t half = texture.size() / 2;
    Texture next(half, std::vector<double>(half));
    for (size_t y = 0; y < half; y++)
        for (size_t x = 0; x < half; x++) {
            const std::vector<double> &upper = texture[2 * y], &lower = texture[2 * y + 1];
            next[y][x] = (upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1]) / 4;
        }
    return next;
}

// The nearest texel of a texture that repeats.
static double texel_at(const Texture &texture, double u, double v) {
    const double size = double(texture.size());
    const auto at = [&](double part) { return size_t(std::floor(part * size) - size * std::floor(std::floor(part * size) / size)); };
    return texture[at(v)][at(u)];
}

// What is read at a level between two: the nearest texel of both, mixed by the fraction.
static double read(const std::vector<Texture> &levels, double u, double v, double level) {
    level = std::min(std::max(level, 0.0), double(levels.size() - 1));
    const double near = texel_at(levels[size_t(level)], u, v), far = texel_at(levels[size_t(std::ceil(level))], u, v);
    return near + (far - near) * (level - std::floor(level));
}

// A floor that goes far: on the left by the texture alone, on the right by its levels.
static void stage13() {
    empty();
    std::vector<Texture> levels(1, Texture(32, std::vector<double>(32)));
    for (int y = 0; y < 32; y++)
        for (int x = 0; x < 32; x++) levels[0][y][x] = (x / 4 + y / 4) % 2 == 0 ? 0.9 : 0.2;
    while (levels.back().size() > 1) levels.push_back(halved(levels.back()));
    const double floor[4][4] = {{-8, 2, 0, 0}, {8, 2, 3, 0}, {8, 60, 3, 11}, {-8, 60, 0, 11}};
    for (int half = 0; half < 2; half++) {
        // The numbers of the formula of step 13: the size, x, y, w, u, v of each corner, and the place.
        double numbers[19] = {32, 32};
        Grid places[3];
        for (int i = 0; i < 3; i++) {
            const double *from = floor[i == 0 ? 0 : i + half];
            const Point clip = transform(perspective(), {from[0], -1, from[1], 1});
            const Place px = place(clip[0], clip[1], clip[3]);
            const double corner[5] = {px.x, px.y, clip[3], from[2], from[3]};
            std::copy(corner, corner + 5, numbers + 2 + 5 * i);
            places[i] = grid(px.x, px.y);
        }
        box(places, WIDTH, HEIGHT, [&](int x, int y) {
            double l[3], number = 0, u = 0, v = 0;
            if (!weigh(places, {256 * x + 128, 256 * y + 128}, l)) return;
            for (int i = 0; i < 3; i++) l[i] /= numbers[4 + 5 * i];
            const double sum = l[0] + l[1] + l[2];
            for (int i = 0; i < 3; i++) u += l[i] / sum * numbers[5 + 5 * i], v += l[i] / sum * numbers[6 + 5 * i];
            numbers[17] = x + 0.5, numbers[18] = y + 0.5;
            if (x >= WIDTH / 2) level(numbers, &number);
            const double grey = read(levels, u, v, number);
            put(x, y, colour(grey, grey, grey));
        });
    }
}
