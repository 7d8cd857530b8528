#pragma once

#include <filesystem>
#include <mutex>
#include <set>

namespace facescan {

/// The folders that a run makes for its results, so that those left empty by an error go again.
/// Usable from several threads.
class OutputFolders {
public:
    /// Makes the folder and those above it, as far as they are missing.
    /// @throws CommandError (EX_CANTCREAT); what was made until then is removed
    void make(const std::filesystem::path& folder);

    /// Forgets a folder that has its results: removeIfEmpty() is not called for it any more.
    void keep(const std::filesystem::path& folder);

    /// Removes the folder and those above it, as far as they were made here and are empty.
    void removeIfEmpty(const std::filesystem::path& folder);

private:
    void makeEach(const std::filesystem::path& folder);
    void removeEach(std::filesystem::path folder);

    std::mutex mutex_;
    std::set<std::filesystem::path> made_;
};

}  // namespace facescan
