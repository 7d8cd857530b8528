#pragma once

#include <stdexcept>

namespace facescan {

/// Drawing is not possible here. The text is one line that says what is missing and what to do.
class RenderError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace facescan
