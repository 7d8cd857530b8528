#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace facescan::test {

/// An empty folder that is gone, with all in it, at the end of a test.
class ScratchFolder {
public:
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

    /// The names of all that lies in it, sorted.
    std::vector<std::string> names() const;

private:
    std::filesystem::path path_;
};

std::string contentOf(const std::filesystem::path& file);
void putFile(const std::filesystem::path& file, const std::string& content);

/// Within its life a file of this process cannot grow beyond a size: a full disk at hand.
class FileSizeLimit {
public:
    explicit FileSizeLimit(unsigned long bytes);
    ~FileSizeLimit();
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
    unsigned long former_limit_;
    void (*former_handler_)(int);
};

}  // namespace facescan::test
