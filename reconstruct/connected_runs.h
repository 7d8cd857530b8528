#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace facescan {

// Runs of cells that touch make up pieces (disjoint sets, with path halving): each run's
// `connected` is the index of another run of its piece, or its own in the piece's root, its first
// run.

/// The root of a run's piece.
template <typename Run>
std::uint32_t rootOf(std::vector<Run>& runs, std::uint32_t i) {
    while (runs[i].connected != i) {
        runs[i].connected = runs[runs[i].connected].connected;
        i = runs[i].connected;
    }
    return i;
}

/// Makes one piece of those of two runs. Where they were two, calls merge(root, other) with the
/// root that stays one and the one that no longer is.
template <typename Run, typename Merge>
void joinRuns(std::vector<Run>& runs, std::uint32_t a, std::uint32_t b, Merge merge) {
    a = rootOf(runs, a);
    b = rootOf(runs, b);
    if (a == b) return;
    if (a > b) std::swap(a, b);
    runs[b].connected = a;
    merge(runs[a], runs[b]);
}

}  // namespace facescan
