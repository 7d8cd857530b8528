#include "export/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>

#include "export/scratch_folder.h"

namespace facescan::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// The message of the WriteError that a step throws; empty where it throws none.
template <typename Step>
std::string writeErrorOf(Step step) {
    try {
        step();
    } catch (const WriteError& error) {
        return error.what();
    }
    return {};
}

TEST(AtomicFile, AppearsUnderItsNameOnlyOnCommit) {
    const ScratchFolder folder;
    AtomicFile file(folder / "report.json");
    file.write("{\"a\": ");
    file.write("1}");
    file.finish();
    EXPECT_FALSE(fs::exists(folder / "report.json"));
    file.commit();
    EXPECT_EQ(contentOf(folder / "report.json"), "{\"a\": 1}");
    EXPECT_THAT(folder.names(), ElementsAre("report.json"));
}

TEST(AtomicFile, LeavesNothingBehindWithoutCommit) {
    const ScratchFolder folder;
    { AtomicFile(folder / "report.json").write("half a repo"); }
    EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(AtomicFile, ReplacesAFormerFile) {
    const ScratchFolder folder;
    putFile(folder / "report.json", "a former and longer report");
    AtomicFile file(folder / "report.json", Durability::buffered);
    file.write("new");
    file.commit();
    EXPECT_EQ(contentOf(folder / "report.json"), "new");
}

TEST(AtomicFile, KeepsTheFormerFileWhereTheDiskIsFull) {
    const ScratchFolder folder;
    putFile(folder / "report.json", "former");
    const std::string message = writeErrorOf([&] {
        const FileSizeLimit limit(4096);
        AtomicFile file(folder / "report.json");
        file.write(std::string(10'000, 'x'));
        file.commit();
    });
    EXPECT_EQ(message, "cannot write " + (folder / "report.json").string() + ": File too large");
    EXPECT_EQ(contentOf(folder / "report.json"), "former");
    EXPECT_THAT(folder.names(), ElementsAre("report.json"));
}

TEST(AtomicFile, NamesThePathAndTheCauseWhereTheFolderIsMissing) {
    const ScratchFolder folder;
    const fs::path file = folder / "missing" / "report.json";
    EXPECT_EQ(writeErrorOf([&] { AtomicFile unused(file); }),
              "cannot write " + file.string() + ": No such file or directory");
}

TEST(AtomicFile, NamesTheCauseWhereTheFolderIsAFile) {
    const ScratchFolder folder;
    putFile(folder / "file", "");
    EXPECT_THAT(writeErrorOf([&] { AtomicFile unused(folder / "file" / "report.json"); }),
                HasSubstr("Not a directory"));
}

TEST(AtomicFile, NamesTheCauseWhereTheFolderIsNotWritable) {
    const ScratchFolder folder;
    fs::permissions(folder / ".", fs::perms::owner_read | fs::perms::owner_exec);
    const uid_t former = ::geteuid();
    const uid_t unprivileged = former == 0 ? 65534 : former;  // root may write everywhere
    ASSERT_EQ(::seteuid(unprivileged), 0);
    const std::string message = writeErrorOf([&] { AtomicFile unused(folder / "report.json"); });
    ASSERT_EQ(::seteuid(former), 0);
    EXPECT_THAT(message, HasSubstr("/report.json: Permission denied"));
}

TEST(AtomicFile, NeverReplacesAFolderOrAPipe) {
    const ScratchFolder folder;
    fs::create_directory(folder / "folder");
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_THAT(writeErrorOf([&] { AtomicFile unused(folder / "folder"); }),
                HasSubstr("it is a folder"));
    EXPECT_THAT(writeErrorOf([&] { AtomicFile unused(folder / "pipe"); }),
                HasSubstr("it is not a regular file"));
    EXPECT_THAT(folder.names(), ElementsAre("folder", "pipe"));
}

TEST(AtomicFile, TakesAsLongANameAsTheFileSystem) {
    const ScratchFolder folder;
    const std::string longest(255, 'n');
    AtomicFile file(folder / longest);
    file.commit();
    EXPECT_THAT(folder.names(), ElementsAre(longest));
}

TEST(AtomicFile, GivesTheFileTheUsualPermissions) {
    const ScratchFolder folder;
    const mode_t former = ::umask(027);
    AtomicFile file(folder / "report.json");
    file.commit();
    ::umask(former);
    EXPECT_EQ(fs::status(folder / "report.json").permissions(), fs::perms(0640));
}

TEST(AtomicFile, SharesAFolderWithOthersInTheMaking) {
    const ScratchFolder folder;
    AtomicFile a(folder / "a");
    AtomicFile b(folder / "b");
    a.write("of a");
    b.write("of b");
    b.commit();
    a.commit();
    EXPECT_EQ(contentOf(folder / "a"), "of a");
    EXPECT_EQ(contentOf(folder / "b"), "of b");
}

TEST(AtomicFile, WritesIntoTheCurrentFolderByAPlainName) {
    const ScratchFolder folder;
    const fs::path former = fs::current_path();
    fs::current_path(folder / ".");
    AtomicFile file("plain");
    file.commit();
    fs::current_path(former);
    EXPECT_THAT(folder.names(), ElementsAre("plain"));
}

TEST(WriteFiles, WritesAll) {
    const ScratchFolder folder;
    writeFiles(std::array{FileContent{folder / "a", "1"}, FileContent{folder / "b", "2"}});
    EXPECT_EQ(contentOf(folder / "a"), "1");
    EXPECT_EQ(contentOf(folder / "b"), "2");
}

TEST(WriteFiles, WritesNoneWhereOneDoesNotFit) {
    const ScratchFolder folder;
    putFile(folder / "a", "former a");
    const std::string message = writeErrorOf([&] {
        const FileSizeLimit limit(4096);
        writeFiles(std::array{FileContent{folder / "a", "small"},
                              FileContent{folder / "b", std::string(5000, 'x')}});
    });
    EXPECT_THAT(message, HasSubstr("/b: File too large"));
    EXPECT_THAT(message, Not(HasSubstr("\n")));
    EXPECT_EQ(contentOf(folder / "a"), "former a");
    EXPECT_THAT(folder.names(), ElementsAre("a"));
}

TEST(WriteFiles, WritesNoneWhereOneNameIsTakenByAFolder) {
    const ScratchFolder folder;
    fs::create_directory(folder / "b");
    EXPECT_THROW(
        writeFiles(std::array{FileContent{folder / "a", "1"}, FileContent{folder / "b", "2"}}),
        WriteError);
    EXPECT_THAT(folder.names(), ElementsAre("b"));
}

TEST(WriteFiles, RemovesWhatAnEarlierSetLeft) {
    const ScratchFolder folder;
    for (const char* name : {"a", "b", "old"}) putFile(folder / name, "former");
    const std::array obsolete = {folder / "old", folder / "missing"};
    writeFiles(std::array{FileContent{folder / "a", "1"}, FileContent{folder / "b", "2"}},
               Durability::buffered, obsolete);
    EXPECT_THAT(folder.names(), ElementsAre("a", "b"));
    EXPECT_EQ(contentOf(folder / "b"), "2");
}

TEST(WriteFiles, LeavesNoLastFileBesideOnesThatItDoesNotVouchFor) {
    const ScratchFolder folder;
    putFile(folder / "a", "former a");
    putFile(folder / "b", "former b");
    const std::array obsolete = {folder / "a" / "no folder"};
    const std::string message = writeErrorOf([&] {
        writeFiles(std::array{FileContent{folder / "a", "1"}, FileContent{folder / "b", "2"}},
                   Durability::buffered, obsolete);
    });
    EXPECT_THAT(message, HasSubstr("cannot remove"));
    EXPECT_THAT(folder.names(), ElementsAre("a"));
}

TEST(WriteFiles, RemovesNothingWhereOneDoesNotFit) {
    const ScratchFolder folder;
    putFile(folder / "b", "former b");
    putFile(folder / "old", "former");
    const std::array obsolete = {folder / "old"};
    EXPECT_THROW(
        {
            const FileSizeLimit limit(4096);
            writeFiles(std::array{FileContent{folder / "a", "small"},
                                  FileContent{folder / "b", std::string(5000, 'x')}},
                       Durability::synced, obsolete);
        },
        WriteError);
    EXPECT_THAT(folder.names(), ElementsAre("b", "old"));
}

TEST(WriteFiles, LeavesAFolderOfAnObsoleteName) {
    const ScratchFolder folder;
    fs::create_directory(folder / "old");
    const std::array obsolete = {folder / "old"};
    writeFiles(std::array{FileContent{folder / "a", "1"}}, Durability::buffered, obsolete);
    EXPECT_THAT(folder.names(), ElementsAre("a", "old"));
}

TEST(RemoveLeftovers, TakesTemporaryFilesAndNothingElse) {
    const ScratchFolder folder;
    for (const char* name : {".facescan-12-0.tmp", ".facescan.tmp", "a.tmp", ".facescan-12-0"})
        putFile(folder / name, "");
    removeLeftovers(folder / ".");
    EXPECT_THAT(folder.names(), ElementsAre(".facescan-12-0", ".facescan.tmp", "a.tmp"));
    removeLeftovers(folder / "missing");
}

}  // namespace
}  // namespace facescan::test
