#include "sim/npz.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "sim/zip_member.h"

namespace facescan::sim {
namespace {

std::filesystem::path writeSample(const std::string& name) {
    NpzWriter npz;
    npz.add("a", {2, 3}, std::vector<float>{1, 2, 3, 4, 5, 6});
    npz.add("b", {2}, std::vector<std::uint32_t>{7, 70000});
    npz.addFlags("c", {1, 2}, std::vector<std::uint8_t>{0, 1});
    const std::filesystem::path path = testing::TempDir() + name;
    npz.write(path);
    return path;
}

TEST(Npz, MembersHaveTheHeaderOfTheNpyFormat) {
    const std::string a = zipMember(writeSample("header.npz"), "a.npy");
    ASSERT_GT(a.size(), 10u);
    EXPECT_EQ(a.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
    const std::size_t header = 10 + std::uint8_t(a[8]) + 256 * std::uint8_t(a[9]);
    EXPECT_EQ(header % 64, 0u);
    EXPECT_EQ(a[header - 1], '\n');
    EXPECT_NE(a.find("{'descr': '<f4', 'fortran_order': False, 'shape': (2,3,), }"),
              std::string::npos);
    EXPECT_EQ(a.size(), header + 6 * sizeof(float));
    float last = 0;
    std::memcpy(&last, a.data() + a.size() - sizeof last, sizeof last);
    EXPECT_EQ(last, 6);
}

TEST(Npz, KeepsTheTypeOfEachArray) {
    const std::filesystem::path path = writeSample("types.npz");
    EXPECT_NE(zipMember(path, "b.npy").find("'<u4'"), std::string::npos);
    EXPECT_NE(zipMember(path, "c.npy").find("'|b1'"), std::string::npos);
}

TEST(Npz, SameArraysGiveTheSameBytes) {
    const auto bytes = [](const std::filesystem::path& path) {
        std::ifstream file(path, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    EXPECT_EQ(bytes(writeSample("one.npz")), bytes(writeSample("two.npz")));
}

TEST(Npz, NamesTheFileThatCannotBeWritten) {
    NpzWriter npz;
    npz.add("a", {1}, std::vector<float>{1});
    try {
        npz.write("/nowhere/a.npz");
        FAIL() << "expected an error";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("/nowhere/a.npz"), std::string::npos);
    }
}

}  // namespace
}  // namespace facescan::sim
