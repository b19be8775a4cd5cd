#include "io/dicom_writer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>
#include <vtkDICOMCTRectifier.h>
#include <vtkDICOMMetaData.h>
#include <vtkDICOMReader.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkStringArray.h>

#include "core/units.h"
#include "io/temp_folder.h"
#include "support/progress_recorder.h"

namespace pneuma {
namespace {

using testing::TempFolder;

/// Every voxel has a value of its own.
CtImage image(const ImageGeometry& geometry) {
  CtImage made{geometry, std::vector<std::int16_t>(geometry.voxelCount())};
  for (std::size_t i = 0; i < made.voxels.size(); ++i) {
    made.voxels[i] = static_cast<std::int16_t>(static_cast<int>(i % 4000) - 1024);
  }
  made.voxels.front() = PaddingHu;
  return made;
}

ImageGeometry oblique() {
  ImageGeometry geometry;
  geometry.size = {7, 5, 4};
  geometry.spacing = {0.7031, 0.7031, 2.5};
  geometry.origin = {-171.3, -12.25, 1203.875};
  geometry.direction = Eigen::AngleAxisd(0.3, Vec3(0.2, -0.5, 1.0).normalized()).matrix();
  return geometry;
}

ImageGeometry tilted(double tiltDeg) {
  ImageGeometry geometry = oblique();
  const double angle = radians(tiltDeg);
  geometry.direction.setIdentity();
  geometry.direction.col(1) = Vec3(0.0, std::cos(angle), std::sin(angle));
  return geometry;
}

struct ReadBack {
  vtkNew<vtkDICOMReader> reader;

  explicit ReadBack(const std::filesystem::path& folder) {
    std::set<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      files.insert(entry.path().string());
    }
    vtkNew<vtkStringArray> names;
    for (const std::string& file : files) names->InsertNextValue(file);
    reader->SetFileNames(names);
    reader->SetMemoryRowOrderToFileNative();
    reader->Update();
  }

  std::string text(vtkDICOMTag tag) { return reader->GetMetaData()->Get(0, tag).AsString(); }
};

void expectSame(const CtImage& written, ReadBack& back) {
  const ImageGeometry& geometry = written.geometry;
  ASSERT_EQ(back.reader->GetErrorCode(), 0U);
  vtkImageData* data = back.reader->GetOutput();
  ASSERT_EQ(data->GetDimensions()[0], geometry.size[0]);
  ASSERT_EQ(data->GetDimensions()[1], geometry.size[1]);
  ASSERT_EQ(data->GetDimensions()[2], geometry.size[2]);
  for (int k = 0; k < geometry.size[2]; ++k) {
    for (int j = 0; j < geometry.size[1]; ++j) {
      for (int i = 0; i < geometry.size[0]; ++i) {
        ASSERT_EQ(data->GetScalarComponentAsDouble(i, j, k, 0), written.at(i, j, k))
            << i << " " << j << " " << k;
        const double* spacing = data->GetSpacing();
        const double voxel[4] = {i * spacing[0], j * spacing[1], k * spacing[2], 1.0};
        double p[4];
        back.reader->GetPatientMatrix()->MultiplyPoint(voxel, p);
        const Vec3 wanted = geometry.worldFromVoxel(Vec3(i, j, k));
        ASSERT_LT((Vec3(p[0], p[1], p[2]) - wanted).norm(), 1e-4);
      }
    }
  }
}

TEST(DicomWriter, SeriesReadBackVoxelForVoxelWhereTheyWere) {
  const TempFolder folder;
  const CtImage written = image(oblique());
  writeDicomSeries(folder.path(), written, {});
  ReadBack back(folder.path());
  expectSame(written, back);
  EXPECT_EQ(back.text(DC::Modality), "CT");
  EXPECT_EQ(back.text(DC::PatientName), "PNEUMA^SAMPLE");
  EXPECT_EQ(back.text(DC::SOPClassUID), "1.2.840.10008.5.1.4.1.1.2");
  EXPECT_EQ(back.text(DC::PixelPaddingValue), "-1024");
  EXPECT_FALSE(back.reader->GetMetaData()->Has(DC::GantryDetectorTilt));
}

TEST(DicomWriter, TiltedSeriesKeepTheirShear) {
  for (const double tiltDeg : {12.0, -20.0}) {
    const TempFolder folder;
    const CtImage written = image(tilted(tiltDeg));
    writeDicomSeries(folder.path(), written, {});
    ReadBack back(folder.path());
    expectSame(written, back);
    const double told = std::stod(back.text(DC::GantryDetectorTilt));
    EXPECT_NEAR(told, tiltDeg, 1e-6);
    // That one tells the size of the angle only.
    EXPECT_NEAR(vtkDICOMCTRectifier::GetGantryDetectorTilt(back.reader->GetPatientMatrix()),
                std::abs(told), 1e-4);
  }
}

TEST(DicomWriter, LeavesSlicesOutWithoutMovingTheOthers) {
  const TempFolder folder;
  const CtImage written = image(oblique());
  DicomWriting writing;
  writing.leftOut = {1};
  writeDicomSeries(folder.path(), written, writing);
  EXPECT_EQ(folder.fileCount(), 3U);
  EXPECT_FALSE(std::filesystem::exists(folder / "slice-0002.dcm"));
  EXPECT_TRUE(std::filesystem::exists(folder / "slice-0003.dcm"));
  EXPECT_EQ(dicomFileNames(written, writing).size(), 3U);
}

TEST(DicomWriter, TheSameIdentityGivesTheSameBytes) {
  const TempFolder folder;
  const auto written = [&](const std::string& name, const std::string& identity) {
    std::filesystem::create_directory(folder / name);
    DicomWriting writing;
    writing.identity = identity;
    writeDicomSeries(folder / name, image(oblique()), writing);
    return readFile(folder / name / "slice-0001.dcm");
  };
  const std::string one = written("one", "a");
  EXPECT_EQ(one, written("again", "a"));
  EXPECT_NE(one, written("other", "b"));
  EXPECT_EQ(one.size() % 2, 0U);
}

TEST(DicomWriter, UidsAreValidAndDiffer) {
  std::set<std::string> uids;
  for (int i = 0; i < 100; ++i) {
    const std::string uid = uidOf("series " + std::to_string(i));
    uids.insert(uid);
    EXPECT_LE(uid.size(), 64U);
    EXPECT_EQ(uid.substr(0, 5), "2.25.");
    EXPECT_NE(uid[5], '0');
    EXPECT_EQ(uid.find_first_not_of("0123456789."), std::string::npos);
  }
  EXPECT_EQ(uids.size(), 100U);
}

TEST(DicomWriter, RefusesWhatDicomCannotTell) {
  const TempFolder folder;
  ImageGeometry skew = oblique();
  skew.direction.col(1) = (skew.direction.col(1) + 0.1 * skew.direction.col(0)).normalized();
  EXPECT_THROW(writeDicomSeries(folder.path(), image(skew), {}), InvalidInput);
  EXPECT_THROW(writeDicomSeries(folder / "nowhere", image(oblique()), {}), OutputFailed);
  EXPECT_EQ(folder.fileCount(), 0U);
}

TEST(DicomWriter, ReplacesOnlyWhatItMay) {
  const TempFolder folder;
  folder.put("slice-0002.dcm", "old");
  EXPECT_THROW(writeDicomSeries(folder.path(), image(oblique()), {}, Existing::Refuse),
               OutputFailed);
  EXPECT_EQ(readFile(folder / "slice-0002.dcm"), "old");
  writeDicomSeries(folder.path(), image(oblique()), {});
  EXPECT_GT(readFile(folder / "slice-0002.dcm").size(), 200U);
}

}  // namespace
}  // namespace pneuma
