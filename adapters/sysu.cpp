// Judges TRShaderPipeline of the SYSU assignment 2: rasterize_fill_edge_function (task 4) and rasterize_wire_aux
// (task 1). Not a line of it changes; with YOURS for the folder of its sources:
//   c++ -std=c++17 -O2 -I YOURS sysu.cpp YOURS/TRShaderPipeline.cpp -o assignment2
//   rasterproof judge -- ./assignment2
// It needs GLM as the assignment does (libglm-dev), but neither SDL nor a window.
//
// Corners are whole pixels, and a fragment's position is its pixel: so the sample of pixel (x, y) lies at (x, y),
// which is declared. Every fragment is seen, in order, also one that comes twice.
#include <vector>

#include "TRShaderPipeline.h"
#include "rasterproof.h"

// The frame has its classes in a namespace; some copies of it have none.
namespace TinyRenderer {}
using namespace TinyRenderer;

struct Judged : TRShaderPipeline {
    void vertexShader(VertexData &) override {}
    void fragmentShader(const VertexData &, glm::vec4 &) override {}
    using TRShaderPipeline::rasterize_wire_aux;
};

static TRShaderPipeline::VertexData vertex(int x, int y) {
    TRShaderPipeline::VertexData made{};
    made.pos = made.cpos = glm::vec4(x, y, 0, 1);
    made.spos = {x, y};
    return made;
}

static void set_all(const std::vector<TRShaderPipeline::VertexData> &points, rasterproof_set_pixel set_pixel) {
    for (const auto &point : points) set_pixel(int(point.spos.x), int(point.spos.y));
}

static void triangle(double x0, double y0, double x1, double y1, double x2, double y2, int width, int height,
                     rasterproof_set_pixel set_pixel) {
    std::vector<TRShaderPipeline::VertexData> points;
    Judged().rasterize_fill_edge_function(vertex(int(x0), int(y0)), vertex(int(x1), int(y1)), vertex(int(x2), int(y2)),
                                          unsigned(width), unsigned(height), points);
    set_all(points, set_pixel);
}

static void line(int x0, int y0, int x1, int y1, int width, int height, rasterproof_set_pixel set_pixel) {
    std::vector<TRShaderPipeline::VertexData> points;
    Judged().rasterize_wire_aux(vertex(x0, y0), vertex(x1, y1), unsigned(width), unsigned(height), points);
    set_all(points, set_pixel);
}

int main() { return rasterproof_serve("sysu-assignment2", "grid=1 origin=0,0 batch=64", triangle, line); }
