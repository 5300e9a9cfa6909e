// Takes clip coordinates as they are and hands the two attributes on twice.
#version 450

layout(location = 0) in vec4 position;
layout(location = 1) in vec2 attributes;

layout(location = 0) out vec2 perspective;
layout(location = 1) noperspective out vec2 linear;

void main() {
    gl_Position = position;
    perspective = attributes;
    linear = attributes;
}
