// Lambert's law: the cosine between the normal and the way to the light, and a little light from everywhere.
static double brightness(double x, double y, double z) {
    const double dot = -0.4 * x + 0.7 * y - 0.6 * z;
    const double lengths = std::sqrt((x * x + y * y + z * z) * (0.4 * 0.4 + 0.7 * 0.7 + 0.6 * 0.6));
    return 0.25 + 0.75 * std::max(dot / lengths, 0.0);
}

// The cube, lit, textured and depth-tested.
static void stage11() {
    empty_scene();
    draw_cube(pose(0.6, -0.5, 4.5), [](std::array<double, 5> v) {
        const std::array<double, 3> texel = checker(v[0], v[1]);
        const double light = brightness(v[2], v[3], v[4]);
        return colour(texel[0] * light, texel[1] * light, texel[2] * light);
    });
}
