#include "capture/byte_source.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "capture/samples.h"

namespace facescan {
namespace {

using testing::HasSubstr;
using namespace test;
namespace fs = std::filesystem;

std::string errorOfOpening(const fs::path& path) {
    return bundleErrorOf([&] { FileSource source(path); }).what();
}

TEST(FileSource, YieldsAFilesBytesInOrder) {
    const TempFolder folder;
    writeFile(folder / "file", "abcdef");
    FileSource source(folder / "file");
    EXPECT_EQ(source.name(), (folder / "file").string());
    EXPECT_EQ(source.size(), 6u);
    Bytes first(2), second(4);
    source.read(first);
    source.read(second);
    EXPECT_EQ(first, (Bytes{'a', 'b'}));
    EXPECT_EQ(second, (Bytes{'c', 'd', 'e', 'f'}));
}

TEST(FileSource, FollowsALinkToAFile) {
    const TempFolder folder;
    writeFile(folder / "file", "abc");
    fs::create_symlink("file", folder / "link");
    EXPECT_EQ(FileSource(folder / "link").size(), 3u);
}

TEST(FileSource, ComplainsOfAMissingFile) {
    EXPECT_EQ(errorOfOpening("/nowhere/frames.bin"),
              "/nowhere/frames.bin: file is missing, expected a regular file that can be read");
}

TEST(FileSource, ComplainsOfALinkThatLeadsNowhere) {
    const TempFolder folder;
    fs::create_symlink("nothing", folder / "link");
    EXPECT_THAT(errorOfOpening(folder / "link"), HasSubstr("file is missing"));
    fs::create_symlink("loop", folder / "loop");
    EXPECT_THAT(errorOfOpening(folder / "loop"), HasSubstr("file is unreadable ("));
}

TEST(FileSource, ComplainsOfAFileThatMayNotBeRead) {
    const TempFolder folder;
    writeFile(folder / "file", "abc");
    ::chmod((folder / "file").c_str(), 0);
    fs::permissions(folder.path(), fs::perms::all);
    const Unprivileged unprivileged;
    EXPECT_THAT(errorOfOpening(folder / "file"),
                HasSubstr("file is unreadable (Permission denied)"));
}

TEST(FileSource, RefusesAFolder) {
    const TempFolder folder;
    EXPECT_EQ(errorOfOpening(folder.path()),
              folder.path().string() + ": file is a folder, expected a regular file");
}

TEST(FileSource, RefusesAPipeWithoutWaitingForItsWriter) {
    const TempFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_THAT(errorOfOpening(folder / "pipe"),
                HasSubstr("file is a pipe, expected a regular file"));
}

TEST(FileSource, RefusesADevice) {
    EXPECT_EQ(errorOfOpening("/dev/zero"), "/dev/zero: file is a device, expected a regular file");
}

TEST(FileSource, ComplainsOfAFileThatShrinksWhileItIsRead) {
    const TempFolder folder;
    writeFile(folder / "file", "abcdef");
    FileSource source(folder / "file");
    fs::resize_file(folder / "file", 3);
    Bytes bytes(6);
    EXPECT_THAT(bundleErrorOf([&] { source.read(bytes); }).what(),
                HasSubstr("file size is less than before, expected 6 bytes"));
}

TEST(MemorySource, YieldsItsBytesInOrderAndNoMore) {
    const Bytes memory{1, 2, 3};
    MemorySource source("memory", memory);
    EXPECT_EQ(source.size(), 3u);
    Bytes first(1), rest(2), more(1);
    source.read(first);
    source.read(rest);
    EXPECT_EQ(first, (Bytes{1}));
    EXPECT_EQ(rest, (Bytes{2, 3}));
    EXPECT_THROW(source.read(more), BundleError);
    EXPECT_EQ(source.size(), 3u);
}

TEST(UniqueFd, ClosesWhatItOwnsOnce) {
    UniqueFd first(::dup(0));
    const int fd = first.get();
    UniqueFd second(std::move(first));
    EXPECT_FALSE(first);
    EXPECT_EQ(second.get(), fd);
    first = std::move(second);
    EXPECT_EQ(first.get(), fd);
    first = UniqueFd();
    EXPECT_EQ(::fcntl(fd, F_GETFD), -1);
}

}  // namespace
}  // namespace facescan
