#include "capture/staged_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <system_error>

#include "capture/samples.h"

namespace facescan {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using namespace test;
namespace fs = std::filesystem;

const Bytes kSome{'s', 'o', 'm', 'e'};
const Bytes kMore{' ', 'm', 'o', 'r', 'e'};

template <typename Action>
std::system_error systemErrorOf(Action&& action) {
    try {
        action();
    } catch (const std::system_error& error) {
        return error;
    }
    ADD_FAILURE() << "no std::system_error was thrown";
    return std::system_error(std::error_code{});
}

TEST(StagedFolder, AppearsWithItsFilesWhenItIsCommitted) {
    const TempFolder parent;
    StagedFolder folder(parent / "scan");
    folder.writeFile("a", {kSome, kMore});
    folder.writeFile("empty", {});
    EXPECT_FALSE(fs::exists(parent / "scan"));
    folder.commit();
    EXPECT_THAT(namesIn(parent.path()), ElementsAre("scan"));
    EXPECT_THAT(namesIn(parent / "scan"), ElementsAre("a", "empty"));
    EXPECT_EQ(readFile(parent / "scan" / "a"), "some more");
}

TEST(StagedFolder, TakesFilesThatOthersWrite) {
    const TempFolder parent;
    StagedFolder folder(parent / "scan");
    writeFile(folder.path() / "mesh.ply", "ply");
    folder.commit();
    EXPECT_EQ(readFile(parent / "scan" / "mesh.ply"), "ply");
}

TEST(StagedFolder, LeavesNothingWhenItIsNotCommitted) {
    const TempFolder parent;
    {
        StagedFolder folder(parent / "scan");
        folder.writeFile("a", {kSome});
        EXPECT_THAT(namesIn(parent.path()), ElementsAre(StartsWith(".scan.part-")));
    }
    EXPECT_THAT(namesIn(parent.path()), IsEmpty());
}

TEST(StagedFolder, TakesThePlaceOfAnEmptyFolder) {
    const TempFolder parent;
    fs::create_directory(parent / "scan");
    StagedFolder folder(parent / "scan/");
    folder.writeFile("a", {kSome});
    folder.commit();
    EXPECT_THAT(namesIn(parent.path()), ElementsAre("scan"));
    EXPECT_THAT(namesIn(parent / "scan"), ElementsAre("a"));
}

TEST(StagedFolder, LeavesAFolderWithFilesAsItIs) {
    const TempFolder parent;
    fs::create_directory(parent / "scan");
    writeFile(parent / "scan" / "mine", "mine");
    {
        StagedFolder folder(parent / "scan");
        const std::system_error error = systemErrorOf([&] { folder.commit(); });
        EXPECT_EQ(std::string(error.what()),
                  (parent / "scan").string() + ": cannot create: Directory not empty");
    }
    EXPECT_THAT(namesIn(parent.path()), ElementsAre("scan"));
    EXPECT_EQ(readFile(parent / "scan" / "mine"), "mine");
}

TEST(StagedFolder, LeavesAFileOfItsNameAsItIs) {
    const TempFolder parent;
    writeFile(parent / "scan", "mine");
    {
        StagedFolder folder(parent / "scan");
        EXPECT_EQ(systemErrorOf([&] { folder.commit(); }).code().value(), ENOTDIR);
    }
    EXPECT_EQ(readFile(parent / "scan"), "mine");
}

TEST(StagedFolder, GoesRoundWhatACrashOrAnotherThreadLeft) {
    const TempFolder parent;
    StagedFolder first(parent / "scan");
    StagedFolder second(parent / "scan");
    EXPECT_NE(first.path(), second.path());
    second.writeFile("a", {kSome});
    second.commit();
    EXPECT_EQ(systemErrorOf([&] { first.commit(); }).code().value(), ENOTEMPTY);
    EXPECT_THAT(namesIn(parent / "scan"), ElementsAre("a"));
}

TEST(StagedFolder, MayBeNamedRelativeToTheWorkingFolder) {
    const TempFolder parent;
    const fs::path before = fs::current_path();
    fs::current_path(parent.path());
    {
        StagedFolder folder("scan");
        folder.commit();
    }
    fs::current_path(before);
    EXPECT_THAT(namesIn(parent.path()), ElementsAre("scan"));
}

TEST(StagedFolder, HasTheRightsThatTheUserGivesNewFolders) {
    const TempFolder parent;
    const mode_t mask = ::umask(027);
    StagedFolder folder(parent / "scan");
    folder.writeFile("a", {kSome});
    folder.commit();
    ::umask(mask);
    EXPECT_EQ(int(fs::status(parent / "scan").permissions()), 0750);
    EXPECT_EQ(int(fs::status(parent / "scan" / "a").permissions()), 0640);
}

TEST(StagedFolder, NeedsItsParent) {
    const std::system_error error = systemErrorOf([] { StagedFolder("/nowhere/scan"); });
    EXPECT_STREQ(error.what(), "/nowhere/scan: cannot create: No such file or directory");
    EXPECT_EQ(systemErrorOf([] { StagedFolder("/dev/null/scan"); }).code().value(), ENOTDIR);
}

TEST(StagedFolder, NeedsAParentThatMayBeWritten) {
    const TempFolder parent;
    fs::permissions(parent.path(), fs::perms::owner_read | fs::perms::others_read |
                                       fs::perms::owner_exec | fs::perms::others_exec);
    {
        const Unprivileged unprivileged;
        EXPECT_EQ(systemErrorOf([&] { StagedFolder(parent / "scan"); }).code().value(), EACCES);
    }
    fs::permissions(parent.path(), fs::perms::owner_all);
    EXPECT_THAT(namesIn(parent.path()), IsEmpty());
}

TEST(StagedFolder, OnAFullDiskIsOneErrorAndLeavesNothing) {
    const TempFolder disk;
    if (::mount("tmpfs", disk.path().c_str(), "tmpfs", 0, "size=64k") != 0)
        GTEST_SKIP() << "a small disk needs the right to mount";
    std::string message;
    {
        StagedFolder folder(disk / "scan");
        const Bytes large(1 << 20);
        message = systemErrorOf([&] { folder.writeFile("frames.bin", {kSome, large}); }).what();
    }
    const std::vector<std::string> left = namesIn(disk.path());
    ::umount(disk.path().c_str());
    EXPECT_EQ(message,
              (disk / "scan/frames.bin").string() + ": cannot write: " + "No space left on device");
    EXPECT_THAT(left, IsEmpty());
}

TEST(StagedFolder, BeyondTheUsersLimitOnFilesIsOneErrorAndLeavesNothing) {
    const TempFolder parent;
    rlimit old{};
    ::getrlimit(RLIMIT_FSIZE, &old);
    const rlimit small{.rlim_cur = 4096, .rlim_max = old.rlim_max};
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    ::setrlimit(RLIMIT_FSIZE, &small);
    int code = 0;
    {
        StagedFolder folder(parent / "scan");
        const Bytes large(8192);
        code = systemErrorOf([&] { folder.writeFile("a", {large}); }).code().value();
    }
    ::setrlimit(RLIMIT_FSIZE, &old);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(code, EFBIG);
    EXPECT_THAT(namesIn(parent.path()), IsEmpty());
}

}  // namespace
}  // namespace facescan
