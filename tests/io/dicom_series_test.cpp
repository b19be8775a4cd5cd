#include "io/dicom_series.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/units.h"
#include "io/ct_file.h"
#include "io/temp_folder.h"
#include "support/dicom_maker.h"
#include "support/progress_recorder.h"

namespace pneuma {
namespace {

using ::testing::Contains;
using testing::DicomMaker;
using testing::DicomSyntax;
using ::testing::HasSubstr;
using testing::ProgressRecorder;
using testing::SeriesSpec;
using testing::TempFolder;
using testing::writeSeries;

/// Every voxel holds what the phantom has at its place, to the rounding of stored values.
void expectPhantom(const CtImage& image, const SeriesSpec& spec, double tolerance = 0.51) {
  const ImageGeometry& geometry = image.geometry;
  int wrong = 0;
  for (int k = 0; k < geometry.size[2]; ++k) {
    for (int j = 0; j < geometry.size[1]; ++j) {
      for (int i = 0; i < geometry.size[0]; ++i) {
        const double hu = spec.hu(geometry.worldFromVoxel(Vec3(i, j, k)));
        if (std::abs(image.at(i, j, k) - hu) > tolerance) ++wrong;
      }
    }
  }
  EXPECT_EQ(wrong, 0);
}

/// The corners lie where the series says, to 1e-4 mm.
void expectCorners(const CtImage& image, const SeriesSpec& spec) {
  for (const int i : {0, spec.columns - 1}) {
    for (const int j : {0, spec.rows - 1}) {
      for (const int k : {0, spec.slices - 1}) {
        const Vec3 p = image.geometry.worldFromVoxel(Vec3(i, j, k));
        const Vec3 up = spec.row.cross(spec.column);
        const int slice = spec.step.dot(up) > 0.0 ? k : spec.slices - 1 - k;
        EXPECT_LT((p - spec.point(i, j, slice)).norm(), 1e-4);
      }
    }
  }
}

CtImage readFirst(const std::filesystem::path& path, const CtCorrections& corrections = {}) {
  return readDicomSeries(listDicomSeries(path).front(), corrections);
}

TEST(DicomSeries, ComesBackVoxelByVoxelInEverySyntax) {
  for (const DicomSyntax syntax : {DicomSyntax::ExplicitLittle, DicomSyntax::ImplicitLittle,
                                   DicomSyntax::Rle, DicomSyntax::JpegLossless}) {
    const TempFolder folder;
    SeriesSpec spec;
    spec.change = [&](DicomMaker& maker, int) {
      maker.syntax(syntax);
      return true;
    };
    writeSeries(folder.path(), spec);
    const CtImage image = readFirst(folder.path());
    EXPECT_EQ(image.geometry.size, (std::array<int, 3>{12, 10, 6}));
    expectCorners(image, spec);
    expectPhantom(image, spec);
  }
}

TEST(DicomSeries, IsStackedAlongItsNormalWhateverTheOrderOfItsFiles) {
  const TempFolder folder;
  SeriesSpec spec;
  spec.step = Vec3(0.0, 0.0, -3.0);
  writeSeries(folder.path(), spec);
  const CtImage image = readFirst(folder.path());
  EXPECT_GT(image.geometry.direction(2, 2), 0.0);
  expectCorners(image, spec);
  expectPhantom(image, spec);
}

TEST(DicomSeries, KeepsObliqueDirections) {
  const TempFolder folder;
  SeriesSpec spec;
  const double angle = radians(20.0);
  spec.row = Vec3(std::cos(angle), std::sin(angle), 0.0);
  spec.column = Vec3(0.0, 0.0, -1.0);  // coronal, turned
  spec.step = spec.row.cross(spec.column) * 3.0;
  spec.hu = [](const Vec3& p) { return -900.0 + std::round(2.0 * p.x() + 3.0 * p.y() + p.z()); };
  writeSeries(folder.path(), spec);
  const DicomSeries series = listDicomSeries(folder.path()).front();
  EXPECT_THAT(series.reasons, Contains("not axial"));
  const CtImage image = readDicomSeries(series);
  expectCorners(image, spec);
  expectPhantom(image, spec, 1.01);  // positions are written with ten digits, HU rounded
}

TEST(DicomSeries, TakesEachSliceWithItsOwnRescale) {
  const TempFolder folder;
  SeriesSpec spec;
  spec.change = [&](DicomMaker& maker, int k) {
    maker.rescale(k % 2 == 0 ? 1.0 : 0.5, k % 2 == 0 ? -1024.0 : -1000.25);
    maker.pixels([&](int i, int j) { return spec.hu(spec.point(i, j, k)); });
    return true;
  };
  writeSeries(folder.path(), spec);
  const DicomSeries series = listDicomSeries(folder.path()).front();
  EXPECT_THAT(series.notes, Contains(HasSubstr("differ in slope and intercept")));
  expectPhantom(readDicomSeries(series), spec);
}

TEST(DicomSeries, FindsTheTiltAndKeepsOrUndoesIt) {
  const TempFolder folder;
  SeriesSpec spec;
  spec.slices = 8;
  spec.step = Vec3(0.0, 0.8, 3.0);
  spec.hu = [](const Vec3& p) { return -900.0 + 4.0 * p.z(); };
  writeSeries(folder.path(), spec);
  const DicomSeries series = listDicomSeries(folder.path()).front();
  const double tilt = degrees(std::atan2(0.8, 3.0));
  EXPECT_NEAR(series.check.tiltDeg, tilt, 1e-6);
  EXPECT_NEAR(series.check.spacingMm, 3.0, 1e-9);
  const CtImage skew = readDicomSeries(series);
  EXPECT_NEAR(tiltDeg(skew.geometry), tilt, 1e-6);
  expectCorners(skew, spec);
  expectPhantom(skew, spec);
  const CtImage straight = readDicomSeries(series, {.fixTilt = true});
  EXPECT_NEAR(tiltDeg(straight.geometry), 0.0, 1e-9);
  for (int k = 0; k < 8; ++k) {
    EXPECT_NEAR(straight.at(6, 6, k), spec.hu(straight.geometry.worldFromVoxel(Vec3(6, 6, k))),
                0.6);
  }
}

TEST(DicomSeries, NamesMissingSlicesAndFillsThemWhenAsked) {
  const TempFolder folder;
  SeriesSpec spec;
  spec.slices = 9;
  spec.change = [](DicomMaker&, int k) { return k != 3 && k != 4 && k != 6; };
  writeSeries(folder.path(), spec);
  const DicomSeries series = listDicomSeries(folder.path()).front();
  ASSERT_EQ(series.check.gaps.size(), 2u);
  EXPECT_EQ(series.check.missing(), 3);
  EXPECT_EQ(
      gapsText(series),
      "2 slices are missing between S 106 mm and S 115 mm (at S 109 mm, S 112 mm); 1 slice is "
      "missing between S 115 mm and S 121 mm (at S 118 mm)");
  EXPECT_THROW(readDicomSeries(series), InvalidInput);
  const CtImage image = readDicomSeries(series, {.fillGaps = true});
  EXPECT_EQ(image.geometry.size[2], 9);
  expectCorners(image, spec);
  expectPhantom(image, spec);  // linear in z, so that interpolation is exact
}

TEST(DicomSeries, DropsCopiesAndRefusesDifferentSlicesInOnePlace) {
  const TempFolder folder;
  const SeriesSpec spec;
  writeSeries(folder.path(), spec);
  std::filesystem::copy(folder / "002.dcm", folder / "copy.dcm");
  const DicomSeries series = listDicomSeries(folder.path()).front();
  EXPECT_EQ(series.check.duplicates.size(), 1u);
  expectPhantom(readDicomSeries(series), spec);
  const CtFile file = readCt(folder.path());
  EXPECT_THAT(file.notes, Contains(HasSubstr("1 slice was there twice")));

  DicomMaker other(103.0);
  other.axes(spec.row, spec.column).position(spec.point(0, 0, 1)).size(12, 10);
  other.setNumbers(0x00280030, {2.0, 2.0});
  other.write(folder.path(), "other.dcm");
  try {
    readFirst(folder.path());
    FAIL() << "one of two different slices was taken";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("different slices in one place"));
    EXPECT_THAT(error.what(), HasSubstr("other.dcm"));
    EXPECT_THAT(error.what(), HasSubstr("S 103 mm"));
  }
}

TEST(DicomSeries, FindsUnevenSpacingAndResamplesFromWhereSlicesStand) {
  const TempFolder folder;
  SeriesSpec spec;
  spec.slices = 9;
  spec.hu = [](const Vec3& p) { return -900.0 + 10.0 * (p.z() - 100.0); };
  spec.change = [&](DicomMaker& maker, int k) {
    const Vec3 p = spec.point(0, 0, k) + Vec3(0.0, 0.0, k % 2 == 1 ? 0.5 : 0.0);
    maker.position(p);
    maker.pixels([&](int, int) { return spec.hu(p); });
    return true;
  };
  writeSeries(folder.path(), spec);
  const DicomSeries series = listDicomSeries(folder.path()).front();
  EXPECT_TRUE(series.check.uneven());
  EXPECT_TRUE(series.check.gaps.empty());
  EXPECT_NEAR(series.geometry.spacing.z(), 3.0, 1e-9);
  const CtImage image = readDicomSeries(series, {.resampleMm = 1.0});
  for (int k = 1; k + 1 < image.geometry.size[2]; ++k) {
    const Vec3 p = image.geometry.worldFromVoxel(Vec3(5, 5, k));
    EXPECT_NEAR(image.at(5, 5, k), spec.hu(Vec3(0, 0, std::clamp(p.z(), 100.0, 124.0))), 1.1);
  }
}

TEST(DicomSeries, SetsPaddingApart) {
  const TempFolder folder;
  SeriesSpec spec;
  spec.change = [](DicomMaker& maker, int k) {
    maker.setShort(0x00280103, 1);
    maker.rescale(1.0, 0.0);
    maker.pixels([&](int i, int j) {
      if (k < 3) return i == 0 ? -2000.0 : (i == 5 && j == 5 ? -1100.0 : -800.0);
      return i == 0 ? -3024.0 : -800.0;  // in the corners, though nobody declares it
    });
    if (k < 3) maker.setShort(0x00280120, -2000);
    return true;
  };
  writeSeries(folder.path(), spec);
  const CtImage image = readFirst(folder.path());
  for (int k = 0; k < 6; ++k) {
    EXPECT_EQ(image.at(0, 4, k), PaddingHu);
    EXPECT_EQ(image.at(1, 4, k), -800);
  }
  EXPECT_EQ(image.at(5, 5, 1), -1100);  // noise in air is no padding
}

TEST(DicomSeries, TakesDeclaredPaddingAtAirOnlyFromTheEdge) {
  const TempFolder folder;
  SeriesSpec spec;
  spec.change = [](DicomMaker& maker, int) {
    maker.setShort(0x00280120, 0);  // -1024 HU
    maker.pixels([](int i, int j) { return i < 2 || (i == 6 && j == 5) ? -1024.0 : -300.0; });
    return true;
  };
  writeSeries(folder.path(), spec);
  const CtImage image = readFirst(folder.path());
  EXPECT_EQ(image.at(1, 5, 2), PaddingHu);
  EXPECT_EQ(image.at(6, 5, 2), -1024);
}

TEST(DicomSeries, AreRankedWithReasons) {
  const TempFolder folder;
  const auto add = [&](const std::string& name, const std::string& uid, int slices, double step,
                       const std::string& kernel) {
    SeriesSpec spec;
    spec.slices = slices;
    spec.step = Vec3(0.0, 0.0, step);
    spec.uid = uid;
    spec.change = [&](DicomMaker& maker, int) {
      maker.setText(0x00181210, "SH", kernel).setText(0x0008103E, "LO", name);
      return true;
    };
    writeSeries(folder / name, spec);
  };
  add("thick", "1.2.1", 40, 5.0, "B30f");
  add("sharp", "1.2.2", 80, 2.5, "B70f");
  add("soft", "1.2.3", 80, 2.5, "B30f");
  SeriesSpec scout;
  scout.uid = "1.2.4";
  scout.slices = 1;
  scout.change = [](DicomMaker& maker, int) {
    maker.setText(0x00080008, "CS", "ORIGINAL\\PRIMARY\\LOCALIZER");
    return true;
  };
  writeSeries(folder / "scout", scout);
  const std::vector<DicomSeries> all = listDicomSeries(folder.path());
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[0].description, "soft");
  EXPECT_EQ(all[1].description, "sharp");
  EXPECT_EQ(all[2].description, "thick");
  EXPECT_EQ(all[0].rating, 5);
  EXPECT_EQ(all[2].rating, 4);
  EXPECT_EQ(all[3].rating, 0);
  EXPECT_THAT(all[0].reasons, Contains("slices 2.5 mm apart"));
  EXPECT_THAT(all[0].reasons, Contains("80 slices"));
  EXPECT_THAT(all[0].reasons, Contains("kernel B30f"));
  EXPECT_THAT(all[3].reasons, Contains(HasSubstr("localizer")));
}

TEST(DicomSeries, OfOtherPartsOfTheBodyComeLast) {
  const TempFolder folder;
  const auto add = [&](const std::string& part, const char* uid, int slices, const char* modality) {
    SeriesSpec spec;
    spec.uid = uid;
    spec.slices = slices;
    spec.change = [=](DicomMaker& maker, int) {
      maker.setText(0x00180015, "CS", part).setText(0x00080060, "CS", modality);
      return true;
    };
    writeSeries(folder / uid, spec);
  };
  add("HEAD", "1.2.1", 80, "CT");
  add("CHESTABDPELVIS", "1.2.2", 6, "CT");
  add("", "1.2.3", 8, "CT");
  add("CHEST", "1.2.4", 90, "MR");
  const std::vector<DicomSeries> all = listDicomSeries(folder.path());
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[0].uid, "1.2.3");
  EXPECT_EQ(all[1].uid, "1.2.2");
  EXPECT_EQ(all[2].uid, "1.2.1");
  EXPECT_TRUE(all[2].ofAnotherPart);
  EXPECT_EQ(all[2].rating, 0);
  EXPECT_THAT(all[2].reasons, Contains("not the chest, body part stated: HEAD"));
  EXPECT_TRUE(all[3].refusal.has_value());
}

TEST(DicomSeries, OfOneFileAreTheFilesBesideItOfTheSameSeries) {
  const TempFolder folder;
  SeriesSpec spec;
  writeSeries(folder.path(), spec);
  DicomMaker other(50.0);
  other.setText(0x0020000E, "UI", "1.2.3.4");
  other.write(folder.path(), "another.dcm");
  folder.put("LICENSE", "free");
  const std::vector<DicomSeries> all = listDicomSeries(folder / "004.dcm");
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].slices.size(), 6u);
}

TEST(DicomSeries, DoNotMindNamesAndOtherFiles) {
  const TempFolder folder;
  const std::filesystem::path odd = folder / "J\u00fcrgens  Thorax" / "Folge  5 mm";
  SeriesSpec spec;
  writeSeries(odd, spec);
  std::ofstream(odd / "\u00dcbersicht.txt") << "nothing";
  std::ofstream(odd / "empty.dcm");
  const std::vector<DicomSeries> all = listDicomSeries(odd.parent_path());
  ASSERT_EQ(all.size(), 1u);
  EXPECT_THAT(all[0].notes, Contains(HasSubstr("empty.dcm")));
  expectPhantom(readDicomSeries(all[0]), spec);
}

TEST(DicomSeries, KeepIdentifiersApart) {
  const TempFolder folder;
  writeSeries(folder.path(), {});
  const DicomSeries series = listDicomSeries(folder.path()).front();
  EXPECT_EQ(series.identifiers.at("PatientName"), "Doe^Jane");
  EXPECT_EQ(series.identifiers.at("PatientID"), "ID-12345");
}

TEST(DicomSeries, StopOnRequest) {
  const TempFolder folder;
  writeSeries(folder.path(), {});
  ProgressRecorder stop(0.0);
  EXPECT_THROW(listDicomSeries(folder.path(), Progress(stop)), Cancelled);
  const DicomSeries series = listDicomSeries(folder.path()).front();
  EXPECT_THROW(readDicomSeries(series, {}, Progress(stop)), Cancelled);
  ProgressRecorder halfway(0.5);
  EXPECT_THROW(readDicomSeries(series, {}, Progress(halfway)), Cancelled);
}

}  // namespace
}  // namespace pneuma
