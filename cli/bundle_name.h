#pragma once

#include <filesystem>
#include <string>

namespace facescan {

/// What a bundle's results are filed under: the last component of its path, whatever slashes
/// follow; for "." and "..", that of the folder they stand for.
std::string bundleName(const std::filesystem::path& bundle);

/// @throws CommandError (EX_NOINPUT) where there is no such folder
void requireBundle(const std::filesystem::path& bundle);

}  // namespace facescan
