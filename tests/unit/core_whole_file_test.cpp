#include "taut/core/whole_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <thread>

#include "image_support.h"
#include "taut/core/private/file_batch.h"

namespace taut::core {
namespace {

using test::contentOf;
using test::messageOf;
using test::TemporaryFolder;

TEST(WholeFile, AppearsUnderItsNameWithCommitOnly) {
    const TemporaryFolder folder;
    const auto path = folder / "a.txt";
    WholeFile file(path);
    file.write("one ");
    file.write("two");
    EXPECT_FALSE(std::filesystem::exists(path));
    file.commit();
    EXPECT_EQ(contentOf(path), "one two");
    EXPECT_EQ(folder.entryCount(), 1);
}

TEST(WholeFile, AbandonedLeavesTheOldFileUntouchedAndNothingElse) {
    const TemporaryFolder folder;
    const auto path = folder / "a.txt";
    test::writeText(path, "old");
    {
        WholeFile file(path);
        file.write("new");
    }
    EXPECT_EQ(contentOf(path), "old");
    EXPECT_EQ(folder.entryCount(), 1);
}

TEST(WholeFile, FullDiskIsReportedAndLeavesNothing) {
    const TemporaryFolder folder;
    const auto path = folder / "a.txt";
    test::writeText(path, "old");
    const test::FileSizeLimit limit(2);
    const std::string message = messageOf(ErrorKind::inputOutput, [&] { writeWholeFile(path, "new"); });
    EXPECT_NE(message.find("a.txt: cannot write: File too large; make room for it, or write to another disk"),
              std::string::npos)
        << message;
    EXPECT_EQ(contentOf(path), "old");
    EXPECT_EQ(folder.entryCount(), 1);
}

// A file where a folder should be refuses the superuser too.
TEST(WholeFile, UnwritableFolderIsReported) {
    const TemporaryFolder folder;
    test::writeText(folder / "file", "");
    EXPECT_NE(messageOf(
                  ErrorKind::inputOutput, [&] { writeWholeFile(folder / "file" / "a.txt", "x"); })
                  .find("Not a directory"),
              std::string::npos);
    EXPECT_NE(messageOf(ErrorKind::inputOutput, [&] { prepareFolderOf(folder / "file/deep/a.txt"); })
                  .find("cannot make the folder"),
              std::string::npos);
}

TEST(WholeFile, MissingFolderIsReportedAndAFolderIsNotOverwritten) {
    const TemporaryFolder folder;
    EXPECT_NE(messageOf(
                  ErrorKind::inputOutput, [&] { writeWholeFile(folder / "none/a.txt", "x"); })
                  .find("No such file"),
              std::string::npos);
    EXPECT_NE(messageOf(ErrorKind::inputOutput, [&] { writeWholeFile(folder.path(), "x"); }).find("Is a directory"),
              std::string::npos);
}

TEST(WholeFile, PreparingMakesTheFolderAndNothingInIt) {
    const TemporaryFolder folder;
    prepareFolderOf(folder / "a/b/c.txt");
    EXPECT_TRUE(std::filesystem::is_directory(folder / "a/b"));
    EXPECT_TRUE(std::filesystem::is_empty(folder / "a/b"));
}

// A link under the temporary name, laid there by somebody else, leads nowhere.
TEST(WholeFile, FollowsNoLinkAndReplacesWhatAKilledProcessLeft) {
    const TemporaryFolder folder;
    test::writeText(folder / "other", "untouched");
    std::filesystem::create_symlink(folder / "other", temporaryName(folder / "a"));
    writeWholeFile(folder / "a", "new");
    EXPECT_EQ(contentOf(folder / "other"), "untouched");
    EXPECT_FALSE(std::filesystem::is_symlink(folder / "a"));
    test::writeText(temporaryName(folder / "a"), "half a file that was written when");
    writeWholeFile(folder / "a", "newer");
    EXPECT_EQ(contentOf(folder / "a"), "newer");
    EXPECT_EQ(folder.entryCount(), 2);
}

TEST(WholeFile, IsWrittenByOneAtATime) {
    const TemporaryFolder folder;
    WholeFile first(folder / "a");
    const std::string message = messageOf(ErrorKind::inputOutput, [&] { WholeFile second(folder / "a"); });
    EXPECT_NE(message.find("a: another process is writing this file"), std::string::npos) << message;
    first.write("whole");
    first.commit();
    EXPECT_EQ(contentOf(folder / "a"), "whole");
}

TEST(WholeFile, ReadingEndsWhateverIsRead) {
    const TemporaryFolder folder;
    messageOf(ErrorKind::inputOutput, [&] { fileContent("/dev/zero"); });
    test::writeText(folder / "sparse", "");
    std::filesystem::resize_file(folder / "sparse", std::uintmax_t{1} << 40U);
    messageOf(ErrorKind::badContent, [&] { fileContent(folder / "sparse"); });
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    const std::string silent = messageOf(
        ErrorKind::inputOutput, [&] { fileContent(folder / "pipe", mostText, std::chrono::milliseconds(20)); });
    EXPECT_NE(silent.find("timed out"), std::string::npos) << silent;
    std::jthread writer([&] { test::writeText(folder / "pipe", std::string(100000, 'a')); });
    EXPECT_EQ(fileContent(folder / "pipe").size(), 100000U);
}

TEST(WholeFile, ReadingReportsWhatIsMissingOrAFolder) {
    const TemporaryFolder folder;
    messageOf(
        ErrorKind::inputOutput, [&] { fileContent(folder / "none"); });
    messageOf(ErrorKind::inputOutput, [&] { fileContent(folder.path()); });
    test::writeText(folder / "a", std::string("x\0y", 3));
    messageOf(ErrorKind::badContent, [&] { fileContent(folder / "a", 2); });
    EXPECT_EQ(fileContent(folder / "a"), std::string("x\0y", 3));
}

TEST(FileBatch, ChangesAllFilesOrNone) {
    const TemporaryFolder folder;
    const auto text = [&](const char* name) { return contentOf(folder / name); };
    for (const char* name : {"a", "b", "c"}) test::writeText(folder / name, "old");
    {
        FileBatch batch(folder.path());
        writeWholeFile(batch.replace(folder / "a"), "new");
        batch.remove(folder / "b");
    }
    EXPECT_EQ(text("a") + text("b"), "oldold") << "not committed";
    EXPECT_EQ(folder.entryCount(), 3);
    // A folder in the way of the second file stands for a process that ends after the first.
    {
        FileBatch batch(folder.path());
        writeWholeFile(batch.replace(folder / "a"), "new");
        writeWholeFile(batch.replace(folder / "d"), "new");
        std::filesystem::create_directories(folder / "d/full");
        batch.remove(folder / "b");
        messageOf(ErrorKind::inputOutput, [&] { batch.commit(); });
    }
    std::filesystem::remove_all(folder / "d");
    FileBatch::recover(folder.path());
    EXPECT_EQ(text("a") + text("c") + text("d"), "newoldnew");
    EXPECT_FALSE(isThere(folder / "b"));
    EXPECT_EQ(folder.entryCount(), 3);
    FileBatch::recover(folder.path());
    const TemporaryFolder elsewhere;
    test::writeText(elsewhere / "precious", "kept");
    std::filesystem::create_directory_symlink(elsewhere.path(), folder / "link");
    for (const char* list : {"remove ../elsewhere\n", "remove link/precious\n"}) {
        test::writeText(folder / ".changes", list);
        messageOf(ErrorKind::badContent, [&] { FileBatch::recover(folder.path()); });
    }
    EXPECT_EQ(contentOf(elsewhere / "precious"), "kept");
}

}  // namespace
}  // namespace taut::core
