#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace facescan {

/// What a bundle's results are filed under: the last component of its path, whatever slashes
/// follow; for "." and "..", that of the folder they stand for.
std::string bundleName(const std::filesystem::path& bundle);

/// The names of several bundles. @throws CommandError (EX_USAGE) where two are the same
std::vector<std::string> distinctBundleNames(std::span<const std::filesystem::path> bundles);

/// @throws CommandError (EX_NOINPUT) where there is no such folder
void requireBundle(const std::filesystem::path& bundle);

}  // namespace facescan
