#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace facescan {

/// One bundle to replay.
struct ReplayJob {
    std::filesystem::path bundle;
    std::filesystem::path folder;  ///< of the results
};

/// How the folder of a bundle's results is called.
enum class ResultFolder {
    itself,   ///< the output folder; for a single bundle
    by_name,  ///< in the output folder, bundleName()
    by_path,  ///< in the output folder, the bundle's path as it was given
};

/// Which bundles are replayed, and where to. Holds little more than their names, so that there may
/// be very many.
class ReplayPlan {
public:
    /// @throws CommandError (EX_USAGE) where two bundles would have the same folder, or a path
    ///         leads out of the output folder
    ReplayPlan(std::vector<std::string> bundles, std::filesystem::path output, ResultFolder naming);

    std::size_t size() const { return bundles_.size(); }
    ReplayJob job(std::size_t k) const;

private:
    std::string folderName(std::size_t k) const;
    void requireDistinctFolders() const;

    std::vector<std::string> bundles_;
    std::filesystem::path output_;
    ResultFolder naming_;
};

}  // namespace facescan
