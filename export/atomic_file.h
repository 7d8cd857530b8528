#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace facescan {

/// A file could not be written: "cannot write PATH: CAUSE", in one line.
class WriteError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// What a power cut may cost.
enum class Durability {
    buffered,  ///< a file just written may be lost or empty afterwards; costs no waiting
    synced,    ///< after a power cut the file is whole, in its former or its present content
};

/// A file that appears under its name whole or not at all. The bytes go to a temporary file in the
/// same folder, which commit() renames; without commit() it is removed, and a file that was there
/// before stays as it was.
///
/// Every failure throws WriteError. A process whose RLIMIT_FSIZE may be reached ignores SIGXFSZ.
class AtomicFile {
public:
    /// The folder must exist. What lies at `path` now must be a regular file or nothing.
    explicit AtomicFile(std::filesystem::path path, Durability durability = Durability::synced);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(std::string_view bytes);

    /// Hands the last bytes to the disk, so that only the renaming can still fail. To be called on
    /// each of several files that belong together before the first commit(); optional otherwise.
    void finish();

    /// Gives the file its name. The last call.
    void commit();

private:
    void createTemporary();
    [[noreturn]] void fail(std::string_view cause) const;
    [[noreturn]] void fail(int error_number) const;

    std::filesystem::path path_;
    std::filesystem::path temporary_;  ///< empty when there is none to remove
    Durability durability_;
    int descriptor_ = -1;
};

/// A file to be written: its path and all that it shall contain.
struct FileContent {
    std::filesystem::path path;
    std::string bytes;
};

/// Writes files that belong together. All are complete under temporary names before the first takes
/// its own, so that an error in writing leaves none and changes nothing. The last one vouches for
/// the set: it goes before the others change, and takes its name after all of them, so that where
/// it stands, whenever the process may have been killed, the others stand as they belong to it.
/// @param obsolete  files of an earlier set that go with its last one; they may be missing
void writeFiles(std::span<const FileContent> files, Durability durability = Durability::synced,
                std::span<const std::filesystem::path> obsolete = {});

/// Removes the temporary files that a killed process left in a folder, if there is such a folder.
/// Nothing else may be writing there.
void removeLeftovers(const std::filesystem::path& folder);

}  // namespace facescan
