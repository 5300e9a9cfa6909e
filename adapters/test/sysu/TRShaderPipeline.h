// Stand-in for the SYSU assignment's class of this name: what the adapter calls, written anew. It fills with every
// sample on an edge, so that neighbours both draw it, and draws lines whose ties follow the direction.
#pragma once
#include <glm/glm.hpp>
#include <vector>

namespace TinyRenderer {
class TRShaderPipeline {
public:
    struct VertexData {
        glm::vec4 pos;
        glm::vec3 col, nor;
        glm::vec2 tex;
        glm::vec4 cpos;
        glm::ivec2 spos;
    };
    virtual ~TRShaderPipeline() = default;
    virtual void vertexShader(VertexData &vertex) = 0;
    virtual void fragmentShader(const VertexData &data, glm::vec4 &color) = 0;
    static void rasterize_fill_edge_function(const VertexData &a, const VertexData &b, const VertexData &c,
                                             const unsigned &wide, const unsigned &high,
                                             std::vector<VertexData> &found);

protected:
    static void rasterize_wire_aux(const VertexData &a, const VertexData &b, const unsigned &wide,
                                   const unsigned &high, std::vector<VertexData> &found);
};
}
