#include "cli/bundle_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "cli/errors.h"

namespace facescan {
namespace {

using namespace std::string_literals;
using testing::ElementsAre;
using testing::IsEmpty;

class BundleListTest : public testing::Test {
protected:
    void TearDown() override { std::filesystem::remove(file_); }

    std::vector<std::string> read(const std::string& text) {
        std::ofstream(file_, std::ios::binary) << text;
        return readBundleList(file_);
    }

    std::filesystem::path file_ = std::filesystem::path(testing::TempDir()) /
                                  (std::string("facescan_list_") +
                                   testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(BundleListTest, HasAPathALine) {
    EXPECT_THAT(read("a\nb c\n"), ElementsAre("a", "b c"));
}

TEST_F(BundleListTest, NeedsNoNewlineAtTheEndAndSkipsEmptyLines) {
    EXPECT_THAT(read("\na\n\nb"), ElementsAre("a", "b"));
    EXPECT_THAT(read(""), IsEmpty());
}

TEST_F(BundleListTest, WithNulsPathsMayHoldNewlines) {
    EXPECT_THAT(read("a\nb\0c\0"s), ElementsAre("a\nb", "c"));
}

TEST_F(BundleListTest, MayBeLongerThanAnyBuffer) {
    std::string text;
    for (int k = 0; k < 100'000; ++k) text += "scans/" + std::to_string(k) + "\n";
    const std::vector<std::string> paths = read(text);
    ASSERT_EQ(paths.size(), 100'000u);
    EXPECT_EQ(paths.back(), "scans/99999");
}

TEST_F(BundleListTest, ThatCannotBeReadIsAMissingInput) {
    for (const std::filesystem::path& file :
         {std::filesystem::path("/nonexistent"), std::filesystem::path(testing::TempDir())}) {
        try {
            readBundleList(file);
            FAIL() << file;
        } catch (const CommandError& error) {
            EXPECT_EQ(error.status(), EX_NOINPUT);
        }
    }
}

}  // namespace
}  // namespace facescan
