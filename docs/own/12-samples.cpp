// Corner i of the rim of a fan of twelve triangles.
static Place rim(int i) {
    const double angle = i * 6.283185307179586 / 12;
    return {std::round((80.5 + 50 * std::cos(angle)) * 256) / 256, std::round((60.5 + 50 * std::sin(angle)) * 256) / 256};
}

// A picture for each of the four samples, and the colour of the triangle in hand.
static std::vector<Colour> sample_pictures[4];
static Colour ink;

static void paint_samples(int x, int y, int mask) {
    for (int s = 0; s < 4; s++)
        if (mask >> s & 1) sample_pictures[s][y * WIDTH + x] = ink;
}

// The mean of the four samples of each pixel, halves rounded up.
static void resolve() {
    for (size_t i = 0; i < picture.size(); i++) {
        int sum[3] = {2, 2, 2};
        for (const std::vector<Colour> &one : sample_pictures)
            sum[0] += one[i].red, sum[1] += one[i].green, sum[2] += one[i].blue;
        picture[i] = {(unsigned char)(sum[0] / 4), (unsigned char)(sum[1] / 4), (unsigned char)(sum[2] / 4)};
    }
}

// The fan with four samples in each pixel, each of one triangle.
static void stage12() {
    empty();
    for (std::vector<Colour> &one : sample_pictures) one = picture;
    for (int i = 0; i < 12; i++) {
        const Place a = rim(i), b = rim(i + 1);
        ink = {(unsigned char)(60 + 15 * i), (unsigned char)(220 - 15 * i), (unsigned char)(90 + 60 * (i % 2))};
        samples(80.5, 60.5, a.x, a.y, b.x, b.y, WIDTH, HEIGHT, paint_samples);
    }
    resolve();
}
