#include "taut/core/whole_file.h"

#include <gtest/gtest.h>

#include "image_support.h"

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

// Every write to /dev/full fails with ENOSPC; the temporary name leads there.
TEST(WholeFile, FullDiskIsReportedAndLeavesNothing) {
    const TemporaryFolder folder;
    const auto path = folder / "a.txt";
    test::writeText(path, "old");
    std::filesystem::create_symlink("/dev/full", temporaryName(path));
    const std::string message = messageOf(ErrorKind::inputOutput, [&] { writeWholeFile(path, "new"); });
    EXPECT_NE(message.find("a.txt: cannot write: No space left on device"), std::string::npos) << message;
    EXPECT_EQ(contentOf(path), "old");
    EXPECT_EQ(folder.entryCount(), 1);
}

// A file where a folder should be refuses the superuser too.
TEST(WholeFile, UnwritableFolderIsReported) {
    const TemporaryFolder folder;
    test::writeText(folder / "file", "");
    EXPECT_NE(messageOf(ErrorKind::inputOutput, [&] { writeWholeFile(folder / "file" / "a.txt", "x"); })
                  .find("Not a directory"),
              std::string::npos);
    EXPECT_NE(messageOf(ErrorKind::inputOutput, [&] { prepareFolderOf(folder / "file/deep/a.txt"); })
                  .find("cannot make the folder"),
              std::string::npos);
}

TEST(WholeFile, MissingFolderIsReportedAndAFolderIsNotOverwritten) {
    const TemporaryFolder folder;
    EXPECT_NE(
        messageOf(ErrorKind::inputOutput, [&] { writeWholeFile(folder / "none/a.txt", "x"); }).find("No such file"),
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

TEST(WholeFile, ReadingReportsWhatIsMissingOrAFolder) {
    const TemporaryFolder folder;
    messageOf(ErrorKind::inputOutput, [&] { fileContent(folder / "none"); });
    messageOf(ErrorKind::inputOutput, [&] { fileContent(folder.path()); });
    test::writeText(folder / "a", std::string("x\0y", 3));
    EXPECT_EQ(fileContent(folder / "a"), std::string("x\0y", 3));
}

}  // namespace
}  // namespace taut::core
