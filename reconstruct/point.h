#pragma once

namespace facescan {

/// Millimetres in the scanner's frame.
struct Point {
    float x = 0;
    float y = 0;
    float z = 0;
};

}  // namespace facescan
