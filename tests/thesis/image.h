#pragma once

#include <cstddef>
#include <vector>

namespace facescan::thesis {

/// An image of doubles, rows from the top.
struct Image {
    Image() = default;
    Image(int columns, int rows)
        : width(columns), height(rows), values(std::size_t(columns) * rows) {}

    double at(int x, int y) const { return values[std::size_t(y) * width + x]; }
    double& at(int x, int y) { return values[std::size_t(y) * width + x]; }

    int width = 0;
    int height = 0;
    std::vector<double> values;
};

/// A pattern and its complement, as the camera saw them. Grey levels 0 … 1.
struct FramePair {
    Image pattern;
    Image complement;
};

}  // namespace facescan::thesis
