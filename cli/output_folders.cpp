#include "cli/output_folders.h"

#include <string>
#include <system_error>

#include "cli/errors.h"

namespace facescan {
namespace fs = std::filesystem;

void OutputFolders::make(const fs::path& folder) {
    const std::lock_guard lock(mutex_);
    const fs::path absolute = fs::absolute(folder).lexically_normal();
    try {
        makeEach(absolute);
    } catch (const fs::filesystem_error& error) {
        removeEach(absolute);
        throw CommandError(EX_CANTCREAT, "cannot create the folder " + error.path1().string() +
                                             ": " + error.code().message());
    }
}

void OutputFolders::keep(const fs::path& folder) {
    const std::lock_guard lock(mutex_);
    made_.erase(fs::absolute(folder).lexically_normal());
}

void OutputFolders::removeIfEmpty(const fs::path& folder) {
    const std::lock_guard lock(mutex_);
    removeEach(fs::absolute(folder).lexically_normal());
}

void OutputFolders::makeEach(const fs::path& folder) {
    if (fs::is_directory(folder)) return;
    if (folder.has_relative_path()) makeEach(folder.parent_path());
    if (fs::create_directory(folder)) made_.insert(folder);
}

void OutputFolders::removeEach(fs::path folder) {
    for (; folder.has_relative_path(); folder = folder.parent_path()) {
        std::error_code ignored;
        if (!made_.contains(folder)) {
            if (fs::exists(folder, ignored)) return;
            continue;  // it was never made, but those above it may have been
        }
        if (!fs::remove(folder, ignored)) return;  // not empty
        made_.erase(folder);
    }
}

}  // namespace facescan
