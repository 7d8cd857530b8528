#pragma once

#include <cstddef>
#include <vector>

namespace facescan {

/// Millimetres in the scanner's frame.
struct Point {
    float x = 0;
    float y = 0;
    float z = 0;
};

/// Points in three planes, by index.
struct PointPlanes {
    std::vector<float> x;
    std::vector<float> y;
    std::vector<float> z;

    std::size_t size() const { return x.size(); }
    void resize(std::size_t size) {
        for (std::vector<float>* plane : {&x, &y, &z}) plane->resize(size);
    }
    /// As many points, all zero.
    void clear(std::size_t size) {
        for (std::vector<float>* plane : {&x, &y, &z}) plane->assign(size, 0.0f);
    }
    Point operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
    void set(std::size_t i, const Point& p) {
        x[i] = p.x;
        y[i] = p.y;
        z[i] = p.z;
    }
};

}  // namespace facescan
