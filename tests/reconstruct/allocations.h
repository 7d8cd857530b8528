#pragma once

namespace facescan::test {

/// What this program has taken with operator new so far.
struct Allocations {
    long blocks;
    long bytes;
};

Allocations allocations();

}  // namespace facescan::test
