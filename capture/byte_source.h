#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>

#include "capture/unique_fd.h"

namespace facescan {

/// The bytes of a file in order, of known number: on disk, or in memory.
class ByteSource {
public:
    explicit ByteSource(std::string name) : name_(std::move(name)) {}
    virtual ~ByteSource() = default;
    ByteSource(const ByteSource&) = delete;
    ByteSource& operator=(const ByteSource&) = delete;

    /// The file's path, for messages.
    const std::string& name() const { return name_; }

    /// Bytes in all.
    virtual std::uint64_t size() const = 0;

    /// Fills `out` with the next bytes. @throws BundleError where they cannot be had
    virtual void read(std::span<std::uint8_t> out) = 0;

private:
    std::string name_;
};

/// A regular file. Anything else of that name (a folder, a pipe, a device) is refused unread.
class FileSource : public ByteSource {
public:
    /// @throws BundleError where there is no such file or it may not be read
    explicit FileSource(const std::filesystem::path& path);

    std::uint64_t size() const override { return size_; }
    void read(std::span<std::uint8_t> out) override;

private:
    UniqueFd file_;
    std::uint64_t size_ = 0;
};

/// Bytes in memory, not owned.
class MemorySource : public ByteSource {
public:
    MemorySource(std::string name, std::span<const std::uint8_t> bytes)
        : ByteSource(std::move(name)), size_(bytes.size()), rest_(bytes) {}

    std::uint64_t size() const override { return size_; }
    void read(std::span<std::uint8_t> out) override;

private:
    std::size_t size_;
    std::span<const std::uint8_t> rest_;
};

}  // namespace facescan
