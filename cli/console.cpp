#include "cli/console.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include "cli/errors.h"

namespace facescan {

void print(std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fflush(stdout);
}

void printError(std::string_view message) {
    std::string line = "facescan: ";
    line += message;
    const auto isControl = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
    std::ranges::replace_if(line, isControl, '?');
    line += '\n';
    std::fwrite(line.data(), 1, line.size(), stderr);
}

void requireOutputTaken() {
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
        throw CommandError(EX_IOERR, "cannot write to standard output");
}

}  // namespace facescan
