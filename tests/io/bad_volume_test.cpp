#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "bad_volumes.h"
#include "core/random.h"
#include "io/volume_file.h"
#include "temp_folder.h"

/// Every way a volume file may be bad ends with one sentence that names the file and the cause.
namespace pneuma {
namespace {

using testing::asFloat;
using testing::BadFile;
using testing::floats;
using ::testing::HasSubstr;
using testing::nifti;
using testing::TempFolder;

class BadVolume : public ::testing::TestWithParam<BadFile> {};

TEST_P(BadVolume, IsRefusedWithItsCause) {
  const TempFolder folder;
  const BadFile& bad = GetParam();
  const auto path = folder.put(bad.file, bad.content);
  if (!bad.data.empty()) folder.put("voxels.raw", bad.data);
  try {
    readHuVolume(path);
    FAIL() << "no error";
  } catch (const Error& error) {
    const std::string sentence = error.what();
    EXPECT_EQ(error.code(), bad.code) << sentence;
    EXPECT_THAT(sentence, HasSubstr(bad.cause));
    EXPECT_THAT(sentence, HasSubstr("\"" + folder.path().string()));
    EXPECT_LT(sentence.size(), 450U) << sentence;
  }
}

INSTANTIATE_TEST_SUITE_P(Nifti, BadVolume, ::testing::ValuesIn(testing::badNifti()));
INSTANTIATE_TEST_SUITE_P(Nrrd, BadVolume, ::testing::ValuesIn(testing::badNrrd()));
INSTANTIATE_TEST_SUITE_P(MetaImage, BadVolume, ::testing::ValuesIn(testing::badMetaImages()));

template <class F>
std::string sentenceOf(F&& f) {
  try {
    f();
  } catch (const Error& error) {
    return std::to_string(static_cast<int>(error.code())) + " " + error.what();
  }
  return "no error";
}

TEST(BadLabels, AreNoWholeNumbersFrom0To255) {
  const TempFolder folder;
  const auto refused = [&](const std::string& content) {
    return sentenceOf([&] { readLabelVolume(folder.put("a.nii", content)); });
  };
  EXPECT_THAT(refused(nifti(asFloat, floats(1.5F))),
              HasSubstr("4 \"" + (folder / "a.nii").string() + "\" has the value 1.5 at voxel"));
  EXPECT_THAT(refused(nifti(asFloat, floats(-1))), HasSubstr("whole numbers from 0 to 255"));
  EXPECT_THAT(refused(nifti(asFloat, floats(256))), HasSubstr("the value 256"));
  EXPECT_THAT(refused(nifti(asFloat, floats(testing::Nan))), HasSubstr("the value nan"));
  EXPECT_EQ(refused(nifti(asFloat, floats(255))), "no error");
}

TEST(BadVolumePath, IsTold) {
  const TempFolder folder;
  EXPECT_THAT(sentenceOf([&] { readHuVolume(folder / "none.nii"); }), HasSubstr("3 there is no"));
  EXPECT_THAT(sentenceOf([&] { readHuVolume(folder.path()); }), HasSubstr("3 "));
  const auto path = folder.put("secret.nii", testing::niftiBytes(testing::smallNifti()));
  ASSERT_EQ(::chmod(path.c_str(), 0), 0);
  const bool root = ::geteuid() == 0;  // whom permissions do not stop
  constexpr uid_t Nobody = 65534;
  ASSERT_EQ(root ? ::seteuid(Nobody) : 0, 0);
  const std::string sentence = sentenceOf([&] { readHuVolume(path); });
  ASSERT_EQ(root ? ::seteuid(0) : 0, 0);
  EXPECT_THAT(sentence, HasSubstr("3 cannot read \"" + path.string() + "\": Permission denied"));
}

TEST(HugeVolume, IsRefusedBeforeItTakesMemory) {
  const TempFolder folder;
  const auto path = folder.put("huge.nii", nifti([](auto& h) {
                                 h.dim = {3, 10000, 10000, 10000, 1, 1, 1, 1};
                                 h.datatype = NiftiUint8;
                                 h.bitpix = 8;
                               }));
  std::error_code error;
  std::filesystem::resize_file(path, 352 + 1'000'000'000'000, error);  // holes take no room
  if (error) GTEST_SKIP() << "this disk has no such large files";
  EXPECT_EQ(readVolumeHeader(path).memoryBytes, 2'000'000'000'000U);
  EXPECT_THAT(sentenceOf([&] { readHuVolume(path); }),
              HasSubstr("9 \"" + path.string() + "\" takes 1907348 MB of memory"));
}

/// Whatever happens to a file: an Error or a sound result.
TEST(DamagedVolume, NeverCrashes) {
  const TempFolder folder;
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.nii", testing::niftiBytes(testing::smallNifti())},
      {"a.nii.gz", testing::packed(testing::niftiBytes(testing::smallNifti()))},
      {"a.nrrd", testing::nrrdBytes()},
      {"b.nrrd", testing::nrrdBytes({"encoding: gzip"}, testing::packed(testing::smallBytes()))},
      {"a.mha", testing::metaBytes({"CompressedData = True"},
                                   testing::packed(testing::smallBytes(), false))}};
  Random random(1);
  for (const auto& [name, content] : files) {
    int refused = 0;
    for (int trial = 0; trial < 200; ++trial) {
      std::string damaged = content;
      const auto place = [&] {
        return static_cast<std::size_t>(random.uniform(0, static_cast<double>(damaged.size())));
      };
      for (int change = 0; change < 1 + trial % 3; ++change) {
        damaged[place()] = static_cast<char>(static_cast<int>(random.uniform(0, 256)));
      }
      if (trial % 5 == 0) damaged.resize(place());
      try {
        const CtImage image = readHuVolume(folder.put(name, damaged));
        EXPECT_EQ(image.voxels.size(), image.geometry.voxelCount());
        EXPECT_TRUE(image.geometry.steps().allFinite());
      } catch (const Error& error) {
        EXPECT_NE(error.code(), ExitCode::Internal) << error.what();
        ++refused;
      }
    }
    EXPECT_GT(refused, 40) << name;
  }
}

}  // namespace
}  // namespace pneuma
