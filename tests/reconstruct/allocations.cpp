#include "reconstruct/allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<long> blocks_taken{0};
std::atomic<long> bytes_taken{0};

void* allocate(std::size_t bytes) {
    ++blocks_taken;
    bytes_taken += long(bytes);
    if (void* memory = std::malloc(bytes > 0 ? bytes : 1)) return memory;
    throw std::bad_alloc();
}

}  // namespace

// The array forms call these.
void* operator new(std::size_t bytes) {
    return allocate(bytes);
}

void operator delete(void* memory) noexcept {
    std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace facescan::test {

Allocations allocations() {
    return {blocks_taken, bytes_taken};
}

}  // namespace facescan::test
