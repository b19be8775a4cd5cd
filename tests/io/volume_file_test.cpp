#include "io/volume_file.h"

#include <cstdlib>
#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "support/progress_recorder.h"
#include "temp_folder.h"
#include "volume_samples.h"

namespace pneuma {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
namespace t = testing;
using t::bytesOfValues;
using t::metaBytes;
using t::niftiBytes;
using t::nrrdBytes;
using t::packed;
using t::smallBytes;
using t::smallNifti;
using t::smallValues;
using t::TempFolder;

/// The small volume of the samples, as read from a file of the given content.
struct Small {
  std::string name;
  std::string content;
};

void PrintTo(const Small& small, std::ostream* out) { *out << small.name; }

class SmallVolume : public ::testing::TestWithParam<Small> {
 protected:
  TempFolder folder_;
  std::filesystem::path path_ = folder_.put(GetParam().name, GetParam().content);
};

Mat3 diagonal(double x, double y, double z) { return Vec3(x, y, z).asDiagonal(); }

void expectSmall(const std::filesystem::path& path, const Vec3& origin, const Mat3& direction) {
  const CtImage image = readHuVolume(path);
  EXPECT_EQ(image.voxels, smallValues());
  EXPECT_EQ(image.geometry.size, (std::array{4, 3, 2}));
  EXPECT_TRUE(image.geometry.spacing.isApprox(Vec3(1, 2, 3), 1e-6));
  EXPECT_TRUE(image.geometry.origin.isApprox(origin, 1e-6)) << image.geometry.origin;
  EXPECT_TRUE(image.geometry.direction.isApprox(direction, 1e-6)) << image.geometry.direction;
  const LabelImage labels = readLabelVolume(path);
  EXPECT_EQ(labels.geometry, image.geometry);
  EXPECT_TRUE(std::equal(labels.voxels.begin(), labels.voxels.end(), image.voxels.begin()));
}

TEST_P(SmallVolume, IsTheSameInEveryEncoding) {
  const bool ras = GetParam().name.ends_with(".nii") || GetParam().name.ends_with(".gz");
  expectSmall(path_, ras ? Vec3(-10, -20, 30) : Vec3(10, 20, 30),
              ras ? diagonal(-1, -1, 1) : Mat3(Mat3::Identity()));
  EXPECT_TRUE(isVolumeFile(path_));
}

template <class T>
std::string smallAs(bool bigEndian = false) {
  const auto values = smallValues();
  return bytesOfValues(std::vector<T>(values.begin(), values.end()), bigEndian);
}

template <class T>
Small niftiOf(const std::string& name, std::int16_t datatype) {
  NiftiStruct h = smallNifti();
  h.datatype = datatype;
  h.bitpix = 8 * sizeof(T);
  return {name + ".nii", niftiBytes(h, smallAs<T>())};
}

template <class T>
Small nrrdOf(const std::string& name, const std::string& type, bool bigEndian) {
  return {name + ".nrrd", nrrdBytes({"type: " + type, bigEndian ? "endian: big" : "endian: little"},
                                    smallAs<T>(bigEndian))};
}

template <class T>
Small metaOf(const std::string& name, const std::string& type, bool bigEndian) {
  return {name + ".mha",
          metaBytes({"ElementType = " + type,
                     bigEndian ? "BinaryDataByteOrderMSB = True" : "ElementByteOrderMSB = False"},
                    smallAs<T>(bigEndian))};
}

/// The same header from a machine with the most significant byte first.
std::string bigEndianNifti() {
  std::string content = niftiBytes(smallNifti(), smallAs<std::int16_t>(true));
  const auto swapAt = [&](std::size_t at, std::size_t bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      std::reverse(content.begin() + static_cast<std::ptrdiff_t>(at + i * bytes),
                   content.begin() + static_cast<std::ptrdiff_t>(at + (i + 1) * bytes));
    }
  };
  swapAt(0, 4, 1);     // sizeof_hdr
  swapAt(40, 2, 8);    // dim
  swapAt(68, 2, 4);    // intent_code to slice_start
  swapAt(76, 4, 11);   // pixdim, vox_offset, scl_slope, scl_inter
  swapAt(252, 2, 2);   // qform_code, sform_code
  swapAt(256, 4, 18);  // quaternion to srow
  return content;
}

std::string niftiWithExtension() {
  NiftiStruct h = smallNifti();
  h.voxOffset = 368;
  return niftiBytes(h, std::string(16, 'x') + smallBytes());
}

/// gzip files may be glued together, as bgzip makes them.
std::string gluedGzip() {
  const std::string content = niftiBytes(smallNifti());
  return packed(content.substr(0, 100)) + packed(content.substr(100));
}

INSTANTIATE_TEST_SUITE_P(
    Encodings, SmallVolume,
    ::testing::Values(
        Small{"a.nii", niftiBytes(smallNifti())},
        Small{"a.nii.gz", packed(niftiBytes(smallNifti()))}, Small{"glued.nii.gz", gluedGzip()},
        Small{"big.nii", bigEndianNifti()}, Small{"extended.nii", niftiWithExtension()},
        Small{"extended.nii.gz", packed(niftiWithExtension())}, niftiOf<std::uint8_t>("uint8", 2),
        niftiOf<std::int32_t>("int32", 8), niftiOf<float>("float", 16),
        niftiOf<double>("double", 64), niftiOf<std::int8_t>("int8", 256),
        niftiOf<std::uint16_t>("uint16", 512), niftiOf<std::uint32_t>("uint32", 768),
        niftiOf<std::int64_t>("int64", 1024), niftiOf<std::uint64_t>("uint64", 1280),
        Small{"a.nrrd", nrrdBytes()},
        Small{"gz.nrrd", nrrdBytes({"encoding: gzip"}, packed(smallBytes()))},
        Small{"skip.nrrd", nrrdBytes({"byte skip: 5"}, "12345" + smallBytes())},
        Small{"end.nrrd", nrrdBytes({"byte skip: -1"}, "12345" + smallBytes())},
        nrrdOf<std::int16_t>("big", "short", true), nrrdOf<float>("float", "float", true),
        nrrdOf<std::uint16_t>("uint16", "unsigned short", false),
        nrrdOf<double>("double", "double", true), nrrdOf<std::uint8_t>("uint8", "uchar", false),
        Small{"short axes.nrrd", nrrdBytes({"dimension: 4", "sizes: 1 4 3 2",
                                            "space directions: none (1,0,0) (0,2,0) (0,0,3)",
                                            "kinds: list domain domain domain"})},
        Small{"spacings.nrrd", nrrdBytes({"space directions", "space origin", "spacings: 1 2 3",
                                          "axis mins: 10 20 30", "centerings: node node node"})},
        Small{"cells.nrrd", nrrdBytes({"space directions", "space origin", "spacings: 1 2 3",
                                       "axismins: 9.5 19 28.5"})},
        Small{"cm.nrrd", nrrdBytes({"space directions: (.1,0,0) (0,.2,0) (0,0,.3)",
                                    "space origin: (1,2,3)", "space units: \"cm\" \"cm\" \"cm\""})},
        Small{"las.nrrd", nrrdBytes({"space: LAS", "space origin: (10,-20,30)",
                                     "space directions: (1, 0, 0) (0, -2, 0) (0, 0, 3)"})},
        Small{"ras.nrrd", nrrdBytes({"space: right-anterior-superior", "space origin: (-10,-20,30)",
                                     "space directions: (-1,0,0) (0,-2,0) (0,0,3)", "# a comment",
                                     "key:=value"})},
        Small{"a.mha", metaBytes()},
        Small{"z.mha", metaBytes({"CompressedData = True"}, packed(smallBytes(), false))},
        Small{"gz.mha", metaBytes({"CompressedData = True"}, packed(smallBytes()))},
        Small{"position.mha", metaBytes({"Offset", "Position = 10 20 30"})},
        Small{"rotation.mha", metaBytes({"TransformMatrix", "Rotation = 1 0 0 0 1 0 0 0 1"})},
        Small{"unknown.mha", metaBytes({"AnatomicalOrientation = ???"})},
        Small{"time.mha", metaBytes({"NDims = 4", "DimSize = 4 3 2 1", "ElementSpacing = 1 2 3 1",
                                     "TransformMatrix = 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1",
                                     "Offset = 10 20 30 0"})},
        metaOf<std::int16_t>("big", "MET_SHORT", true), metaOf<float>("float", "MET_FLOAT", false),
        metaOf<std::uint8_t>("uchar", "MET_UCHAR", false),
        metaOf<std::int32_t>("long", "MET_LONG", true),
        Small{"n\xc3\xa4me  with  blanks.mha", metaBytes()}));

/// Where the small NIfTI lies with other geometry fields.
ImageGeometry niftiGeometry(const NiftiStruct& h, std::vector<std::string>* notes = nullptr) {
  const TempFolder folder;
  const VolumeHeader header = readVolumeHeader(folder.put("a.nii", niftiBytes(h)));
  if (notes != nullptr) *notes = header.notes;
  return header.geometry;
}

TEST(Nifti, TurnsWithItsQuaternion) {
  NiftiStruct h = smallNifti();
  h.sformCode = 0;
  h.qformCode = 1;
  h.qoffset = {10, 20, 30};
  h.quatern = {0, 0, std::sqrt(0.5F)};  // 90 degrees about z: i runs forward, j to the left
  const ImageGeometry turned = niftiGeometry(h);
  Mat3 expected;
  expected << 0, 1, 0, -1, 0, 0, 0, 0, 1;
  EXPECT_TRUE(turned.direction.isApprox(expected, 1e-6)) << turned.direction;
  EXPECT_TRUE(turned.origin.isApprox(Vec3(-10, -20, 30)));
  h.pixdim[0] = -1;  // qfac: slices run the other way
  expected.col(2) = -expected.col(2);
  EXPECT_TRUE(niftiGeometry(h).direction.isApprox(expected, 1e-6));
}

TEST(Nifti, PrefersTheSformAndTellsWhereTheyDiffer) {
  NiftiStruct h = smallNifti();
  h.qformCode = 1;
  h.qoffset = {10, 20, 30};
  std::vector<std::string> notes;
  EXPECT_TRUE(niftiGeometry(h, &notes).origin.isApprox(Vec3(-10, -20, 30)));
  EXPECT_THAT(notes, IsEmpty());
  h.qoffset = {15, 20, 30};
  EXPECT_TRUE(niftiGeometry(h, &notes).origin.isApprox(Vec3(-10, -20, 30)));
  EXPECT_THAT(notes, ElementsAre(HasSubstr("differs from its sform")));
}

TEST(Nifti, SaysThatOrientationIsAGuess) {
  NiftiStruct h = smallNifti();
  h.sformCode = 0;
  std::vector<std::string> notes;
  const ImageGeometry geometry = niftiGeometry(h, &notes);
  EXPECT_EQ(geometry.direction, diagonal(-1, -1, 1));
  EXPECT_EQ(geometry.spacing, Vec3(1, 2, 3));
  EXPECT_THAT(notes, ElementsAre(HasSubstr("left and right may be swapped")));
}

TEST(Nifti, KeepsLeftHandedVolumes) {
  NiftiStruct h = smallNifti();
  h.srow[0] = {-1, 0, 0, 10};
  EXPECT_EQ(niftiGeometry(h).direction, diagonal(1, -1, 1));
}

TEST(Nifti, MeasuresInItsUnit) {
  NiftiStruct h = smallNifti();
  std::vector<std::string> notes;
  h.xyztUnits = 1;
  const auto scale = [&](float factor) {
    for (auto& row : h.srow) {
      for (float& value : row) value *= factor;
    }
  };
  scale(1e-3F);
  EXPECT_TRUE(niftiGeometry(h, &notes).spacing.isApprox(Vec3(1, 2, 3), 1e-6));
  EXPECT_THAT(notes, ElementsAre(HasSubstr("metres")));
  h.xyztUnits = 3;
  scale(1e6F);
  const ImageGeometry micro = niftiGeometry(h, &notes);
  EXPECT_TRUE(micro.spacing.isApprox(Vec3(1, 2, 3), 1e-6));
  EXPECT_TRUE(micro.origin.isApprox(Vec3(-10, -20, 30), 1e-6));
  scale(1e-3F);
  h.xyztUnits = 0;
  EXPECT_TRUE(niftiGeometry(h, &notes).spacing.isApprox(Vec3(1, 2, 3), 1e-6));
  EXPECT_THAT(notes, ElementsAre(HasSubstr("taken for mm")));
}

TEST(Nifti, ScalesItsValues) {
  const TempFolder folder;
  NiftiStruct h = smallNifti();
  h.sclSlope = 2.5F;
  h.sclInter = -1000;
  const auto path = folder.put("a.nii", niftiBytes(h));
  const VolumeHeader header = readVolumeHeader(path);
  EXPECT_EQ(header.slope, 2.5);
  EXPECT_EQ(header.intercept, -1000);
  const CtImage image = readHuVolume(path);
  EXPECT_EQ(image.voxels[0], -1000);
  EXPECT_EQ(image.voxels[1], -998);  // -997.5 to the even neighbour
  EXPECT_EQ(image.voxels[2], -995);
  for (const float none : {0.0F, std::numeric_limits<float>::quiet_NaN()}) {
    h.sclSlope = none;
    EXPECT_EQ(readHuVolume(folder.put("b.nii", niftiBytes(h))).voxels, smallValues());
  }
}

TEST(MetaImage, ListsItsAxesOneAfterTheOther) {
  const TempFolder folder;
  // i runs to the back, j up, k to the left.
  const auto path = folder.put("a.mha", metaBytes({"TransformMatrix = 0 1 0 0 0 1 1 0 0"}));
  const Mat3 direction = readVolumeHeader(path).geometry.direction;
  EXPECT_EQ(direction.col(0), Vec3(0, 1, 0));
  EXPECT_EQ(direction.col(1), Vec3(0, 0, 1));
  EXPECT_EQ(direction.col(2), Vec3(1, 0, 0));
}

TEST(MetaImage, ScalesItsValues) {
  const TempFolder folder;
  const auto path = folder.put("a.mha", metaBytes({"ElementToIntensityFunctionSlope = 2",
                                                   "ElementToIntensityFunctionOffset = -1024"}));
  EXPECT_EQ(readHuVolume(path).voxels[3], -1018);
}

TEST(Nrrd, SaysWhatItAssumes) {
  const TempFolder folder;
  const VolumeHeader header = readVolumeHeader(
      folder.put("a.nrrd", nrrdBytes({"space", "space dimension: 3", "space origin"})));
  EXPECT_THAT(header.notes, ElementsAre(HasSubstr("left and right may be swapped"),
                                        HasSubstr("no space origin")));
  EXPECT_THAT(readVolumeHeader(folder.put("b.nrrd", nrrdBytes({"space: 3D-right-handed"}))).notes,
              ElementsAre(HasSubstr("\"3D-right-handed\"")));
}

struct Detached {
  std::string header;
  std::string content;
  std::string data;
};

TEST(DetachedVolume, IsReadFromTheSameFolder) {
  const TempFolder folder;
  const std::string odd = "v\xc3\xb6xels  of it.raw";  // non-ASCII, two blanks
  folder.put(odd, smallBytes());
  folder.put("v.zraw", packed(smallBytes(), false));
  folder.put("v.raw.gz", packed(smallBytes()));
  folder.put("late.raw", "12345" + smallBytes());
  const std::vector<Detached> all = {
      {"a.mhd", metaBytes({"ElementDataFile = " + odd}, ""), odd},
      {"b.mhd", metaBytes({"CompressedData = True", "ElementDataFile = v.zraw"}, ""), "v.zraw"},
      {"c.mhd", metaBytes({"HeaderSize = 5", "ElementDataFile = late.raw"}, ""), "late.raw"},
      {"d.mhd", metaBytes({"HeaderSize = -1", "ElementDataFile = late.raw"}, ""), "late.raw"},
      {"a.nhdr", t::nrrdHeader({"data file: " + odd}), odd},
      {"b.nhdr", t::nrrdHeader({"encoding: gzip", "datafile: v.raw.gz"}), "v.raw.gz"}};
  for (const Detached& one : all) {
    SCOPED_TRACE(one.header);
    expectSmall(folder.put(one.header, one.content), Vec3(10, 20, 30), Mat3::Identity());
  }
}

TEST(VolumeFile, IsTakenForWhatItHolds) {
  const TempFolder folder;
  const VolumeHeader header = readVolumeHeader(folder.put("a.nii", nrrdBytes()));
  EXPECT_EQ(header.format, "NRRD");
  EXPECT_EQ(header.scalarType, "int16");
  EXPECT_EQ(header.space, "left-posterior-superior");
  EXPECT_EQ(header.memoryBytes, 48U);
  EXPECT_THAT(header.notes, ElementsAre(HasSubstr("read as NRRD")));
  EXPECT_TRUE(isVolumeFile(folder.put("nothing to see", metaBytes())));
  EXPECT_FALSE(isVolumeFile(folder.put("text", "some text")));
  EXPECT_FALSE(isVolumeFile(folder.path()));
  EXPECT_TRUE(isVolumeFile(folder.put("damaged.NII.GZ", "x")));
  EXPECT_TRUE(isVolumeFileName("A B.Nii.gz"));
  EXPECT_FALSE(isVolumeFileName("a.gz"));
}

TEST(VolumeFile, StopsOnRequest) {
  const TempFolder folder;
  CtImage image;
  image.geometry.size = {256, 256, 64};
  image.voxels.resize(image.geometry.voxelCount());
  for (const char* name : {"a.nii", "a.nii.gz", "a.nrrd", "a.mha"}) {
    writeVolume(folder / name, image);
    for (const double stopAt : {0.0, 0.5}) {
      t::ProgressRecorder recorder(stopAt);
      const Progress progress(recorder);
      EXPECT_THROW(readHuVolume(folder / name, progress), Cancelled) << name;
      t::ProgressRecorder another(stopAt);
      const std::string written = std::string("written ") + name;
      EXPECT_THROW(writeVolume(folder / written, image, Existing::Replace, Progress(another)),
                   Cancelled);
      EXPECT_FALSE(std::filesystem::exists(folder / written));
    }
  }
  EXPECT_EQ(folder.fileCount(), 4U);
}

/// Real files; see the README of PNEUMA_TEST_DATA.
class RealVolume : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* data = std::getenv("PNEUMA_TEST_DATA");
    if (data == nullptr || *data == '\0') GTEST_SKIP() << "PNEUMA_TEST_DATA is not set";
    data_ = data;
  }

  std::filesystem::path data_;
};

TEST_F(RealVolume, IsTheSameInNrrdAndMetaImage) {
  const CtImage nrrd = readHuVolume(data_ / "ct_cip64/ct-64.nrrd");
  const CtImage meta = readHuVolume(data_ / "ct_cip64/ct-64.mha");
  EXPECT_EQ(nrrd.voxels, meta.voxels);
  EXPECT_EQ(nrrd.geometry.size, (std::array{64, 64, 79}));
  EXPECT_TRUE(nrrd.geometry.origin.isApprox(meta.geometry.origin, 1e-9));
  EXPECT_TRUE(nrrd.geometry.spacing.isApprox(meta.geometry.spacing, 1e-9));
  EXPECT_EQ(*std::ranges::min_element(nrrd.voxels), -1007);
  EXPECT_EQ(*std::ranges::max_element(nrrd.voxels), 1095);
}

TEST_F(RealVolume, HasTheGeometryThatItsHeaderTells) {
  const VolumeHeader mask =
      readVolumeHeader(data_ / "motion_copdgene_case01/case_01_exp_mask.nii.gz");
  EXPECT_EQ(mask.geometry.spacing, Vec3(1.75, 1.25, 1.75));  // wrong, but what the file says
  EXPECT_EQ(mask.geometry.direction, diagonal(-1, -1, 1));
  EXPECT_EQ(mask.scalarType, "int16");
  const VolumeHeader lidc = readVolumeHeader(data_ / "ct_lidc_idri_0001/lidc_idri_0001.mha");
  EXPECT_EQ(lidc.geometry.size, (std::array{512, 512, 133}));
  EXPECT_EQ(lidc.geometry.spacing, Vec3(0.703125, 0.703125, 2.5));
  EXPECT_EQ(lidc.geometry.origin, Vec3(-166, -171.699997, -340));
  EXPECT_EQ(lidc.space, "RAI");
  EXPECT_THAT(lidc.notes, IsEmpty());
}

TEST_F(RealVolume, OfLabelsHasAsManyVoxelsInEveryFormat) {
  const LabelImage nifti =
      readLabelVolume(data_ / "motion_copdgene_case01/case_01_insp_mask.nii.gz");
  const LabelImage meta = readLabelVolume(data_ / "motion_copdgene_case01/case_01_insp_mask.mha");
  EXPECT_EQ(std::ranges::count(nifti.voxels, 1), std::ranges::count(meta.voxels, 1));
  // Region and type in one number: no label of ours.
  EXPECT_THROW(readLabelVolume(data_ / "ct_cip64/lm-64.nrrd"), InvalidInput);
}

}  // namespace
}  // namespace pneuma
