#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <string>

namespace facescan {
namespace {

constexpr std::size_t kBarColumns = 40;

void toTerminal(const std::string& text) {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

}  // namespace

Progress::Progress(std::size_t total)
    : total_(total), enabled_(total > 1 && isatty(STDERR_FILENO)) {
    show();
}

void Progress::hide() const {
    if (enabled_) toTerminal("\r\x1b[K");
}

void Progress::advance() {
    ++done_;
    show();
}

void Progress::show() const {
    if (!enabled_) return;
    const std::size_t filled = kBarColumns * done_ / total_;
    toTerminal(
        fmt::format("\r[{:<{}}] {}/{}", std::string(filled, '='), kBarColumns, done_, total_));
}

}  // namespace facescan
