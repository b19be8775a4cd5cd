#include "io/staged_folder.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "io/temp_folder.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;
using testing::TempFolder;

TEST(StagedFolder, MakesTheFolderWithEverythingInIt) {
  const TempFolder folder;
  {
    StagedFolder staged(folder / "new");
    writeFile(staged.path() / "a.txt", "a");
    fs::create_directory(staged.path() / "deep");
    writeFile(staged.path() / "deep/b.txt", "b");
    EXPECT_FALSE(fs::exists(folder / "new"));
    staged.keep(Existing::Refuse);
  }
  EXPECT_EQ(readFile(folder / "new/a.txt"), "a");
  EXPECT_EQ(readFile(folder / "new/deep/b.txt"), "b");
  EXPECT_EQ(folder.fileCount(), 1U) << "something else was left";
}

TEST(StagedFolder, LeavesNothingUnlessItIsKept) {
  const TempFolder folder;
  {
    StagedFolder staged(folder / "new");
    writeFile(staged.path() / "a.txt", "a");
  }
  EXPECT_EQ(folder.fileCount(), 0U);
}

TEST(StagedFolder, ReplacesNothingUnasked) {
  const TempFolder folder;
  fs::create_directory(folder / "old");
  folder.put("old/b.txt", "old");
  {
    StagedFolder staged(folder / "old");
    writeFile(staged.path() / "a.txt", "a");
    writeFile(staged.path() / "b.txt", "new");
    EXPECT_THROW(staged.keep(Existing::Refuse), OutputFailed);
  }
  EXPECT_FALSE(fs::exists(folder / "old/a.txt"));
  EXPECT_EQ(readFile(folder / "old/b.txt"), "old");
  {
    StagedFolder staged(folder / "old");
    writeFile(staged.path() / "b.txt", "new");
    staged.keep(Existing::Replace);
  }
  EXPECT_EQ(readFile(folder / "old/b.txt"), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "old"), {}), 1);
}

TEST(StagedFolder, KeepsWhoMayReadWhatItReplaces) {
  const TempFolder folder;
  fs::create_directory(folder / "old");
  fs::permissions(folder.put("old/secret", "old"), fs::perms::owner_read | fs::perms::owner_write);
  ASSERT_EQ(::chmod((folder / "old").c_str(), 02775), 0);  // what is made in it has its group
  StagedFolder staged(folder / "old");
  EXPECT_EQ(static_cast<int>(fs::status(staged.path()).permissions()), 02700);
  writeFile(staged.path() / "secret", "new");
  staged.keep(Existing::Replace);
  EXPECT_EQ(readFile(folder / "old/secret"), "new");
  EXPECT_EQ(static_cast<int>(fs::status(folder / "old/secret").permissions()), 0600);
}

TEST(StagedFolder, BringsEverythingBackIfAFileHasNoPlace) {
  const TempFolder folder;
  fs::create_directory(folder / "old");
  folder.put("old/a.txt", "old");
  folder.put("old/z", "a file where a folder would go");
  {
    StagedFolder staged(folder / "old");
    writeFile(staged.path() / "a.txt", "new");
    fs::create_directory(staged.path() / "z");
    writeFile(staged.path() / "z/b.txt", "b");
    EXPECT_THROW(staged.keep(Existing::Replace), OutputFailed);
  }
  EXPECT_EQ(readFile(folder / "old/a.txt"), "old");
  EXPECT_EQ(readFile(folder / "old/z"), "a file where a folder would go");
}

TEST(StagedFolder, SaysWhereItCannotBe) {
  const TempFolder folder;
  EXPECT_THROW(StagedFolder(folder / "no/such"), OutputFailed);
  EXPECT_THROW(StagedFolder(folder.put("file", "text")), OutputFailed);
}

}  // namespace
}  // namespace pneuma
