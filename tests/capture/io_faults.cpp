#include "capture/io_faults.h"

#include <sys/stat.h>
#include <sys/types.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <limits>

namespace facescan::test {
namespace {

constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

struct Plan {
    Call call{};
    int calls_before = 0;  ///< those that still succeed
    int error = 0;         ///< 0: no fault is planned
    bool happened = false;
};

Plan plan;
std::size_t most_bytes = kNoLimit;

bool fails(Call call) {
    if (plan.error == 0 || plan.call != call || plan.happened) return false;
    if (plan.calls_before-- > 0) return false;
    plan.happened = true;
    errno = plan.error;
    return true;
}

}  // namespace

FaultyCall::FaultyCall(Call call, int nth, int error) {
    plan = {call, nth - 1, error, false};
}
FaultyCall::~FaultyCall() {
    plan = {};
}
bool FaultyCall::happened() const {
    return plan.happened;
}

ShortTransfers::ShortTransfers(std::size_t most) {
    most_bytes = most;
}
ShortTransfers::~ShortTransfers() {
    most_bytes = kNoLimit;
}

}  // namespace facescan::test

using facescan::test::Call;
using facescan::test::fails;
using facescan::test::most_bytes;

extern "C" {

int __real_open(const char*, int, ...);
int __real_open64(const char*, int, ...);
int __real_fstat(int, struct stat*);
int __real_fstat64(int, struct stat*);
ssize_t __real_read(int, void*, std::size_t);
ssize_t __real_write(int, const void*, std::size_t);
int __real_fsync(int);
int __real_mkdir(const char*, mode_t);
int __real_rename(const char*, const char*);

int __wrap_open(const char* path, int flags, mode_t mode) {
    return fails(Call::open) ? -1 : __real_open(path, flags, mode);
}
int __wrap_open64(const char* path, int flags, mode_t mode) {
    return fails(Call::open) ? -1 : __real_open64(path, flags, mode);
}
int __wrap_fstat(int file, struct stat* status) {
    return fails(Call::fstat) ? -1 : __real_fstat(file, status);
}
int __wrap_fstat64(int file, struct stat* status) {
    return fails(Call::fstat) ? -1 : __real_fstat64(file, status);
}
ssize_t __wrap_read(int file, void* bytes, std::size_t size) {
    return fails(Call::read) ? -1 : __real_read(file, bytes, std::min(size, most_bytes));
}
ssize_t __wrap_write(int file, const void* bytes, std::size_t size) {
    return fails(Call::write) ? -1 : __real_write(file, bytes, std::min(size, most_bytes));
}
int __wrap_fsync(int file) {
    return fails(Call::fsync) ? -1 : __real_fsync(file);
}
int __wrap_mkdir(const char* path, mode_t mode) {
    return fails(Call::mkdir) ? -1 : __real_mkdir(path, mode);
}
int __wrap_rename(const char* from, const char* to) {
    return fails(Call::rename) ? -1 : __real_rename(from, to);
}

}  // extern "C"
