#include "TRShaderPipeline.h"

#include <cmath>
#include <cstdlib>

namespace TinyRenderer {
using Vertex = TRShaderPipeline::VertexData;

static void keep(int x, int y, unsigned wide, unsigned high, std::vector<Vertex> &found) {
    if (x < 0 || y < 0 || x >= int(wide) || y >= int(high)) return;
    Vertex fragment{};
    fragment.spos = {x, y};
    found.push_back(fragment);
}

static long long turn(glm::ivec2 a, glm::ivec2 b, int x, int y) {
    return (long long)(b.x - a.x) * (y - a.y) - (long long)(b.y - a.y) * (x - a.x);
}

void TRShaderPipeline::rasterize_fill_edge_function(const Vertex &v0, const Vertex &v1, const Vertex &v2,
                                                    const unsigned &wide, const unsigned &high,
                                                    std::vector<Vertex> &found) {
    const glm::ivec2 a = v0.spos, b = v1.spos, c = v2.spos;
    const glm::ivec2 low = glm::min(a, glm::min(b, c)), top = glm::max(a, glm::max(b, c));
    for (int y = glm::max(low.y, 0); y <= glm::min(top.y, int(high) - 1); y++)
        for (int x = glm::max(low.x, 0); x <= glm::min(top.x, int(wide) - 1); x++) {
            const long long e[3] = {turn(a, b, x, y), turn(b, c, x, y), turn(c, a, x, y)};
            const bool clockwise = e[0] >= 0 && e[1] >= 0 && e[2] >= 0, other = e[0] <= 0 && e[1] <= 0 && e[2] <= 0;
            if (clockwise || other) keep(x, y, wide, high, found);
        }
}

void TRShaderPipeline::rasterize_wire_aux(const Vertex &from, const Vertex &to, const unsigned &wide,
                                          const unsigned &high, std::vector<Vertex> &found) {
    const glm::ivec2 way = to.spos - from.spos;
    const int steps = glm::max(std::abs(way.x), std::abs(way.y));
    for (int i = 0; i <= steps; i++) {
        const double t = steps ? double(i) / steps : 0;
        keep(from.spos.x + int(std::lround(way.x * t)), from.spos.y + int(std::lround(way.y * t)), wide, high, found);
    }
}
}
