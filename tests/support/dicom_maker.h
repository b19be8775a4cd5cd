#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/image.h"

namespace pneuma::testing {

/// How the data set and the pixels of a file are written.
enum class DicomSyntax { ImplicitLittle, ExplicitLittle, Rle, JpegLossless, Unknown };

/// A DICOM file made by hand, element by element: a CT slice that is sound unless changed.
class DicomMaker {
 public:
  /// 8 x 8 pixels of 1 mm at (0, 0, z), axial, all -1000 HU.
  explicit DicomMaker(double z = 0.0);

  /// Sets an element, group and element in one number: 0x00080060. Text is padded as it must be.
  DicomMaker& set(std::uint32_t tag, const std::string& vr, std::string value);
  DicomMaker& setText(std::uint32_t tag, const std::string& vr, const std::string& value);
  DicomMaker& setShort(std::uint32_t tag, int value);
  DicomMaker& setNumbers(std::uint32_t tag, const std::vector<double>& values);
  DicomMaker& erase(std::uint32_t tag);

  DicomMaker& size(int columns, int rows);
  DicomMaker& position(const Vec3& p);
  DicomMaker& axes(const Vec3& row, const Vec3& column);
  DicomMaker& rescale(double slope, double intercept);

  /// `hu(i, j)` of column i, row j; stored by the rescale set before.
  DicomMaker& pixels(const std::function<double(int, int)>& hu);
  DicomMaker& stored(std::vector<std::uint16_t> values);

  DicomMaker& syntax(DicomSyntax syntax);

  /// The whole file.
  std::string bytes() const;

  /// bytes() into `folder`/`name`.
  std::filesystem::path write(const std::filesystem::path& folder, const std::string& name) const;

  int columns = 8;
  int rows = 8;

 private:
  struct Element {
    std::string vr;
    std::string value;
  };

  void append(std::string& file, std::uint32_t tag, const Element& element, bool isExplicit) const;
  std::string pixelElement() const;

  std::map<std::uint32_t, Element> elements_;
  std::vector<std::uint16_t> stored_;
  double slope_ = 1.0;
  double intercept_ = -1024.0;
  DicomSyntax syntax_ = DicomSyntax::ExplicitLittle;
};

/// Samples of 16 bits as JPEG, lossless, first-order prediction (ITU-T T.81, process 14, selection
/// value 1).
std::string losslessJpeg(const std::vector<std::uint16_t>& samples, int columns, int rows);

/// A series of axial slices of `hu(point in LPS)`, in files 001.dcm, 002.dcm ... at `origin` and
/// steps of `step`; returns the makers' positions.
struct SeriesSpec {
  int columns = 12;
  int rows = 10;
  int slices = 6;
  double pixelMm = 2.0;
  Vec3 origin = Vec3(-12.0, -10.0, 100.0);
  Vec3 row = Vec3::UnitX();
  Vec3 column = Vec3::UnitY();
  Vec3 step = Vec3(0.0, 0.0, 3.0);
  std::function<double(const Vec3&)> hu = [](const Vec3& p) {
    return -900.0 + std::round(2.0 * p.x() + 3.0 * p.y() + p.z());
  };
  std::string uid = "1.2.826.0.1.3680043.9.1";
  /// Changes slice k before it is written; false leaves it out.
  std::function<bool(DicomMaker&, int k)> change = [](DicomMaker&, int) { return true; };

  Vec3 point(int i, int j, int k) const {
    return origin + pixelMm * (i * row + j * column) + k * step;
  }
};

void writeSeries(const std::filesystem::path& folder, const SeriesSpec& spec);

/// What lies beside a chest CT in a folder of a hospital, and in it: an overview of one picture, an
/// MR, a head, a series with two slices missing out of 20, and one of a single slice. Each has a
/// folder and a UID of its own; people's names are in all of them.
void writeOddSeries(const std::filesystem::path& folder);

}  // namespace pneuma::testing
