// Judges rst::rasterizer of GAMES101 homework 2. Not a line of it changes; with YOURS for its folder:
//   c++ -std=c++17 -O2 -I YOURS -I stubs games101.cpp YOURS/rasterizer.cpp YOURS/Triangle.cpp -o homework2
//   rasterproof judge -- ./homework2
// It needs Eigen as the homework does (libeigen3-dev), but neither OpenCV (stubs stands in for it) nor a window.
//
// A triangle goes the homework's own way: buffers, draw() with three unit matrices, frame_buffer(). Its y axis
// points up, and depth hides a pixel drawn twice: both are declared. All numbers on the way are exact if the frame
// has a power of two for its sides and corners are multiples of 1/256 px within 32768 px: hence the frame below
// and the range. With supersampling a pixel counts as drawn from half its colour on.
#include <vector>

#include "rasterizer.hpp"
#include "rasterproof.h"

static int power_of_two(int least) {
    int side = 1;
    while (side < least) side *= 2;
    return side;
}

static void triangle(double x0, double y0, double x1, double y1, double x2, double y2, int width, int height,
                     rasterproof_set_pixel set_pixel) {
    const int frame_width = power_of_two(width), frame_height = power_of_two(height);
    // To the cube from -1 to 1, y up.
    const auto corner = [=](double x, double y) {
        return Eigen::Vector3f(float(2 * x / frame_width - 1), float(1 - 2 * y / frame_height), 0.0f);
    };
    const std::vector<Eigen::Vector3f> positions{corner(x0, y0), corner(x1, y1), corner(x2, y2)};
    const std::vector<Eigen::Vector3f> colours(3, Eigen::Vector3f(255, 255, 255));
    const std::vector<Eigen::Vector3i> indices{Eigen::Vector3i(0, 1, 2)};

    rst::rasterizer frame(frame_width, frame_height);
    frame.set_model(Eigen::Matrix4f::Identity());
    frame.set_view(Eigen::Matrix4f::Identity());
    frame.set_projection(Eigen::Matrix4f::Identity());
    frame.clear(rst::Buffers::Color | rst::Buffers::Depth);
    const auto position_buffer = frame.load_positions(positions);
    const auto index_buffer = frame.load_indices(indices);
    const auto colour_buffer = frame.load_colors(colours);
    frame.draw(position_buffer, index_buffer, colour_buffer, rst::Primitive::Triangle);

    // Row 0 of the frame is its top, as in the picture that the homework shows.
    const auto &pixels = frame.frame_buffer();
    for (int row = 0; row < height; row++)
        for (int column = 0; column < width; column++)
            if (pixels[size_t(row) * size_t(frame_width) + size_t(column)].x() >= 127.5f) set_pixel(column, row);
}

int main() {
    return rasterproof_serve("games101-homework2", "grid=256 range=32768 yup mask batch=64", triangle, nullptr);
}
