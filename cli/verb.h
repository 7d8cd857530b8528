#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace facescan {

/// A verb of the command line, and what it does once its options are parsed.
struct Verb {
    CLI::App* command = nullptr;
    std::function<int()> run;  ///< returns the exit status; throws what describeError() knows
};

}  // namespace facescan
