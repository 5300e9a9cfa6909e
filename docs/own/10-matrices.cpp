static Matrix product(const Matrix &a, const Matrix &b) {
    Matrix result;
    for (int j = 0; j < 4; j++) {
        const Point column = transform(a, {b[0][j], b[1][j], b[2][j], b[3][j]});
        for (int i = 0; i < 4; i++) result[i][j] = column[i];
    }
    return result;
}

// A turn about the y axis, then one about the x axis, then a move away from the eye.
static Matrix pose(double yaw, double pitch, double distance) {
    const double s = std::sin(yaw), c = std::cos(yaw), t = std::sin(pitch), d = std::cos(pitch);
    const Matrix about_y = {{{c, 0, s, 0}, {0, 1, 0, 0}, {-s, 0, c, 0}, {0, 0, 0, 1}}};
    const Matrix about_x = {{{1, 0, 0, 0}, {0, d, -t, 0}, {0, t, d, 0}, {0, 0, 0, 1}}};
    Matrix matrix = product(about_x, about_y);
    matrix[2][3] = distance;
    return matrix;
}

// Draws a cube of side 2: six faces, each with its normal and its texture coordinates.
template <class Shade> static void draw_cube(const Matrix &pose, Shade shade) {
    for (int axis = 0; axis < 3; axis++)
        for (int end = 0; end < 2; end++) {
            Point normal = {};
            normal[axis] = 2 * end - 1;
            normal = transform(pose, normal);
            // The four corners of the face, clockwise as seen from outside.
            const int p = 1 << (axis + 1) % 3, q = 1 << (axis + 2) % 3;
            const int around[4] = {0, end ? p : q, p | q, end ? q : p};
            Vertex face[4];
            for (int i = 0; i < 4; i++) {
                const Point position = transform(pose, cube_corner(around[i] | end << axis));
                const bool u = around[i] & p, v = around[i] & q;
                face[i] = vertex(transform(perspective(), position), u, v, normal);
            }
            draw({face[0], face[1], face[2]}, shade);
            draw({face[0], face[2], face[3]}, shade);
        }
}

// A cube, turned; its colours are its normals.
static void stage10() {
    empty_scene();
    draw_cube(pose(0.6, -0.5, 4.5), [](std::array<double, 5> v) {
        return colour((1 - v[2]) / 2, (1 - v[3]) / 2, (1 - v[4]) / 2);
    });
}
