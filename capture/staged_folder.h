#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>

namespace facescan {

/// A folder of files that appears under its name whole and on disk, or not at all.
///
/// The files go into a hidden folder beside it, ".<name>.part-<process>-<number>". What is not
/// committed is removed, save after a crash.
class StagedFolder {
public:
    /// @param target  does not exist yet, or is an empty folder; its parent exists
    /// @throws std::system_error "<target>: cannot create: <reason>"
    explicit StagedFolder(const std::filesystem::path& target);
    ~StagedFolder();
    StagedFolder(const StagedFolder&) = delete;
    StagedFolder& operator=(const StagedFolder&) = delete;

    /// Where the files stand until commit(), for those who write them by themselves. Each must be
    /// on disk (fsync) before commit().
    const std::filesystem::path& path() const { return staged_; }

    /// Writes a new file, its bytes in several parts, onto the disk.
    /// @throws std::system_error "<target>/<name>: cannot write: <reason>"
    void writeFile(const std::string& name,
                   std::initializer_list<std::span<const std::uint8_t>> parts);

    /// Gives the folder its name, on disk too.
    /// @throws std::system_error; then there is no folder of that name
    void commit();

private:
    std::filesystem::path target_;
    std::filesystem::path staged_;
    bool committed_ = false;
};

}  // namespace facescan
