#pragma once

#include <string_view>

// Standard output and standard error. Errors of writing do not interrupt the work;
// requireOutputTaken() reports them at its end.

namespace facescan {

/// Prints at once, also into a pipe.
void print(std::string_view text);

/// Writes the one line "facescan: <message>" to standard error. Control characters, which a path
/// may contain, become ?.
void printError(std::string_view message);

/// @throws CommandError when standard output did not take all that was printed
void requireOutputTaken();

}  // namespace facescan
