#include "cli/output_folders.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "cli/errors.h"

namespace facescan {
namespace {

namespace fs = std::filesystem;

class OutputFoldersTest : public ::testing::Test {
protected:
    void SetUp() override { fs::create_directories(root_); }
    void TearDown() override { fs::remove_all(root_); }

    fs::path root_ = fs::path(::testing::TempDir()) /
                     (std::string("facescan_folders_") +
                      ::testing::UnitTest::GetInstance()->current_test_info()->name());
    OutputFolders folders_;
};

TEST_F(OutputFoldersTest, MakesAllThatIsMissing) {
    folders_.make(root_ / "a/b/");
    EXPECT_TRUE(fs::is_directory(root_ / "a/b"));
}

TEST_F(OutputFoldersTest, LeavesWhatIsToBeKept) {
    folders_.make(root_ / "a/b");
    folders_.keep(root_ / "a/b");
    folders_.removeIfEmpty(root_ / "a/b");
    EXPECT_TRUE(fs::exists(root_ / "a/b"));
}

TEST_F(OutputFoldersTest, RemovesWhatItMadeAndNothingElse) {
    folders_.make(root_ / "a/b");
    folders_.removeIfEmpty(root_ / "a/b");
    EXPECT_FALSE(fs::exists(root_ / "a"));
    EXPECT_TRUE(fs::exists(root_));
}

TEST_F(OutputFoldersTest, LeavesAnEmptyFolderThatWasThereBefore) {
    fs::create_directory(root_ / "a");
    folders_.make(root_ / "a");
    folders_.removeIfEmpty(root_ / "a");
    EXPECT_TRUE(fs::exists(root_ / "a"));
}

TEST_F(OutputFoldersTest, LeavesAFolderWithFilesInIt) {
    folders_.make(root_ / "a");
    std::ofstream(root_ / "a/file").close();
    folders_.removeIfEmpty(root_ / "a");
    EXPECT_TRUE(fs::exists(root_ / "a/file"));
}

TEST_F(OutputFoldersTest, TheLastOfSeveralTakesTheFolderAboveWithIt) {
    folders_.make(root_ / "a/b");
    folders_.make(root_ / "a/c");
    folders_.removeIfEmpty(root_ / "a/b");
    EXPECT_TRUE(fs::exists(root_ / "a/c"));
    folders_.removeIfEmpty(root_ / "a/c");
    EXPECT_FALSE(fs::exists(root_ / "a"));
}

TEST_F(OutputFoldersTest, AFolderThatCannotBeMadeLeavesThoseAboveItUnmade) {
    const std::string too_long(300, 'x');
    EXPECT_THROW(folders_.make(root_ / "a" / too_long), CommandError);
    EXPECT_FALSE(fs::exists(root_ / "a"));
}

}  // namespace
}  // namespace facescan
