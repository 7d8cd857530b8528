#include "cli/replay_plan.h"

#include <algorithm>
#include <utility>

#include "cli/bundle_name.h"
#include "cli/errors.h"

namespace facescan {
namespace fs = std::filesystem;
namespace {

/// The bundle's path below the output folder.
std::string pathBelow(const std::string& bundle) {
    fs::path path = fs::path(bundle).lexically_normal();
    if (!path.has_filename()) path = path.parent_path();
    if (path.empty() || path.is_absolute() || *path.begin() == "..")
        throw CommandError(EX_USAGE, bundle +
                                         ": with --keep-paths a bundle is named by a path "
                                         "relative to the current folder, and inside it");
    return path.string();
}

}  // namespace

ReplayPlan::ReplayPlan(std::vector<std::string> bundles, fs::path output, ResultFolder naming)
    : bundles_(std::move(bundles)), output_(std::move(output)), naming_(naming) {
    requireDistinctFolders();
}

ReplayJob ReplayPlan::job(std::size_t k) const {
    return {bundles_[k], naming_ == ResultFolder::itself ? output_ : output_ / folderName(k)};
}

std::string ReplayPlan::folderName(std::size_t k) const {
    return naming_ == ResultFolder::by_path ? pathBelow(bundles_[k]) : bundleName(bundles_[k]);
}

void ReplayPlan::requireDistinctFolders() const {
    std::vector<std::pair<std::string, std::size_t>> names;
    names.reserve(size());
    for (std::size_t k = 0; k < size(); ++k) names.emplace_back(folderName(k), k);
    std::ranges::sort(names);
    const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
    const auto twice = std::ranges::adjacent_find(names, same);
    if (twice == names.end()) return;
    throw CommandError(EX_USAGE, bundles_[twice->second] + " and " + bundles_[(twice + 1)->second] +
                                     " have the same name, " + twice->first +
                                     ": replay them into different folders, or with --keep-paths");
}

}  // namespace facescan
