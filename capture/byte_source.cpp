#include "capture/byte_source.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "capture/bundle_error.h"

namespace facescan {
namespace {

std::string whyUnread(int error) {
    if (error == ENOENT) return "missing";
    return "unreadable (" + std::generic_category().message(error) + ")";
}

[[noreturn]] void failToRead(const std::string& file, int error) {
    throw BundleError(file, "file", whyUnread(error), "a regular file that can be read");
}

[[noreturn]] void endTooEarly(const ByteSource& source) {
    throw BundleError(source.name(), "file size", "less than before",
                      std::to_string(source.size()) + " bytes, as it had when it was opened");
}

const char* kindOfFile(mode_t mode) {
    switch (mode & S_IFMT) {
        case S_IFDIR:
            return "a folder";
        case S_IFIFO:
            return "a pipe";
        default:
            return "a device";
    }
}

ssize_t readSome(int file, std::span<std::uint8_t> out) {
    ssize_t count;
    do count = ::read(file, out.data(), out.size());
    while (count < 0 && errno == EINTR);
    return count;
}

}  // namespace

FileSource::FileSource(const std::filesystem::path& path) : ByteSource(path.string()) {
    // Without O_NONBLOCK, opening a pipe would wait for a writer.
    file_ = UniqueFd(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
    struct stat status {};
    if (!file_ || ::fstat(file_.get(), &status) != 0) failToRead(name(), errno);
    if (!S_ISREG(status.st_mode))
        throw BundleError(name(), "file", kindOfFile(status.st_mode), "a regular file");
    size_ = std::uint64_t(status.st_size);
}

void FileSource::read(std::span<std::uint8_t> out) {
    while (!out.empty()) {
        const ssize_t count = readSome(file_.get(), out);
        if (count < 0) failToRead(name(), errno);
        if (count == 0) endTooEarly(*this);
        out = out.subspan(std::size_t(count));
    }
}

void MemorySource::read(std::span<std::uint8_t> out) {
    if (out.size() > rest_.size()) endTooEarly(*this);
    std::copy_n(rest_.begin(), out.size(), out.begin());
    rest_ = rest_.subspan(out.size());
}

}  // namespace facescan
