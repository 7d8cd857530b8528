#pragma once

#include <cstddef>

// System calls that fail when a test says so. The linker leads the calls of this program, though
// not those of shared libraries, through wrappers (--wrap in CMakeLists.txt).

namespace facescan::test {

enum class Call { open, fstat, read, write, fsync, mkdir, rename };

/// As long as it lives: the n-th call (from 1) of a function fails with `error`. A faulty fstat,
/// read or write has no effect on the file, the others neither.
class FaultyCall {
public:
    FaultyCall(Call call, int nth, int error);
    ~FaultyCall();
    FaultyCall(const FaultyCall&) = delete;
    FaultyCall& operator=(const FaultyCall&) = delete;

    bool happened() const;
};

/// As long as it lives: a read or write transfers at most so many bytes.
class ShortTransfers {
public:
    explicit ShortTransfers(std::size_t most);
    ~ShortTransfers();
    ShortTransfers(const ShortTransfers&) = delete;
    ShortTransfers& operator=(const ShortTransfers&) = delete;
};

}  // namespace facescan::test
