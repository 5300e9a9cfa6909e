// Stand-in for GAMES101 homework 2's frame: its class with the names that the adapter calls, written anew. It
// fills as homework often does, with samples exactly on an edge left out, so that neighbours leave holes.
#pragma once
#include <vector>

#include "Triangle.hpp"
#include "global.hpp"

namespace rst {
enum class Buffers { Color = 1, Depth = 2 };
inline Buffers operator|(Buffers a, Buffers b) { return Buffers(int(a) | int(b)); }
enum class Primitive { Line, Triangle };
struct pos_buf_id { int number; };
struct ind_buf_id { int number; };
struct col_buf_id { int number; };

class rasterizer {
public:
    rasterizer(int w, int h);
    pos_buf_id load_positions(const std::vector<Eigen::Vector3f> &positions);
    ind_buf_id load_indices(const std::vector<Eigen::Vector3i> &indices);
    col_buf_id load_colors(const std::vector<Eigen::Vector3f> &colors);
    void set_model(const Eigen::Matrix4f &m) { model = m; }
    void set_view(const Eigen::Matrix4f &v) { view = v; }
    void set_projection(const Eigen::Matrix4f &p) { projection = p; }
    void set_pixel(const Eigen::Vector3f &point, const Eigen::Vector3f &color);
    void clear(Buffers which);
    void draw(pos_buf_id positions, ind_buf_id indices, col_buf_id colors, Primitive kind);
    std::vector<Eigen::Vector3f> &frame_buffer() { return frame; }

private:
    void rasterize_triangle(const Triangle &t);

    int width, height;
    Eigen::Matrix4f model, view, projection;
    std::vector<std::vector<Eigen::Vector3f>> loaded_vectors;
    std::vector<std::vector<Eigen::Vector3i>> loaded_indices;
    std::vector<Eigen::Vector3f> frame;
};
}
