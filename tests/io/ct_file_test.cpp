#include "io/ct_file.h"

#include <chrono>
#include <cmath>
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkDICOMDirectory.h>
#include <vtkDICOMReader.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkStringArray.h>

#include "core/error.h"
#include "core/units.h"
#include "io/temp_folder.h"
#include "io/volume_file.h"
#include "support/dicom_maker.h"

namespace pneuma {
namespace {

using ::testing::Contains;
using testing::DicomMaker;
using ::testing::HasSubstr;
using testing::SeriesSpec;
using testing::TempFolder;
using testing::writeSeries;

/// Largest difference of where voxels lie.
double distanceMm(const ImageGeometry& a, const ImageGeometry& b) {
  double largest = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 voxel;
    for (int axis = 0; axis < 3; ++axis) {
      voxel[axis] = (corner >> axis & 1) != 0 ? a.size[static_cast<std::size_t>(axis)] - 1 : 0;
    }
    largest = std::max(largest, (a.worldFromVoxel(voxel) - b.worldFromVoxel(voxel)).norm());
  }
  return largest;
}

TEST(CtFile, IsTheSameFromDicomAndFromAVolume) {
  const TempFolder folder;
  SeriesSpec spec;
  spec.step = Vec3(0.0, 0.5, 3.0);  // tilted, so that the volume has skew axes
  writeSeries(folder / "ct", spec);
  const CtFile dicom = readCt(folder / "ct");
  EXPECT_EQ(dicom.format, "DICOM");
  EXPECT_NEAR(dicom.tiltDeg, degrees(std::atan2(0.5, 3.0)), 1e-6);
  EXPECT_THAT(dicom.warnings, Contains(HasSubstr("the gantry was tilted by 9.46 deg")));
  writeVolume(folder / "ct.nrrd", dicom.image);
  const CtFile volume = readCt(folder / "ct.nrrd");
  EXPECT_EQ(volume.format, "NRRD");
  EXPECT_EQ(volume.image.voxels, dicom.image.voxels);
  EXPECT_LT(distanceMm(volume.image.geometry, dicom.image.geometry), 1e-4);
  EXPECT_NEAR(volume.tiltDeg, dicom.tiltDeg, 1e-4);
  for (const CtCorrections& corrections :
       {CtCorrections{.fixTilt = true}, CtCorrections{.fixTilt = true, .resampleMm = 1.5}}) {
    const CtFile a = readCt(folder / "ct", corrections);
    const CtFile b = readCt(folder / "ct.nrrd", corrections);
    EXPECT_EQ(a.image.geometry.size, b.image.geometry.size);
    EXPECT_LT(distanceMm(a.image.geometry, b.image.geometry), 1e-3);
    EXPECT_EQ(tiltDeg(a.image.geometry), 0.0);
  }
}

TEST(CtFile, CountsAirAndPadding) {
  const TempFolder folder;
  SeriesSpec spec;
  spec.change = [](DicomMaker& maker, int) {
    maker.setShort(0x00280103, 1);
    maker.pixels([](int i, int j) { return i < 3 ? -3024.0 : (j == 0 ? -1000.0 : 40.0); });
    return true;
  };
  writeSeries(folder / "ct", spec);
  const CtFile file = readCt(folder / "ct");
  EXPECT_DOUBLE_EQ(file.hu.paddingShare, 0.25);
  EXPECT_EQ(file.hu.lowest, -1000);
  EXPECT_EQ(file.hu.highest, 40);
  EXPECT_EQ(file.hu.percentile1, -1000.0);
  EXPECT_EQ(file.memoryBytes, 2u * 12 * 10 * 6);
}

TEST(CtFile, IsToldFromOtherFiles) {
  const TempFolder folder;
  writeSeries(folder / "ct", {});
  EXPECT_TRUE(isCtPath(folder / "ct"));
  EXPECT_TRUE(isCtPath(folder.path()));
  EXPECT_TRUE(isCtPath(folder / "ct" / "001.dcm"));
  EXPECT_FALSE(isCtPath(folder.put("ball.obj", "v 0 0 0\n")));
  EXPECT_FALSE(isCtPath(folder / "missing"));
  std::filesystem::create_directory(folder / "empty");
  EXPECT_FALSE(isCtPath(folder / "empty"));
}

TEST(CtFile, OfOneVolumeHasNoSeries) {
  const TempFolder folder;
  writeSeries(folder / "ct", {});
  writeVolume(folder / "ct.mha", readCt(folder / "ct").image);
  EXPECT_THROW(readCt(folder / "ct.mha", {}, {}, {"1"}), InvalidOption);
}

/// A folder of the real data, or nothing.
std::optional<std::filesystem::path> realData(const std::string& name) {
  const char* data = std::getenv("PNEUMA_TEST_DATA");
  if (data == nullptr || *data == '\0') return std::nullopt;
  const auto path = std::filesystem::path(data) / name;
  return std::filesystem::exists(path) ? std::optional(path) : std::nullopt;
}

TEST(RealCt, OfThickSlicesIsReadAsItSays) {
  const auto path = realData("ct_lung_dx_a0001_dicom");
  if (!path) GTEST_SKIP() << "PNEUMA_TEST_DATA has no ct_lung_dx_a0001_dicom";
  const CtFile file = readCt(*path);
  EXPECT_EQ(file.image.geometry.size, (std::array<int, 3>{512, 512, 64}));
  EXPECT_LT((file.image.geometry.spacing - Vec3(0.841797, 0.841797, 5.0)).norm(), 1e-6);
  EXPECT_EQ(file.series->kernel, "B");
  EXPECT_EQ(file.hu.highest, 2976);
  EXPECT_TRUE(file.warnings.empty());
}

TEST(RealCt, IsWhatVtkDicomReads) {
  for (const char* name : {"ct_lung_dx_a0001_dicom/series", "ct_cip64/ct-64Dicom"}) {
    const auto path = realData(name);
    if (!path) GTEST_SKIP() << "PNEUMA_TEST_DATA has no " << name;
    const vtkNew<vtkDICOMDirectory> directory;
    directory->SetDirectoryName(path->c_str());
    directory->Update();
    const vtkNew<vtkDICOMReader> reader;
    reader->SetFileNames(directory->GetFileNamesForSeries(0));
    reader->SetMemoryRowOrderToFileNative();
    reader->Update();
    const CtImage image = readCt(*path).image;
    const int* size = reader->GetOutput()->GetDimensions();
    ASSERT_EQ(image.geometry.size, (std::array<int, 3>{size[0], size[1], size[2]}));
    const auto* theirs = static_cast<const std::int16_t*>(reader->GetOutput()->GetScalarPointer());
    std::size_t different = 0;
    for (std::size_t i = 0; i < image.voxels.size(); ++i) {
      if (image.voxels[i] != theirs[i] && image.voxels[i] != PaddingHu) ++different;
    }
    EXPECT_EQ(different, 0u);
    const double* spacing = reader->GetOutput()->GetSpacing();
    for (const Vec3& voxel : {Vec3(0, 0, 0), Vec3(size[0] - 1, 3, 7), Vec3(9, 5, size[2] - 1)}) {
      const std::array<double, 4> at = {voxel.x() * spacing[0], voxel.y() * spacing[1],
                                        voxel.z() * spacing[2], 1.0};
      std::array<double, 4> patient{};
      reader->GetPatientMatrix()->MultiplyPoint(at.data(), patient.data());
      EXPECT_LT((image.geometry.worldFromVoxel(voxel) - Vec3(patient.data())).norm(), 1e-4);
    }
  }
}

TEST(RealCt, IsTheSameFromDicomNrrdAndMetaImage) {
  const auto path = realData("ct_cip64");
  if (!path) GTEST_SKIP() << "PNEUMA_TEST_DATA has no ct_cip64";
  const CtImage dicom = readCt(*path / "ct-64Dicom").image;
  for (const char* name : {"ct-64.nrrd", "ct-64.mha"}) {
    const CtImage volume = readCt(*path / name).image;
    EXPECT_EQ(dicom.voxels, volume.voxels) << name;
    EXPECT_LT(distanceMm(dicom.geometry, volume.geometry), 1e-3) << name;
  }
}

}  // namespace
}  // namespace pneuma
