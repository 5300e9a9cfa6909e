// Depth and both attributes in perspective; the last word says that the pixel was drawn.
#version 450

layout(location = 0) in vec2 perspective;

layout(location = 0) out vec4 colour;

void main() {
    colour = vec4(gl_FragCoord.z, perspective, 1.0);
}
