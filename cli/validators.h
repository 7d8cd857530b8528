#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace facescan {

/// Accepts a decimal number within limits, and nothing else: no NaN, no infinity, no hexadecimal.
CLI::Validator numberFrom(double min, double max);

/// The same for whole numbers.
CLI::Validator wholeNumberFrom(int min, int max);

/// Accepts one of some words.
CLI::Validator oneOf(std::vector<std::string> words);

}  // namespace facescan
