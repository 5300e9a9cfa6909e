// Transforms a corner; its normal is in the world already.
#version 450

layout(push_constant) uniform Constants {
    mat4 matrix;
    vec4 light;
};

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec2 uv_in;

layout(location = 0) out vec3 normal;
layout(location = 1) out vec2 uv;

void main() {
    gl_Position = matrix * vec4(position, 1.0);
    normal = normal_in;
    uv = uv_in;
}
