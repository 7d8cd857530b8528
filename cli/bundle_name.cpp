#include "cli/bundle_name.h"

#include <system_error>

#include "cli/errors.h"

namespace facescan {
namespace fs = std::filesystem;

std::string bundleName(const fs::path& bundle) {
    fs::path path = bundle.lexically_normal();
    if (!path.has_filename()) path = path.parent_path();
    if (path.filename() == "." || path.filename() == "..") {
        std::error_code ignored;
        path = fs::weakly_canonical(path, ignored);
    }
    const std::string name = path.filename().string();
    return name.empty() ? "scan" : name;
}

void requireBundle(const fs::path& bundle) {
    std::error_code ignored;
    const fs::file_status status = fs::status(bundle, ignored);
    if (!fs::exists(status)) throw CommandError(EX_NOINPUT, bundle.string() + ": no such folder");
    if (!fs::is_directory(status))
        throw CommandError(EX_NOINPUT, bundle.string() +
                                           ": not a folder; a bundle is a folder with scan.xml "
                                           "and frames.bin");
}

}  // namespace facescan
