#include "io/atomic_file.h"

#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "core/error.h"
#include "temp_folder.h"

namespace pneuma {
namespace {

using ::testing::HasSubstr;
using testing::TempFolder;
namespace fs = std::filesystem;

template <class F>
std::string messageOf(F&& f) {
  try {
    f();
  } catch (const Error& error) {
    return std::to_string(static_cast<int>(error.code())) + " " + error.what();
  }
  return "no error";
}

TEST(WriteFile, ReadsBackEqual) {
  const TempFolder folder;
  const std::string content("a\0b\r\n\xff", 6);
  writeFile(folder / "file", content);
  EXPECT_EQ(readFile(folder / "file"), content);
  writeFile(folder / "file", "");
  EXPECT_EQ(readFile(folder / "file"), "");
  EXPECT_EQ(folder.fileCount(), 1U);
}

TEST(WriteFile, KeepsThePermissionsOfTheFileItReplaces) {
  const TempFolder folder;
  const fs::path path = folder.put("file", "old");
  ASSERT_EQ(::chmod(path.c_str(), 0640), 0);
  writeFile(path, "new");
  EXPECT_EQ(readFile(path), "new");
  EXPECT_EQ(static_cast<int>(fs::status(path).permissions()), 0640);
}

TEST(WriteFile, HidesWhatItWritesAside) {
  const TempFolder folder;
  const fs::path path = folder.put("secret", "old");
  ASSERT_EQ(::chmod(path.c_str(), 0644), 0);
  const AtomicFile file(path);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path())) {
    const int mode = static_cast<int>(fs::status(entry).permissions());
    EXPECT_EQ(mode, entry.path() == path ? 0644 : 0600) << entry.path();
  }
  EXPECT_EQ(folder.fileCount(), 2U);
}

TEST(WriteFile, KeepsTheGroupOfTheFileItReplaces) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root may give a file any group";
  const TempFolder folder;
  const fs::path path = folder.put("shared", "old");
  ASSERT_EQ(::chown(path.c_str(), static_cast<uid_t>(-1), 12345), 0);
  ASSERT_EQ(::chmod(path.c_str(), 0640), 0);
  writeFile(path, "new");

  struct stat status {};

  ASSERT_EQ(::stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_gid, 12345U);
  EXPECT_EQ(status.st_mode & 07777U, 0640U);
}

TEST(WriteFile, WritesThroughASymbolicLink) {
  const TempFolder folder;
  folder.put("target", "old");
  fs::create_symlink("target", folder / "link");
  writeFile(folder / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(readFile(folder / "target"), "new");
}

TEST(WriteFile, RefusesAnExistingFileIfAsked) {
  const TempFolder folder;
  const fs::path path = folder.put("file", "old");
  EXPECT_THAT(messageOf([&] { writeFile(path, "new", Existing::Refuse); }),
              HasSubstr("exists already"));
  EXPECT_THAT(messageOf([&] { requireWritable(path, Existing::Refuse); }),
              HasSubstr("exists already"));
  EXPECT_EQ(readFile(path), "old");
  writeFile(folder / "other", "new", Existing::Refuse);
  EXPECT_EQ(readFile(folder / "other"), "new");
  EXPECT_EQ(folder.fileCount(), 2U);
}

struct BadPlace {
  std::string path;  ///< below a folder with a regular file "file" and a folder "folder"
  std::string reason;
};

void PrintTo(const BadPlace& place, std::ostream* out) { *out << place.path; }

class WriteFileTo : public ::testing::TestWithParam<BadPlace> {};

TEST_P(WriteFileTo, FailsWithAReasonAndLeavesNothing) {
  const TempFolder folder;
  folder.put("file", "old");
  fs::create_directory(folder / "folder");
  const fs::path path = folder / GetParam().path;  // an absolute path replaces the folder
  for (const auto& act : {std::function([&] { writeFile(path, "new"); }),
                          std::function([&] { requireWritable(path); })}) {
    const std::string message = messageOf(act);
    EXPECT_THAT(message, HasSubstr(GetParam().reason));
    EXPECT_THAT(message, HasSubstr("6 cannot write \"" + path.string()));
  }
  EXPECT_EQ(folder.fileCount(), 2U);
  EXPECT_EQ(readFile(folder / "file"), "old");
}

INSTANTIATE_TEST_SUITE_P(Places, WriteFileTo,
                         ::testing::Values(BadPlace{"missing/file", "does not exist"},
                                           BadPlace{"file/below", "is not a folder"},
                                           BadPlace{"folder", "it is a folder"},
                                           BadPlace{"folder/", "it names a folder"},
                                           BadPlace{"/dev/full", "device"},
                                           BadPlace{"/proc/pneuma", "/proc"},
                                           BadPlace{std::string(300, 'x'), "too long"}));

TEST(WriteFile, SaysThatTheSystemTakesNoMoreAndLeavesNothing) {
  const TempFolder folder;
  folder.put("file", "old");
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  const auto oldHandler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = limit;
  small.rlim_cur = 1000;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message =
      messageOf([&] { writeFile(folder / "file", std::string(5000, 'x')); });
  ::setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, oldHandler);
  EXPECT_THAT(message, HasSubstr("larger than the system allows"));
  EXPECT_EQ(readFile(folder / "file"), "old");
  EXPECT_EQ(folder.fileCount(), 1U);
}

TEST(WriteFile, SaysThatTheDiskIsFullOrReadOnlyAndLeavesNothing) {
  const TempFolder folder;
  if (::mount("none", folder.path().c_str(), "tmpfs", 0, "size=64k") != 0) {
    GTEST_SKIP() << "mounting a small disk takes rights that this user does not have";
  }
  folder.put("file", "old");
  const std::string full = messageOf([&] { writeFile(folder / "file", std::string(200000, 'x')); });
  const std::size_t leftOnFull = folder.fileCount();
  const std::string content = readFile(folder / "file");
  ::mount("none", folder.path().c_str(), nullptr, MS_REMOUNT | MS_RDONLY, nullptr);
  const std::string readOnly = messageOf([&] { requireWritable(folder / "other"); });
  ::umount(folder.path().c_str());
  EXPECT_THAT(full, HasSubstr("is full"));
  EXPECT_EQ(leftOnFull, 1U);
  EXPECT_EQ(content, "old");
  EXPECT_THAT(readOnly, HasSubstr("read-only"));
}

TEST(AtomicFile, IsThereOnceItIsWhole) {
  const TempFolder folder;
  {
    AtomicFile file(folder / "file");
    file.write("size: 0, ");
    file.write("voxels");
    file.overwrite(6, "6");
    file.write(" and more");
    EXPECT_FALSE(fs::exists(folder / "file"));
    file.commit();
    EXPECT_EQ(readFile(folder / "file"), "size: 6, voxels and more");
    AtomicFile given(folder / "up");
    given.write("half");
  }
  EXPECT_EQ(folder.fileCount(), 1U);
}

TEST(RequireWritable, LeavesNothing) {
  const TempFolder folder;
  requireWritable(folder / "file");
  EXPECT_EQ(folder.fileCount(), 0U);
}

TEST(ReadFile, SaysWhatIsWrong) {
  const TempFolder folder;
  EXPECT_THAT(messageOf([&] { readFile(folder / "none"); }), HasSubstr("3 there is no file"));
  EXPECT_THAT(messageOf([&] { readFile(folder.path()); }), HasSubstr("is a folder"));
  EXPECT_THAT(messageOf([&] { readFile("/dev/zero"); }), HasSubstr("device"));
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(messageOf([&] { readFile(folder / "pipe"); }), HasSubstr("pipe"));
  folder.put("long", "12345");
  EXPECT_THAT(messageOf([&] { readFile(folder / "long", 4); }), HasSubstr("4 "));
  EXPECT_EQ(readFile(folder / "long", 5), "12345");
}

TEST(Sha256, MatchesThePublishedExamples) {
  // FIPS 180-2, appendix B.1.
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

}  // namespace
}  // namespace pneuma
