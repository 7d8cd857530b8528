#pragma once

#include <gtest/gtest.h>
#include <zip.h>

#include <filesystem>
#include <string>

namespace facescan::sim {

/// The bytes of a member of a zip file, read by libzip; empty where there is none.
inline std::string zipMember(const std::filesystem::path& path, const std::string& name) {
    zip_t* archive = zip_open(path.c_str(), ZIP_RDONLY, nullptr);
    if (!archive) return {};
    zip_stat_t info;
    std::string bytes;
    if (zip_stat(archive, name.c_str(), 0, &info) == 0) {
        bytes.resize(info.size);
        zip_file_t* file = zip_fopen(archive, name.c_str(), 0);
        EXPECT_EQ(zip_fread(file, bytes.data(), bytes.size()), zip_int64_t(bytes.size()));
        zip_fclose(file);
    }
    zip_discard(archive);
    return bytes;
}

}  // namespace facescan::sim
