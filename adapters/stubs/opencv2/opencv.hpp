// Empty: the rasterizer of GAMES101 homework 2 includes OpenCV, but only its main.cpp uses it.
