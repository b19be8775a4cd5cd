#include <cstdint>
#include <fstream>
#include <limits>

#include <archive.h>
#include <archive_entry.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/ct_file.h"
#include "io/detail/unzipped.h"
#include "io/lying_zip.h"
#include "io/temp_folder.h"
#include "io/unfinished_files.h"
#include "support/dicom_maker.h"

namespace pneuma {
namespace {

using ::testing::HasSubstr;
using testing::SeriesSpec;
using testing::TempFolder;
using testing::writeSeries;

/// Writes zip archives entry by entry.
class Zip {
 public:
  explicit Zip(const std::filesystem::path& path) : handle_(archive_write_new()) {
    archive_write_set_format_zip(handle_);
    archive_write_open_filename(handle_, path.c_str());
  }

  ~Zip() { archive_write_free(handle_); }

  Zip(const Zip&) = delete;
  Zip& operator=(const Zip&) = delete;

  void add(const std::string& name, const std::string& content, unsigned type = AE_IFREG) {
    archive_entry* entry = archive_entry_new();
    archive_entry_set_pathname(entry, name.c_str());
    archive_entry_set_filetype(entry, type);
    archive_entry_set_perm(entry, 0644);
    if (type == AE_IFREG) archive_entry_set_size(entry, static_cast<la_int64_t>(content.size()));
    if (type == AE_IFLNK) archive_entry_set_symlink(entry, content.c_str());
    archive_write_header(handle_, entry);
    if (type == AE_IFREG) archive_write_data(handle_, content.data(), content.size());
    archive_entry_free(entry);
  }

  void addFolder(const std::filesystem::path& folder) {
    for (const auto& file : std::filesystem::directory_iterator(folder)) {
      add("CT  \xC3\xBC/" + file.path().filename().string(), readFile(file.path()));
    }
  }

 private:
  archive* handle_;
};

TEST(ZippedCt, IsReadLikeItsFolder) {
  const TempFolder folder;
  writeSeries(folder / "ct", {});
  {
    Zip zip(folder / "ct.zip");
    zip.addFolder(folder / "ct");
    zip.add("LICENSE", "free");
    zip.add("link", "/etc/passwd", AE_IFLNK);
  }
  EXPECT_EQ(readCt(folder / "ct.zip").image.voxels, readCt(folder / "ct").image.voxels);
}

TEST(ZippedCt, LeavesNothingInTheTemporaryFolder) {
  const TempFolder folder;
  const TempFolder temporary;
  ::setenv("TMPDIR", temporary.path().c_str(), 1);
  writeSeries(folder / "ct", {});
  { Zip(folder / "ct.zip").addFolder(folder / "ct"); }
  {
    const Unzipped files = unzipped(folder / "ct.zip", {});
    ASSERT_EQ(temporary.fileCount(), 1u);

    struct stat status {};

    const auto aside = std::filesystem::directory_iterator(temporary.path())->path();
    ::stat(aside.c_str(), &status);
    EXPECT_EQ(status.st_mode & 0777, 0700u);
    EXPECT_TRUE(isNameAside(aside.filename().native()));  // removed even if the program ends badly
  }
  EXPECT_EQ(temporary.fileCount(), 0u);
  readCt(folder / "ct.zip");
  EXPECT_EQ(temporary.fileCount(), 0u);
  std::filesystem::resize_file(folder / "ct" / "003.dcm", 700);
  { Zip(folder / "bad.zip").addFolder(folder / "ct"); }
  EXPECT_THROW(readCt(folder / "bad.zip"), Error);
  EXPECT_EQ(temporary.fileCount(), 0u);
  ::unsetenv("TMPDIR");
}

/// What refuses an archive says.
std::string refusal(const std::filesystem::path& archive, ExitCode code) {
  try {
    unzipped(archive, {});
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    return error.what();
  }
  return "it was unpacked";
}

TEST(BadZip, LeadsOutOfItsFolder) {
  const TempFolder folder;
  for (const std::string name : {"../evil", "/etc/evil", "a/../../evil", "..\\evil"}) {
    { Zip(folder / "evil.zip").add(name, "x"); }
    EXPECT_THAT(refusal(folder / "evil.zip", ExitCode::InputInvalid), HasSubstr("outside of it"));
  }
}

TEST(BadZip, SwellsBeyondMeasure) {
  const TempFolder folder;
  { Zip(folder / "bomb.zip").add("bomb", std::string(std::size_t{200} << 20, '\0')); }
  ASSERT_LT(std::filesystem::file_size(folder / "bomb.zip"), std::uint64_t{1} << 19);
  EXPECT_THAT(refusal(folder / "bomb.zip", ExitCode::InputInvalid),
              HasSubstr("would swell to 200 MB"));
}

TEST(BadZip, StatesSizesWhoseSumIsTooLargeToHold) {
  const TempFolder folder;
  constexpr std::uint64_t Largest = std::numeric_limits<std::int64_t>::max();
  // Three of them come to 2^63 - 3 where 64 bits wrap, four to less than nothing.
  for (const int entries : {1, 2, 3, 4}) {
    EXPECT_THAT(refusal(folder.put("bomb.zip", testing::lyingZip(entries, Largest)),
                        ExitCode::InputInvalid),
                HasSubstr("would swell to 8796093022207 MB or more"))
        << entries;
  }
  // 2^64 in four entries: nothing, if it wraps.
  EXPECT_THAT(refusal(folder.put("bomb.zip", testing::lyingZip(4, std::uint64_t{1} << 62)),
                      ExitCode::InputInvalid),
              HasSubstr("would swell to"));
}

/// Puts another archive in the place of the first as soon as its entries have been looked at.
class Swap : public ProgressSink {
 public:
  Swap(std::filesystem::path from, std::filesystem::path to, int looks)
      : from_(std::move(from)), to_(std::move(to)), looks_(looks) {}

  void report(double, std::string_view) override {}

  bool stopRequested() const override {
    if (looks_-- == 0) std::filesystem::rename(from_, to_);
    return false;
  }

 private:
  std::filesystem::path from_;
  std::filesystem::path to_;
  mutable int looks_;
};

TEST(BadZip, ChangesAfterItWasLookedAt) {
  const TempFolder folder;
  const TempFolder temporary;
  ::setenv("TMPDIR", temporary.path().c_str(), 1);
  { Zip(folder / "ct.zip").add("one", "text"); }
  { Zip(folder / "bomb.zip").add("bomb", std::string(std::size_t{200} << 20, '\0')); }
  Swap swap(folder / "bomb.zip", folder / "ct.zip", 0);
  try {
    unzipped(folder / "ct.zip", Progress(swap));
    ADD_FAILURE() << "it was unpacked";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("would swell to"));
  }
  EXPECT_EQ(temporary.fileCount(), 0u);
  ::unsetenv("TMPDIR");
}

TEST(BadZip, HasNoFolderToGoTo) {
  const TempFolder folder;
  { Zip(folder / "ct.zip").add("one", "text"); }
  ::setenv("TMPDIR", "/nowhere/at/all", 1);
  EXPECT_THAT(refusal(folder / "ct.zip", ExitCode::OutputFailed), HasSubstr("TMPDIR"));
  ::unsetenv("TMPDIR");
}

TEST(ZippedCt, MayHaveEndingsThatNoDiskTakes) {
  const TempFolder folder;
  { Zip(folder / "long.zip").add("a." + std::string(300, 'x'), "text"); }
  const Unzipped files = unzipped(folder / "long.zip", {});
  ASSERT_EQ(files.files.size(), 1u);
  EXPECT_EQ(readFile(files.files[0].path), "text");
}

TEST(BadZip, IsCutShortOrDamaged) {
  const TempFolder folder;
  writeSeries(folder / "ct", {});
  { Zip(folder / "ct.zip").addFolder(folder / "ct"); }
  const std::string whole = readFile(folder / "ct.zip");
  const auto cutTo = [&](std::size_t size) {
    return refusal(folder.put("cut.zip", whole.substr(0, size)), ExitCode::InputInvalid);
  };
  EXPECT_THAT(cutTo(whole.size() / 2), HasSubstr("damaged"));
  EXPECT_THAT(cutTo(20), HasSubstr("damaged"));
  std::string damaged = whole;
  for (std::size_t i = 200; i < 260; ++i) damaged[i] = static_cast<char>(~damaged[i]);
  EXPECT_THAT(refusal(folder.put("damaged.zip", damaged), ExitCode::InputInvalid),
              HasSubstr("damaged"));
}

TEST(BadZip, IsAPipeThatNobodyWritesTo) {
  const TempFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe.zip").c_str(), 0600), 0);
  EXPECT_FALSE(isZipFile(folder / "pipe.zip"));
  EXPECT_THROW(readCt(folder / "pipe.zip"), InputMissing);
}

TEST(BadZip, HoldsTooManyFiles) {
  const TempFolder folder;
  folder.put("many.zip", testing::lyingZip(20001, 0));
  EXPECT_THAT(refusal(folder / "many.zip", ExitCode::InputInvalid), HasSubstr("more than 20000"));
}

TEST(BadZip, HoldsNoCt) {
  const TempFolder folder;
  { Zip(folder / "text.zip").add("a.txt", "text"); }
  EXPECT_THROW(readCt(folder / "text.zip"), InputMissing);
}

}  // namespace
}  // namespace pneuma
