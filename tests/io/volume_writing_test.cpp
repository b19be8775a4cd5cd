#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkMetaImageReader.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNew.h>
#include <vtkNrrdReader.h>

#include "core/error.h"
#include "io/volume_file.h"
#include "temp_folder.h"
#include "volume_samples.h"

/// What we write is whole, the same every time, and as other programs understand it.
namespace pneuma {
namespace {

using ::testing::HasSubstr;
using testing::sampleCt;
using testing::sampleLabels;
using ::testing::StartsWith;
using testing::TempFolder;

constexpr double ToleranceMm = 1e-4;

/// The sample, turned about an oblique axis.
CtImage obliqueCt() {
  CtImage image = sampleCt();
  image.geometry.direction =
      Eigen::AngleAxisd(radians(25), Vec3(1, 2, 3).normalized()).toRotationMatrix();
  return image;
}

NiftiStruct niftiStruct(const std::filesystem::path& path) {
  NiftiStruct h{};
  const std::string content = readFile(path);
  std::memcpy(&h, content.data(), sizeof(h));
  return h;
}

class VolumeWriting : public ::testing::TestWithParam<std::string> {
 protected:
  TempFolder folder_;
  std::filesystem::path path_ = folder_ / ("a" + GetParam());
};

TEST_P(VolumeWriting, ComesBackEqual) {
  writeVolume(path_, obliqueCt());
  EXPECT_EQ(readHuVolume(path_).voxels, obliqueCt().voxels);
  writeVolume(path_, sampleLabels());
  EXPECT_EQ(readLabelVolume(path_).voxels, sampleLabels().voxels);
  EXPECT_EQ(readVolumeHeader(path_).scalarType, "uint8");
  EXPECT_TRUE(readVolumeHeader(path_).notes.empty());
  EXPECT_EQ(folder_.fileCount(), 1U);
}

TEST_P(VolumeWriting, GivesTheSameBytesWhateverTheNameAndTime) {
  writeVolume(path_, obliqueCt());
  const auto other = folder_ / ("another name" + GetParam());
  writeVolume(other, obliqueCt());
  EXPECT_EQ(readFile(path_), readFile(other));
}

TEST_P(VolumeWriting, ReplacesOnlyIfAsked) {
  folder_.put(path_.filename().string(), "old");
  EXPECT_THROW(writeVolume(path_, sampleCt(), Existing::Refuse), OutputFailed);
  EXPECT_EQ(readFile(path_), "old");
  EXPECT_EQ(folder_.fileCount(), 1U);
}

TEST_P(VolumeWriting, RefusesVolumesThatAreNone) {
  CtImage image = sampleCt();
  image.voxels.pop_back();
  EXPECT_THROW(writeVolume(path_, image), InvalidInput);
  image = sampleCt();
  image.geometry.spacing.y() = 0.0;
  EXPECT_THROW(writeVolume(path_, image), InvalidInput);
  EXPECT_EQ(folder_.fileCount(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Formats, VolumeWriting,
                         ::testing::Values(".nii", ".nii.gz", ".nrrd", ".mha"));

TEST(VolumeWritingTo, AnotherExtensionIsRefused) {
  const TempFolder folder;
  for (const char* name : {"a.img", "a", "a.mhd", "a.nhdr", "a.gz"}) {
    EXPECT_THROW(writeVolume(folder / name, sampleCt()), Unsupported) << name;
  }
  CtImage longImage;
  longImage.geometry.size = {40000, 2, 2};
  longImage.voxels.resize(160000);
  EXPECT_THROW(writeVolume(folder / "a.nii", longImage), Unsupported);
  EXPECT_EQ(folder.fileCount(), 0U);
}

TEST(WrittenGzip, TellsNoTime) {
  const TempFolder folder;
  writeVolume(folder / "a.nii.gz", sampleCt());
  EXPECT_EQ(readFile(folder / "a.nii.gz").substr(0, 10),
            std::string("\x1f\x8b\x08\0\0\0\0\0\0\xff", 10));
}

TEST(WrittenNifti, HasBothForms) {
  const TempFolder folder;
  writeVolume(folder / "a.nii", obliqueCt());
  NiftiStruct h = niftiStruct(folder / "a.nii");
  EXPECT_EQ(h.sformCode, 1);
  EXPECT_EQ(h.qformCode, 1);
  EXPECT_EQ(h.xyztUnits & 7, NiftiMillimetres);
  EXPECT_THAT(h.descrip.data(), StartsWith("Pneuma"));
  EXPECT_EQ(h.datatype, NiftiInt16);
  EXPECT_EQ(h.sclSlope, 1.0F);
  writeVolume(folder / "l.nii", sampleLabels());
  h = niftiStruct(folder / "l.nii");
  EXPECT_EQ(h.intentCode, NiftiLabels);
  EXPECT_EQ(h.datatype, NiftiUint8);
}

TEST(WrittenNifti, HasAQuaternionThatAgreesWithItsSform) {
  const TempFolder folder;
  for (const double flip : {1.0, -1.0}) {
    CtImage image = obliqueCt();
    image.geometry.direction.col(1) *= flip;
    writeVolume(folder / "a.nii", image);
    std::string content = readFile(folder / "a.nii");
    NiftiStruct h = niftiStruct(folder / "a.nii");
    EXPECT_EQ(h.pixdim[0], static_cast<float>(flip));
    h.sformCode = 0;
    std::memcpy(content.data(), &h, sizeof(h));
    const ImageGeometry read = readVolumeHeader(folder.put("q.nii", content)).geometry;
    const Vec3 far(11, 6, 9);
    EXPECT_LT((read.worldFromVoxel(far) - image.geometry.worldFromVoxel(far)).norm(), ToleranceMm);
    EXPECT_LT((read.origin - image.geometry.origin).norm(), ToleranceMm);
  }
}

TEST(WrittenNifti, HasTheSformAloneWhereItIsSkew) {
  const TempFolder folder;
  CtImage image = sampleCt();
  image.geometry.direction.col(2) = Vec3(0, 0.2, 1).normalized();
  writeVolume(folder / "a.nii", image);
  EXPECT_EQ(niftiStruct(folder / "a.nii").sformCode, 1);
  EXPECT_EQ(niftiStruct(folder / "a.nii").qformCode, 0);
}

/// Voxel for voxel what VTK's reader of the format finds.
template <class Reader>
void expectSameInVtk(Reader& reader, const std::filesystem::path& path, const CtImage& image) {
  reader.SetFileName(path.c_str());
  reader.Update();
  vtkImageData* data = reader.GetOutput();
  ASSERT_EQ(data->GetNumberOfPoints(), static_cast<vtkIdType>(image.voxels.size()));
  ASSERT_EQ(data->GetScalarType(), VTK_SHORT);
  EXPECT_EQ(0, std::memcmp(data->GetScalarPointer(), image.voxels.data(),
                           image.voxels.size() * sizeof(std::int16_t)));
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(data->GetSpacing()[axis], image.geometry.spacing[axis], 1e-6);
  }
}

TEST(WrittenVolume, IsReadByVtk) {
  const TempFolder folder;
  CtImage image = sampleCt();  // its first axis is long enough for VTK's NRRD reader
  for (const char* name : {"a.nii", "a.nii.gz", "a.nrrd", "a.mha"}) {
    writeVolume(folder / name, image);
  }
  const vtkNew<vtkMetaImageReader> meta;
  expectSameInVtk(*meta, folder / "a.mha", image);
  EXPECT_NEAR(meta->GetOutput()->GetOrigin()[2], image.geometry.origin.z(), ToleranceMm);
  const vtkNew<vtkNrrdReader> nrrd;
  expectSameInVtk(*nrrd, folder / "a.nrrd", image);
  EXPECT_NEAR(nrrd->GetOutput()->GetOrigin()[2], image.geometry.origin.z(), ToleranceMm);
  for (const char* name : {"a.nii", "a.nii.gz"}) {
    const vtkNew<vtkNIFTIImageReader> nifti;
    expectSameInVtk(*nifti, folder / name, image);
  }
}

TEST(WrittenNifti, LiesWhereVtkSeesIt) {
  const TempFolder folder;
  const CtImage image = obliqueCt();  // right-handed: VTK turns the slices of others round
  writeVolume(folder / "a.nii", image);
  const vtkNew<vtkNIFTIImageReader> reader;
  reader->SetFileName((folder / "a.nii").c_str());
  reader->Update();
  // Both go from voxels times spacing to RAS.
  for (vtkMatrix4x4* matrix : {reader->GetSFormMatrix(), reader->GetQFormMatrix()}) {
    ASSERT_NE(matrix, nullptr);
    for (const Vec3& voxel : {Vec3(0, 0, 0), Vec3(11, 0, 0), Vec3(0, 6, 0), Vec3(0, 0, 9)}) {
      const Vec3 scaled = voxel.cwiseProduct(image.geometry.spacing);
      const std::array<double, 4> in = {scaled.x(), scaled.y(), scaled.z(), 1.0};
      std::array<double, 4> ras{};
      matrix->MultiplyPoint(in.data(), ras.data());
      const Vec3 lps(-ras[0], -ras[1], ras[2]);
      EXPECT_LT((lps - image.geometry.worldFromVoxel(voxel)).norm(), 5 * ToleranceMm);
    }
  }
}

}  // namespace
}  // namespace pneuma
