// A texel, v up, times the light: towards it by its strength, and what every surface gets.
#version 450

layout(push_constant) uniform Constants {
    mat4 matrix;
    vec4 light;
};

layout(set = 0, binding = 0) uniform sampler2D texels;

layout(location = 0) in vec3 normal;
layout(location = 1) in vec2 uv;

layout(location = 0) out vec4 colour;

void main() {
    float lit = max(dot(normalize(normal), light.xyz), 0.0) + light.w;
    colour = vec4(texture(texels, vec2(uv.x, 1.0 - uv.y)).rgb * lit, 1.0);
}
