// Adds what it is told to the pixel: blending counts.
#version 450

layout(push_constant) uniform Constants {
    float step;
};

layout(location = 0) out vec4 colour;

void main() {
    colour = vec4(step);
}
