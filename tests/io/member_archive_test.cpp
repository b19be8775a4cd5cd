// Archives of members: whole or not at all, and nothing that a bad one could do.
#include "io/member_archive.h"

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include <archive.h>
#include <archive_entry.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.h"
#include "core/progress.h"
#include "io/archive_lookup.h"
#include "io/atomic_file.h"
#include "io/exact_text.h"
#include "io/lying_zip.h"
#include "io/temp_folder.h"
#include "support/progress_recorder.h"

namespace pneuma {
namespace {

using ::testing::HasSubstr;

std::vector<ArchiveMember> someMembers(char letter = 'a') {
  std::string noise;
  std::mt19937 random(static_cast<unsigned>(letter));
  for (int i = 0; i < 20000; ++i) noise += static_cast<char>(random() & 0xff);
  return {{"project.json", std::string("{\"") + letter + "\": 1}", true},
          {"surfaces/RUL.ply", noise, true},
          {"thumbnail.png", noise.substr(0, 500), false},
          {"empty", "", true}};
}

void expectSame(const std::vector<ArchiveMember>& a, const std::vector<ArchiveMember>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].content, b[i].content);
  }
}

std::string refusal(const std::filesystem::path& path, ExitCode code) {
  try {
    readArchive(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  return "was read";
}

/// An archive by another program, which names its members as it likes.
void foreignZip(const std::filesystem::path& path, const std::vector<ArchiveMember>& members) {
  archive* handle = archive_write_new();
  archive_write_set_format_zip(handle);
  archive_write_open_filename(handle, path.c_str());
  for (const ArchiveMember& member : members) {
    archive_entry* entry = archive_entry_new();
    archive_entry_set_pathname(entry, member.name.c_str());
    archive_entry_set_filetype(entry, AE_IFREG);
    archive_entry_set_size(entry, static_cast<la_int64_t>(member.content.size()));
    archive_write_header(handle, entry);
    archive_write_data(handle, member.content.data(), member.content.size());
    archive_entry_free(entry);
  }
  archive_write_close(handle);
  archive_write_free(handle);
}

TEST(MemberArchive, ComesBackAndTheOneBeforeIsKept) {
  const testing::TempFolder folder;
  writeArchive(folder / "case.pneuma", someMembers());
  expectSame(readArchive(folder / "case.pneuma"), someMembers());
  EXPECT_EQ(folder.fileCount(), 1U);
  const std::string first = readFile(folder / "case.pneuma");
  writeArchive(folder / "case.pneuma", someMembers('b'));
  writeArchive(folder / "case.pneuma", someMembers());
  expectSame(readArchive(folder / "case.pneuma~"), someMembers('b'));
  EXPECT_EQ(readFile(folder / "case.pneuma"), first);  // the same members, the same bytes
  EXPECT_EQ(folder.fileCount(), 2U);
}

TEST(MemberArchive, ThatCannotBeWrittenLeavesTheOldOne) {
  const testing::TempFolder folder;
  writeArchive(folder / "case.pneuma", someMembers());
  std::filesystem::create_directories(folder / "case.pneuma~/folder");
  EXPECT_THROW(writeArchive(folder / "case.pneuma", someMembers('b')), OutputFailed);
  expectSame(readArchive(folder / "case.pneuma"), someMembers());
  EXPECT_EQ(folder.fileCount(), 2U);

  struct Stop : ProgressSink {
    void report(double /*fraction*/, std::string_view /*what*/) override {}

    bool stopRequested() const override { return true; }
  } stop;

  EXPECT_THROW(writeArchive(folder / "other.pneuma", someMembers(), Progress(stop)), Cancelled);
  EXPECT_EQ(folder.fileCount(), 2U);
}

TEST(MemberArchive, GivesOneMemberWithoutTheOthers) {
  const testing::TempFolder folder;
  writeArchive(folder / "case.pneuma", someMembers());
  EXPECT_EQ(readMember(folder / "case.pneuma", "thumbnail.png", 500), someMembers()[2].content);
  EXPECT_EQ(readMember(folder / "case.pneuma", "empty", 0), "");
  EXPECT_EQ(readMember(folder / "case.pneuma", "thumbnail.PNG", 500), std::nullopt);
  EXPECT_THROW(readMember(folder / "case.pneuma", "thumbnail.png", 499), InvalidInput);
  EXPECT_THROW(readMember(folder / "none.pneuma", "thumbnail.png", 500), InputMissing);
  folder.put("lying.pneuma", testing::lyingZip(1, std::uint64_t{1} << 33));
  EXPECT_THROW(readMember(folder / "lying.pneuma", "0.dcm", std::uint64_t{1} << 36), InvalidInput);
  // One that is damaged elsewhere still shows itself.
  std::string damaged = readFile(folder / "case.pneuma");
  damaged[10000] ^= 1;
  folder.put("damaged.pneuma", damaged);
  EXPECT_THROW(readArchive(folder / "damaged.pneuma"), InvalidInput);
  EXPECT_EQ(readMember(folder / "damaged.pneuma", "thumbnail.png", 500), someMembers()[2].content);
  EXPECT_THROW(readMember(folder / "damaged.pneuma", "surfaces/RUL.ply", 1 << 20), InvalidInput);
}

TEST(MemberArchive, CutOffIsRefused) {
  const testing::TempFolder folder;
  writeArchive(folder / "case.pneuma", someMembers());
  const std::string whole = readFile(folder / "case.pneuma");
  for (std::size_t size = 0; size < whole.size(); size += 997) {
    folder.put("cut.pneuma", whole.substr(0, size));
    EXPECT_THAT(refusal(folder / "cut.pneuma", ExitCode::InputInvalid), HasSubstr("damaged"));
  }
}

TEST(MemberArchive, WithAFlippedBitIsRefusedOrTheSame) {
  const testing::TempFolder folder;
  writeArchive(folder / "case.pneuma", someMembers());
  const std::string whole = readFile(folder / "case.pneuma");
  std::mt19937 random(1);
  int refused = 0;
  for (int i = 0; i < 120; ++i) {
    std::string flipped = whole;
    // Half of them where the archive tells of its members.
    const std::size_t from = i % 2 == 0 ? 0 : whole.size() - 300;
    flipped[from + random() % (whole.size() - from)] ^= static_cast<char>(1U << (random() % 8));
    folder.put("flipped.pneuma", flipped);
    try {
      for (const ArchiveMember& member : readArchive(folder / "flipped.pneuma")) {
        const auto same = [&](const ArchiveMember& one) { return one.content == member.content; };
        const auto all = someMembers();
        EXPECT_TRUE(std::any_of(all.begin(), all.end(), same)) << member.name;
      }
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 60);
}

TEST(MemberArchive, ThatLeadsOutSwellsOrRepeatsIsRefused) {
  const testing::TempFolder folder;
  for (const char* name : {"../evil", "/etc/evil", "a/../../evil", "..\\evil", "C:evil"}) {
    foreignZip(folder / "evil.pneuma", {{name, "x", true}});
    EXPECT_THAT(refusal(folder / "evil.pneuma", ExitCode::InputInvalid), HasSubstr("outside"));
  }
  foreignZip(folder / "twice.pneuma", {{"a", "x", true}, {"a", "y", true}});
  EXPECT_THAT(refusal(folder / "twice.pneuma", ExitCode::InputInvalid), HasSubstr("twice"));
  foreignZip(folder / "bomb.pneuma", {{"a", std::string(std::size_t{8} << 20, '\0'), true}});
  EXPECT_THROW(readArchive(folder / "bomb.pneuma", {}, {.bytes = std::uint64_t{1} << 20}),
               InvalidInput);
  folder.put("lying.pneuma", testing::lyingZip(1, std::uint64_t{1} << 33));
  EXPECT_THAT(refusal(folder / "lying.pneuma", ExitCode::InputInvalid), HasSubstr("cannot hold"));
  EXPECT_THROW(readArchive(folder / "absent.pneuma"), InputMissing);
  EXPECT_THAT(refusal(folder.put("text.pneuma", "no archive"), ExitCode::InputInvalid),
              HasSubstr("damaged"));
}

TEST(MemberArchive, ThatIsABombIsRefusedAndImagesOfNothingAreNone) {
  const testing::TempFolder folder;
  const ArchiveLimits limits{.swelling = 100, .freeSwelling = std::uint64_t{1} << 20};
  std::vector<ArchiveMember> zeros;
  for (int i = 0; i < 8; ++i) {
    zeros.push_back({std::to_string(i), std::string(std::size_t{4} << 20, '\0'), true});
  }
  foreignZip(folder / "bomb.pneuma", zeros);
  try {
    readArchive(folder / "bomb.pneuma", {}, limits);
    ADD_FAILURE() << "was read";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("would swell to"));
  }
  EXPECT_EQ(readArchive(folder / "bomb.pneuma").size(), zeros.size());
  // Ours with the same in it is packed as far as it can be read again.
  zeros.push_back({"small", std::string(std::size_t{3} << 17, '\0'), true});
  double last = 0.0;
  testing::ProgressRecorder recorder;
  writeArchive(folder / "images.pneuma", zeros, Progress(recorder), limits);
  expectSame(readArchive(folder / "images.pneuma", {}, limits), zeros);
  // 31.4 MB over the free ones need 0.31 MB; the packed ones and the small one have 0.54 MB.
  EXPECT_LT(std::filesystem::file_size(folder / "images.pneuma"), 600000U);
  for (const double fraction : recorder.fractions()) {
    EXPECT_GE(fraction, last);
    last = fraction;
  }
}

TEST(MemberArchive, OfTooManyFilesIsRefused) {
  const testing::TempFolder folder;
  std::vector<ArchiveMember> many;
  for (int i = 0; i < 10001; ++i) many.push_back({std::to_string(i), "", true});
  foreignZip(folder / "many.pneuma", many);
  EXPECT_THAT(refusal(folder / "many.pneuma", ExitCode::InputInvalid), HasSubstr("in 10001 files"));
}

TEST(MemberArchive, ThatIsAPipeIsNotWaitedFor) {
  const testing::TempFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe.pneuma").c_str(), 0600), 0);
  EXPECT_THAT(refusal(folder / "pipe.pneuma", ExitCode::InputMissing), HasSubstr("a pipe"));
}

/// Saves over and over until it is killed.
[[noreturn]] void saveForEver(const std::filesystem::path& path) {
  for (char letter = 'a';; letter = letter == 'a' ? 'b' : 'a') {
    writeArchive(path, someMembers(letter));
  }
}

TEST(MemberArchive, IsWholeWheneverSavingIsKilled) {
  const testing::TempFolder folder;
  const auto path = folder / "case.pneuma";
  writeArchive(path, someMembers());
  std::mt19937 random(std::random_device{}());
  for (int i = 0; i < 20; ++i) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) saveForEver(path);
    std::this_thread::sleep_for(std::chrono::microseconds(500 + random() % 20000));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const std::vector<ArchiveMember> members = readArchive(path);
    ASSERT_EQ(members.size(), 4U);
    expectSame(members, someMembers(members[0].content[2]));
  }
}

TEST(ExactText, BringsSurfacesBackToTheBit) {
  MarkedMesh marked;
  // Points that are the same, or in no triangle, and numbers that no text would keep.
  marked.mesh.points = {{0.1, -0.0, 1e-300}, {0.1, -0.0, 1e-300}, {1.0 / 3.0, 2, 3}, {7, 8, 9}};
  marked.mesh.triangles = {{2, 1, 0}, {0, 2, 3}};
  marked.ofPoints = {{"lobe", {1, 2, 3, 255}}};
  marked.ofTriangles = {{"behind", {5, 0}}, {"front", {0, 6}}};
  const std::string text = exactPly(marked);
  const MarkedMesh back = meshOfExactPly(text, "it");
  EXPECT_EQ(back.mesh.points, marked.mesh.points);
  EXPECT_TRUE(std::signbit(back.mesh.points[0].y()));
  EXPECT_EQ(back.mesh.triangles, marked.mesh.triangles);
  EXPECT_EQ(back.ofPoints, marked.ofPoints);
  EXPECT_EQ(back.ofTriangles, marked.ofTriangles);
  for (std::size_t size = 0; size < text.size(); ++size) {
    EXPECT_THROW(meshOfExactPly(text.substr(0, size), "it"), InvalidInput);
  }
  std::string wrong = text;
  wrong[text.size() - 8] = 4;  // a corner that there is not
  EXPECT_THROW(meshOfExactPly(wrong, "it"), InvalidInput);
}

TEST(ExactText, BringsImagesBackToTheBit) {
  CtImage ct;
  ct.geometry.size = {2, 3, 2};
  ct.geometry.spacing = {1.0 / 3.0, 0.7, 2.5};
  ct.geometry.origin = {-100.1, 0.3, 7};
  ct.geometry.direction = Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  ct.voxels = {-1024, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 3071};
  const std::string text = exactNrrd(ct);
  EXPECT_THAT(text, HasSubstr("encoding: raw"));
  const CtImage back = ctOfExactNrrd(text, ct.geometry, "it");
  EXPECT_EQ(back.geometry, ct.geometry);
  EXPECT_EQ(back.voxels, ct.voxels);
  ImageGeometry other = ct.geometry;
  other.size = {2000, 3000, 2000};
  EXPECT_THROW(ctOfExactNrrd(text, other, "it"), InvalidInput);
  EXPECT_THROW(ctOfExactNrrd(text.substr(1), ct.geometry, "it"), InvalidInput);
  EXPECT_THROW(labelsOfExactNrrd(text, ct.geometry, "it"), InvalidInput);
}

}  // namespace
}  // namespace pneuma
