// Stand-in for the homework's class of this name: what the adapter and the stand-in rasterizer need of it.
#pragma once
#include <eigen3/Eigen/Eigen>

class Triangle {
public:
    Eigen::Vector3f v[3];
    Eigen::Vector3f colour = Eigen::Vector3f::Zero();

    void setVertex(int which, const Eigen::Vector3f &corner);
    const Eigen::Vector3f &getColor() const { return colour; }
};
