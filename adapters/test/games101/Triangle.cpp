#include "Triangle.hpp"

void Triangle::setVertex(int which, const Eigen::Vector3f &corner) { v[which] = corner; }
