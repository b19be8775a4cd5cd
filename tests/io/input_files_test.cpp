#include "io/input_files.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/temp_folder.h"
#include "support/progress_recorder.h"

namespace pneuma {
namespace {

using ::testing::ElementsAre;
using testing::ProgressRecorder;
using testing::TempFolder;

TEST(InputFiles, AreTheRegularOnesByName) {
  const TempFolder folder;
  folder.put("b.txt", "b");
  folder.put("a.txt", "a");
  std::filesystem::create_directory(folder / "sub");
  std::ofstream(folder / "sub" / "c.txt") << "c";
  std::filesystem::create_symlink(folder / "loop", folder / "loop");
  std::filesystem::create_symlink(folder / "nowhere", folder / "broken");
  std::filesystem::create_symlink(folder.path(), folder / "sub" / "up");
  EXPECT_THAT(filesIn(folder.path()), ElementsAre(folder / "a.txt", folder / "b.txt"));
  EXPECT_THAT(filesBelow(folder.path()),
              ElementsAre(folder / "a.txt", folder / "b.txt", folder / "sub" / "c.txt"));
  EXPECT_THROW(filesIn(folder / "nowhere"), InputMissing);
  EXPECT_THROW(filesBelow(folder / "a.txt"), InputMissing);
}

TEST(UnreadableFiles, AreThoseThatAreNoneAndNoFolders) {
  const TempFolder folder;
  folder.put("a.txt", "a");
  std::filesystem::create_directory(folder / "sub");
  std::filesystem::create_symlink(folder / "loop", folder / "loop");
  std::filesystem::create_symlink(folder / "nowhere", folder / "broken");
  std::filesystem::create_symlink(folder / "a.txt", folder / "sound");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(unreadableIn(folder.path()),
              ElementsAre(folder / "broken", folder / "loop", folder / "pipe"));
  EXPECT_THROW(unreadableIn(folder / "nowhere"), InputMissing);
}

TEST(Sha256OfFile, IsThatOfItsContent) {
  const TempFolder folder;
  std::string content(3'000'001, 'x');  // more than two pieces
  content.front() = 'a';
  for (const std::string& text : {std::string(), std::string("abc"), content}) {
    EXPECT_EQ(sha256OfFile(folder.put("file", text)), sha256(text));
  }
  EXPECT_THROW(sha256OfFile(folder / "nowhere"), InputMissing);
  EXPECT_THROW(sha256OfFile(folder.path()), InputMissing);
}

TEST(Sha256OfFile, TakesFilesOfMoreThan4GiB) {
  const TempFolder folder;
  const std::filesystem::path file = folder.put("large", "");
  std::filesystem::resize_file(file, (std::uintmax_t{4} << 30) + 1);  // takes no disk
  ProgressRecorder soon(0.001);                                       // to read it all takes long
  EXPECT_THROW(sha256OfFile(file, Progress(soon)), Cancelled);
}

TEST(Sha256OfFile, StopsOnRequest) {
  const TempFolder folder;
  const std::filesystem::path file = folder.put("file", std::string(std::size_t{8} << 20, 'x'));
  ProgressRecorder halfway(0.5);
  EXPECT_THROW(sha256OfFile(file, Progress(halfway)), Cancelled);
}

}  // namespace
}  // namespace pneuma
