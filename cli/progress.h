#pragma once

#include <cstddef>

namespace facescan {

/// A progress bar on standard error, where that is a terminal; elsewhere nothing.
class Progress {
public:
    /// @param total  steps; a single one needs no bar
    explicit Progress(std::size_t total);
    ~Progress() { hide(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Takes the bar away, so that a line can be printed in its place.
    void hide() const;

    /// Shows it, with one more step done.
    void advance();

private:
    void show() const;

    std::size_t total_;
    std::size_t done_ = 0;
    bool enabled_;
};

}  // namespace facescan
