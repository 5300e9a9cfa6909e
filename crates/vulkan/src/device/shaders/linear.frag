// 1/w and both attributes linear in the window; the last word says that the pixel was drawn.
#version 450

layout(location = 1) noperspective in vec2 linear;

layout(location = 0) out vec4 colour;

void main() {
    colour = vec4(gl_FragCoord.w, linear, 1.0);
}
