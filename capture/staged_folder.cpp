#include "capture/staged_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "capture/unique_fd.h"

namespace facescan {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path& path, const char* action) {
    throw std::system_error(errno, std::generic_category(),
                            path.string() + ": cannot " + std::string(action));
}

/// The path without a slash at its end, so that it has a name.
fs::path named(const fs::path& path) {
    return path.has_filename() ? path : path.parent_path();
}

fs::path parentOf(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// A new folder beside `target`, of a name that no other process or thread takes.
fs::path makeFolderBeside(const fs::path& target) {
    const std::string stem =
        "." + target.filename().string() + ".part-" + std::to_string(::getpid()) + "-";
    for (int number = 0;; ++number) {
        const fs::path folder = parentOf(target) / (stem + std::to_string(number));
        if (::mkdir(folder.c_str(), 0777) == 0) return folder;
        if (errno != EEXIST) fail(target, "create");
    }
}

bool writeAll(int file, std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(file, bytes.data(), bytes.size());
        if (count < 0 && errno != EINTR) return false;
        if (count > 0) bytes = bytes.subspan(std::size_t(count));
    }
    return true;
}

bool syncFolder(const fs::path& folder) {
    const UniqueFd file(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    return file && ::fsync(file.get()) == 0;
}

}  // namespace

StagedFolder::StagedFolder(const fs::path& target)
    : target_(named(target)), staged_(makeFolderBeside(target_)) {}

StagedFolder::~StagedFolder() {
    std::error_code ignored;
    if (!committed_) fs::remove_all(staged_, ignored);
}

void StagedFolder::writeFile(const std::string& name,
                             std::initializer_list<std::span<const std::uint8_t>> parts) {
    const UniqueFd file(
        ::open((staged_ / name).c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    bool written = bool(file);
    for (const std::span<const std::uint8_t> part : parts)
        written = written && writeAll(file.get(), part);
    if (!written || ::fsync(file.get()) != 0) fail(target_ / name, "write");
}

void StagedFolder::commit() {
    if (!syncFolder(staged_)) fail(target_, "write");
    if (std::rename(staged_.c_str(), target_.c_str()) != 0) fail(target_, "create");
    staged_ = target_;
    if (!syncFolder(parentOf(target_))) fail(target_, "write");
    committed_ = true;
}

}  // namespace facescan
