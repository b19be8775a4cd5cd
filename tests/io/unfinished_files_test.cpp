#include "io/unfinished_files.h"

#include <cstdlib>
#include <set>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/atomic_file.h"
#include "io/staged_folder.h"
#include "temp_folder.h"

namespace pneuma {
namespace {

using testing::TempFolder;
namespace fs = std::filesystem;

void makeOld(const fs::path& path) {
  const timespec hoursAgo[2] = {{::time(nullptr) - 7200, 0}, {::time(nullptr) - 7200, 0}};
  ASSERT_EQ(::utimensat(AT_FDCWD, path.c_str(), hoursAgo, AT_SYMLINK_NOFOLLOW), 0);
}

TEST(NameAside, IsKnownAgainAndNeverTheSame) {
  std::set<std::string> names;
  for (int n = 0; n < 100; ++n) names.insert(nameAside(PartEnding));
  EXPECT_EQ(names.size(), 100U);
  for (const std::string& name : names) EXPECT_TRUE(isNameAside(name)) << name;
  EXPECT_TRUE(isNameAside(nameAside(StageEnding)));
  for (const char* other :
       {"", ".pneuma-", ".pneuma-.part", ".pneuma-mine.part", ".pneuma-0123456789abcdef",
        ".pneuma-0123456789ABCDEF.part", ".pneuma-0123456789abcdef.part~",
        "x.pneuma-0123456789abcdef.part", ".pneuma-0123456789abcdef0.part"}) {
    EXPECT_FALSE(isNameAside(other)) << other;
  }
}

TEST(RemoveUnfinished, TakesWhatIsOursAndBringsBackWhatWasThere) {
  const TempFolder folder;
  const fs::path aside = folder / nameAside(PartEnding);
  noteUnfinished(aside);
  writeFile(aside, "half");
  const fs::path ours = folder / "ours";
  noteUnfinished(ours);
  writeFile(ours, "whole");
  // Noted because it was not there; then another program was quicker.
  const fs::path others = folder / "others";
  noteUnfinished(others);
  folder.put("others", "whole");
  const fs::path replaced = folder.put("replaced", "old");
  const fs::path second = folder / "second";
  fs::create_hard_link(replaced, second);
  noteReplaced(replaced, second);
  writeFile(replaced, "new");
  // Kept: no longer ours to remove, or to bring back.
  const fs::path kept = folder / "kept";
  noteUnfinished(kept);
  writeFile(kept, "whole");
  EXPECT_TRUE(forgetUnfinished(kept));
  EXPECT_FALSE(forgetUnfinished(kept));
  const fs::path done = folder.put("done", "old");
  fs::create_hard_link(done, folder / "third");
  noteReplaced(done, folder / "third");
  writeFile(done, "new");
  forgetUnfinished(done);
  for (int n = 0; n < 600; ++n) noteUnfinished(folder / std::to_string(n));
  for (int n = 0; n < 600; ++n) writeFile(folder / std::to_string(n), "whole");

  removeUnfinished();

  std::set<std::string> left;
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    left.insert(entry.path().filename());
  }
  EXPECT_EQ(left, (std::set<std::string>{"done", "kept", "others", "replaced", "third"}));
  EXPECT_EQ(readFile(replaced), "old");
  EXPECT_EQ(readFile(done), "new");
}

TEST(RemoveAbandoned, TakesWhatIsOldAndNobodys) {
  const TempFolder folder;
  const fs::path old = folder.put(nameAside(PartEnding), "half");
  const fs::path young = folder.put(nameAside(PartEnding), "half");
  const fs::path foreign = folder.put(".pneuma-mine.part", "whole");
  const fs::path victim = folder.put("victim", "whole");
  const fs::path link = folder / nameAside(PartEnding);
  fs::create_symlink(victim, link);
  const fs::path stage = folder / nameAside(StageEnding);
  fs::create_directories(stage / "sub");
  writeFile(stage / "sub" / "file", "half");
  fs::create_symlink(victim, stage / "link");
  fs::create_directory_symlink(folder.path(), stage / "circle");
  for (const fs::path& path : {old, foreign, victim, link, stage}) makeOld(path);
  removeAbandoned(folder.path());
  EXPECT_FALSE(fs::exists(old));
  EXPECT_FALSE(fs::exists(stage));
  EXPECT_TRUE(fs::exists(young));
  EXPECT_TRUE(fs::exists(foreign));
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(readFile(victim), "whole");
}

TEST(RemoveAbandoned, LeavesWhatIsBeingWritten) {
  const TempFolder folder;
  AtomicFile file(folder / "file");
  StagedFolder staged(folder.path());
  file.write("half");
  writeFile(staged.path() / "other", "whole");
  for (const auto& entry : fs::directory_iterator(folder.path())) makeOld(entry.path());
  removeAbandoned(folder.path() / ".");  // by another name: once is enough for each
  file.commit();
  staged.keep(Existing::Refuse);
  EXPECT_EQ(readFile(folder / "file"), "half");
  EXPECT_EQ(readFile(folder / "other"), "whole");
}

TEST(RemoveUnfinished, TakesWhatThisProgramHasNotPutIntoPlace) {
  const TempFolder folder;
  writeFile(folder / "whole", "whole");
  AtomicFile file(folder / "file");
  const StagedFolder staged(folder.path());
  writeFile(staged.path() / "other", "whole");
  EXPECT_EQ(folder.fileCount(), 3U);
  removeUnfinished();
  EXPECT_EQ(folder.fileCount(), 1U);
  EXPECT_FALSE(fs::exists(staged.path()));
  EXPECT_EQ(readFile(folder / "whole"), "whole");
}

TEST(WriteFile, WritesToWhereALinkLeadsThoughNothingIsThereYet) {
  const TempFolder folder;
  fs::create_symlink("later", folder / "between");
  fs::create_symlink("between", folder / "link");
  writeFile(folder / "link", "new", Existing::Refuse);
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_TRUE(fs::is_symlink(folder / "between"));
  EXPECT_EQ(readFile(folder / "later"), "new");
}

TEST(StagedFolder, ReplacesFilesAtOnceAndBringsAllBackIfOneCannotBeMoved) {
  const TempFolder folder;
  folder.put("a", "old a");
  const fs::path victim = folder.put("victim", "whole");
  fs::create_symlink("victim", folder / "b");
  folder.put("z", "a file where a folder would go");
  const auto fill = [](const StagedFolder& staged) {
    for (const char* name : {"a", "b", "new"}) writeFile(staged.path() / name, "new");
    fs::create_directories(staged.path() / "made" / "anew");
    writeFile(staged.path() / "made" / "anew" / "file", "new");
  };
  StagedFolder staged(folder.path());
  fill(staged);
  fs::create_directory(staged.path() / "z");
  writeFile(staged.path() / "z" / "file", "new");
  EXPECT_THROW(staged.keep(Existing::Replace), std::exception);
  EXPECT_EQ(readFile(folder / "a"), "old a");
  EXPECT_FALSE(fs::exists(folder / "made"));
  EXPECT_TRUE(fs::is_symlink(folder / "b"));
  EXPECT_FALSE(fs::exists(folder / "new"));
  EXPECT_EQ(readFile(folder / "z"), "a file where a folder would go");
  StagedFolder another(folder.path());
  fill(another);
  another.keep(Existing::Replace);
  EXPECT_EQ(readFile(folder / "a"), "new");
  EXPECT_EQ(readFile(folder / "b"), "new");
  EXPECT_EQ(readFile(victim), "whole");
  EXPECT_EQ(readFile(folder / "made" / "anew" / "file"), "new");
}

/// In a process of its own: a limit that was lowered stays. 0 if no image would be left.
int limitAfter() {
  leaveNoCoreDumps();
  rlimit limit{1, 1};
  ::getrlimit(RLIMIT_CORE, &limit);
  return limit.rlim_cur == 0 ? 0 : 1;
}

TEST(CoreDumps, AreNotLeftUnlessAskedFor) {
  rlimit before{};
  ::getrlimit(RLIMIT_CORE, &before);
  if (before.rlim_max == 0) GTEST_SKIP() << "there are none here anyway";
  const rlimit all{before.rlim_max, before.rlim_max};
  ::setrlimit(RLIMIT_CORE, &all);
  ::unsetenv("PNEUMA_CORE_DUMPS");
  EXPECT_EXIT(std::_Exit(limitAfter()), ::testing::ExitedWithCode(0), "");
  ::setenv("PNEUMA_CORE_DUMPS", "1", 1);
  EXPECT_EXIT(std::_Exit(limitAfter()), ::testing::ExitedWithCode(1), "");
  ::unsetenv("PNEUMA_CORE_DUMPS");
}

}  // namespace
}  // namespace pneuma
