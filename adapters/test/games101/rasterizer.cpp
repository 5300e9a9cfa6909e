#include "rasterizer.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/opencv.hpp> // as the homework does

rst::rasterizer::rasterizer(int w, int h) : width(w), height(h), frame(size_t(w) * size_t(h)) {}

rst::pos_buf_id rst::rasterizer::load_positions(const std::vector<Eigen::Vector3f> &positions) {
    loaded_vectors.push_back(positions);
    return {int(loaded_vectors.size()) - 1};
}

rst::ind_buf_id rst::rasterizer::load_indices(const std::vector<Eigen::Vector3i> &indices) {
    loaded_indices.push_back(indices);
    return {int(loaded_indices.size()) - 1};
}

rst::col_buf_id rst::rasterizer::load_colors(const std::vector<Eigen::Vector3f> &colors) {
    return {load_positions(colors).number};
}

void rst::rasterizer::clear(Buffers which) {
    if (int(which) & int(Buffers::Color)) std::fill(frame.begin(), frame.end(), Eigen::Vector3f(0, 0, 0));
}

void rst::rasterizer::set_pixel(const Eigen::Vector3f &point, const Eigen::Vector3f &color) {
    const int x = int(point.x()), y = int(point.y());
    if (x >= 0 && y >= 0 && x < width && y < height) frame[size_t((height - 1 - y) * width + x)] = color;
}

void rst::rasterizer::draw(pos_buf_id positions, ind_buf_id indices, col_buf_id colors, Primitive kind) {
    if (kind != Primitive::Triangle) return;
    const Eigen::Matrix4f all = projection * view * model;
    for (const Eigen::Vector3i &three : loaded_indices[size_t(indices.number)]) {
        Triangle t;
        t.colour = loaded_vectors[size_t(colors.number)][size_t(three[0])];
        for (int i = 0; i < 3; i++) {
            const Eigen::Vector4f p = all * loaded_vectors[size_t(positions.number)][size_t(three[i])].homogeneous();
            const float x = (p.x() / p.w() + 1) * float(width) / 2, y = (p.y() / p.w() + 1) * float(height) / 2;
            t.setVertex(i, {x, y, p.z() / p.w()});
        }
        rasterize_triangle(t);
    }
}

static bool holds(const Eigen::Vector3f *corners, float x, float y) {
    int left = 0, right = 0;
    for (int i = 0; i < 3; i++) {
        const Eigen::Vector3f &from = corners[i], &to = corners[(i + 1) % 3];
        const double turn = double(to.x() - from.x()) * (y - from.y()) - double(to.y() - from.y()) * (x - from.x());
        left += turn > 0;
        right += turn < 0;
    }
    return left == 3 || right == 3;
}

void rst::rasterizer::rasterize_triangle(const Triangle &t) {
    for (int row = 0; row < height; row++)
        for (int column = 0; column < width; column++)
            if (holds(t.v, float(column) + 0.5f, float(row) + 0.5f))
                set_pixel(Eigen::Vector3f(float(column), float(row), 0), t.getColor());
}
