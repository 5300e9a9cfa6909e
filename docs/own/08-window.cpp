typedef std::array<double, 6> Borders;
// x, y and the depth.
typedef std::array<double, 3> DeepPlace;

// How far a point of clip space lies inside the six borders of the view volume; negative beyond one of them.
static Borders borders(Point p) {
    return {p[3] + p[0], p[3] - p[0], p[3] + p[1], p[3] - p[1], p[3] + p[2], p[3] - p[2]};
}

// The place in a window x0, y0, x1, y1 of the picture, in pixels, and the depth from 0 to 1.
static DeepPlace in_window(Point p, Point window) {
    const double across = window[0] + (p[0] / p[3] + 1) / 2 * (window[2] - window[0]);
    const double down = window[1] + (1 - p[1] / p[3]) / 2 * (window[3] - window[1]);
    return {across, down, (p[2] / p[3] + 1) / 2};
}

// Points in rows, columns and layers, seen in two windows. What is outside the view volume is left out, and what is far is dark.
static void stage8() {
    empty();
    for (const Point bounds : {Point{5, 5, 65, 115}, Point{75, 30, 155, 90}})
        for (int i = 0; i < 1000; i++) {
            const int layer = i / 100, row = i / 10 % 10, column = i % 10;
            const Point point = {0.9 * (column - 4.5), 0.9 * (row - 4.5), 19.5 - 2 * layer, 1};
            const Point clip = transform(perspective(), point);
            const Borders distances = borders(clip);
            if (*std::min_element(distances.begin(), distances.end()) < 0) continue;
            const DeepPlace place = in_window(clip, bounds);
            const unsigned char light = (unsigned char)std::min(90 + 900 * (1 - place[2]), 255.0);
            put(int(std::floor(place[0])), int(std::floor(place[1])), {light, light, 90});
        }
}
