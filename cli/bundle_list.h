#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace facescan {

/// The paths that a file lists, each ended by a newline, or where the file has a NUL, by a NUL;
/// empty ones are left out.
/// @param file  "-" is standard input
/// @throws CommandError (EX_NOINPUT)
std::vector<std::string> readBundleList(const std::filesystem::path& file);

}  // namespace facescan
