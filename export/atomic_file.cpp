#include "export/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <deque>
#include <system_error>
#include <utility>

namespace facescan {
namespace fs = std::filesystem;

namespace {

constexpr int kMaxLeftovers = 10'000;
constexpr const char* kTemporaryPrefix = ".facescan-";
constexpr const char* kTemporarySuffix = ".tmp";

/// The name does not grow with the target's, which may be as long as the file system allows.
fs::path temporaryName(const fs::path& target, int attempt) {
    return target.parent_path() / (std::string(kTemporaryPrefix) + std::to_string(::getpid()) +
                                   "-" + std::to_string(attempt) + kTemporarySuffix);
}

/// Folders of that name stay.
void removeFile(const fs::path& file) {
    const bool gone = ::unlink(file.c_str()) == 0 || errno == ENOENT || errno == EISDIR;
    if (!gone)
        throw WriteError("cannot remove " + file.string() +
                         " of an earlier scan: " + std::generic_category().message(errno));
}

}  // namespace

AtomicFile::AtomicFile(fs::path path, Durability durability)
    : path_(std::move(path)), durability_(durability) {
    // Renaming would replace a device or a pipe (/dev/null, /dev/stdout) by a file.
    std::error_code ignored;
    const fs::file_status status = fs::status(path_, ignored);
    if (fs::is_directory(status)) fail("it is a folder");
    if (fs::exists(status) && !fs::is_regular_file(status)) fail("it is not a regular file");
    createTemporary();
}

AtomicFile::~AtomicFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::createTemporary() {
    // Names may be taken by another thread, or left by a process that was killed.
    for (int attempt = 0; attempt < kMaxLeftovers; ++attempt) {
        fs::path name = temporaryName(path_, attempt);
        descriptor_ = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ >= 0) {
            temporary_ = std::move(name);
            return;
        }
        if (errno != EEXIST && errno != EINTR) fail(errno);
    }
    fail("the folder is full of temporary files, .facescan-*.tmp");
}

void AtomicFile::write(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written < 0 && errno != EINTR) fail(errno);
        if (written > 0) bytes.remove_prefix(std::size_t(written));
    }
}

void AtomicFile::finish() {
    if (descriptor_ < 0) return;
    if (durability_ == Durability::synced) {
        while (::fsync(descriptor_) != 0) {
            if (errno != EINTR) fail(errno);
        }
    }
    // Linux closes the descriptor also when it reports EINTR.
    if (::close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR) fail(errno);
}

void AtomicFile::commit() {
    finish();
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail(errno);
    temporary_.clear();
}

void AtomicFile::fail(std::string_view cause) const {
    throw WriteError("cannot write " + path_.string() + ": " + std::string(cause));
}

void AtomicFile::fail(int error_number) const {
    fail(std::generic_category().message(error_number));
}

void writeFiles(std::span<const FileContent> files, Durability durability,
                std::span<const fs::path> obsolete) {
    if (files.empty()) return;
    std::deque<AtomicFile> open;  // a deque, for an AtomicFile does not move
    for (const FileContent& file : files)
        open.emplace_back(file.path, durability).write(file.bytes);
    for (AtomicFile& file : open) file.finish();

    if (files.size() + obsolete.size() > 1) removeFile(files.back().path);
    for (const fs::path& file : obsolete) removeFile(file);
    for (AtomicFile& file : open) file.commit();
}

void removeLeftovers(const fs::path& folder) {
    std::error_code ignored;
    for (fs::directory_iterator entry(folder, ignored); entry != fs::directory_iterator();
         entry.increment(ignored)) {
        const std::string name = entry->path().filename().string();
        if (name.starts_with(kTemporaryPrefix) && name.ends_with(kTemporarySuffix))
            fs::remove(entry->path(), ignored);
    }
}

}  // namespace facescan
