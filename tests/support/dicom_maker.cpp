#include "support/dicom_maker.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>

namespace pneuma::testing {
namespace {

constexpr std::uint32_t PixelData = 0x7FE00010;

void put16(std::string& text, unsigned value) {
  text += static_cast<char>(value & 0xFF);
  text += static_cast<char>(value >> 8 & 0xFF);
}

void put32(std::string& text, std::uint32_t value) {
  put16(text, value & 0xFFFF);
  put16(text, value >> 16);
}

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.10g", value);
  return text.data();
}

std::string even(std::string value, char pad) {
  if (value.size() % 2 == 1) value += pad;
  return value;
}

std::string little(const std::vector<std::uint16_t>& values) {
  std::string bytes;
  for (const std::uint16_t value : values) put16(bytes, value);
  return bytes;
}

/// PS3.5 annex G: the high bytes, then the low ones, each as runs of literal bytes.
std::string runLengths(const std::vector<std::uint16_t>& values) {
  std::array<std::string, 2> segments;
  for (int s = 0; s < 2; ++s) {
    std::string& segment = segments[static_cast<std::size_t>(s)];
    for (std::size_t i = 0; i < values.size(); i += 128) {
      const std::size_t n = std::min<std::size_t>(128, values.size() - i);
      segment += static_cast<char>(n - 1);
      for (std::size_t k = 0; k < n; ++k) {
        segment += static_cast<char>(s == 0 ? values[i + k] >> 8 : values[i + k] & 0xFF);
      }
    }
    segment = even(segment, '\0');
  }
  std::string frame;
  put32(frame, 2);
  put32(frame, 64);
  put32(frame, static_cast<std::uint32_t>(64 + segments[0].size()));
  frame.resize(64, '\0');
  return frame + segments[0] + segments[1];
}

void putItem(std::string& text, std::uint32_t tag, const std::string& value) {
  put16(text, tag >> 16);
  put16(text, tag & 0xFFFF);
  put32(text, static_cast<std::uint32_t>(value.size()));
  text += value;
}

class BitWriter {
 public:
  explicit BitWriter(std::string& bytes) : bytes_(bytes) {}

  void put(unsigned value, int count) {
    for (int bit = count - 1; bit >= 0; --bit) {
      byte_ = byte_ << 1 | (value >> bit & 1);
      if (++filled_ == 8) flush();
    }
  }

  void end() {
    while (filled_ > 0) put(1, 1);
  }

 private:
  void flush() {
    bytes_ += static_cast<char>(byte_);
    if (byte_ == 0xFF) bytes_ += '\0';  // a marker it is not
    byte_ = 0;
    filled_ = 0;
  }

  std::string& bytes_;
  unsigned byte_ = 0;
  int filled_ = 0;
};

}  // namespace

std::string losslessJpeg(const std::vector<std::uint16_t>& samples, int columns, int rows) {
  std::string jpeg("\xFF\xD8\xFF\xC3\x00\x0B\x10", 7);  // SOI, SOF3, 16 bits
  jpeg += static_cast<char>(rows >> 8);
  jpeg += static_cast<char>(rows & 0xFF);
  jpeg += static_cast<char>(columns >> 8);
  jpeg += static_cast<char>(columns & 0xFF);
  jpeg += std::string("\x01\x01\x11\x00", 4);
  // One table: 17 categories of difference, all with codes of 5 bits.
  jpeg += std::string("\xFF\xC4\x00\x24\x00", 5);
  for (int length = 1; length <= 16; ++length) jpeg += static_cast<char>(length == 5 ? 17 : 0);
  for (int category = 0; category <= 16; ++category) jpeg += static_cast<char>(category);
  jpeg += std::string("\xFF\xDA\x00\x08\x01\x01\x00\x01\x00\x00", 10);
  BitWriter bits(jpeg);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const auto at = static_cast<std::size_t>(j * columns + i);
      int predicted = 32768;
      if (i > 0) {
        predicted = samples[at - 1];
      } else if (j > 0) {
        predicted = samples[at - static_cast<std::size_t>(columns)];
      }
      const auto difference = static_cast<std::int16_t>(samples[at] - predicted);
      int category = 0;
      while (std::abs(int{difference}) >> category != 0) ++category;
      bits.put(static_cast<unsigned>(category), 5);
      if (category == 16) continue;
      const int extra = difference >= 0 ? difference : difference + (1 << category) - 1;
      bits.put(static_cast<unsigned>(extra), category);
    }
  }
  bits.end();
  jpeg += "\xFF\xD9";
  return jpeg;
}

DicomMaker::DicomMaker(double z) {
  setText(0x00080008, "CS", "ORIGINAL\\PRIMARY\\AXIAL");
  setText(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.2");
  setText(0x00080018, "UI",
          "1.2.826.0.1.3680043.9.1.1." + std::to_string(std::lround(z * 100) + 1000000));
  setText(0x00080060, "CS", "CT");
  setText(0x0008103E, "LO", "Chest");
  setText(0x00100010, "PN", "Doe^Jane");
  setText(0x00100020, "LO", "ID-12345");
  setText(0x00180015, "CS", "CHEST");
  setText(0x00181210, "SH", "B30f");
  setText(0x0020000D, "UI", "1.2.826.0.1.3680043.9.1.2");
  setText(0x0020000E, "UI", "1.2.826.0.1.3680043.9.1");
  setText(0x00200011, "IS", "3");
  setShort(0x00280002, 1);
  setText(0x00280004, "CS", "MONOCHROME2");
  setNumbers(0x00280030, {1.0, 1.0});
  setShort(0x00280100, 16);
  setShort(0x00280101, 16);
  setShort(0x00280102, 15);
  setShort(0x00280103, 0);
  position(Vec3(0.0, 0.0, z));
  axes(Vec3::UnitX(), Vec3::UnitY());
  rescale(1.0, -1024.0);
  size(8, 8);
}

DicomMaker& DicomMaker::set(std::uint32_t tag, const std::string& vr, std::string value) {
  elements_[tag] = {vr, std::move(value)};
  return *this;
}

DicomMaker& DicomMaker::setText(std::uint32_t tag, const std::string& vr,
                                const std::string& value) {
  return set(tag, vr, even(value, vr == "UI" ? '\0' : ' '));
}

DicomMaker& DicomMaker::setShort(std::uint32_t tag, int value) {
  std::string bytes;
  put16(bytes, static_cast<unsigned>(value));
  return set(tag, "US", bytes);
}

DicomMaker& DicomMaker::setNumbers(std::uint32_t tag, const std::vector<double>& values) {
  std::string text;
  for (const double value : values) {
    if (!text.empty()) text += '\\';
    text += number(value);
  }
  return setText(tag, "DS", text);
}

DicomMaker& DicomMaker::erase(std::uint32_t tag) {
  elements_.erase(tag);
  return *this;
}

DicomMaker& DicomMaker::size(int newColumns, int newRows) {
  columns = newColumns;
  rows = newRows;
  setShort(0x00280010, rows);
  setShort(0x00280011, columns);
  return pixels([](int, int) { return -1000.0; });
}

DicomMaker& DicomMaker::position(const Vec3& p) {
  return setNumbers(0x00200032, {p.x(), p.y(), p.z()});
}

DicomMaker& DicomMaker::axes(const Vec3& row, const Vec3& column) {
  return setNumbers(0x00200037, {row.x(), row.y(), row.z(), column.x(), column.y(), column.z()});
}

DicomMaker& DicomMaker::rescale(double slope, double intercept) {
  slope_ = slope;
  intercept_ = intercept;
  setNumbers(0x00281052, {intercept});
  return setNumbers(0x00281053, {slope});
}

DicomMaker& DicomMaker::pixels(const std::function<double(int, int)>& hu) {
  stored_.clear();
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      stored_.push_back(static_cast<std::uint16_t>(std::lround((hu(i, j) - intercept_) / slope_)));
    }
  }
  return *this;
}

DicomMaker& DicomMaker::stored(std::vector<std::uint16_t> values) {
  stored_ = std::move(values);
  return *this;
}

DicomMaker& DicomMaker::syntax(DicomSyntax syntax) {
  syntax_ = syntax;
  return *this;
}

void DicomMaker::append(std::string& file, std::uint32_t tag, const Element& element,
                        bool isExplicit) const {
  put16(file, tag >> 16);
  put16(file, tag & 0xFFFF);
  const auto length = static_cast<std::uint32_t>(element.value.size());
  const bool isLong = element.vr == "OB" || element.vr == "OW" || element.vr == "SQ" ||
                      element.vr == "UN" || element.vr == "UT";
  if (!isExplicit) {
    put32(file, length);
  } else if (isLong) {
    file += element.vr;
    put16(file, 0);
    put32(file, length);
  } else {
    file += element.vr;
    put16(file, length);
  }
  file += element.value;
}

std::string DicomMaker::pixelElement() const {
  std::string file;
  if (syntax_ == DicomSyntax::ImplicitLittle || syntax_ == DicomSyntax::ExplicitLittle) {
    append(file, PixelData, {"OW", little(stored_)}, syntax_ == DicomSyntax::ExplicitLittle);
    return file;
  }
  put16(file, PixelData >> 16);
  put16(file, PixelData & 0xFFFF);
  file += std::string("OB\0\0\xFF\xFF\xFF\xFF", 8);
  putItem(file, 0xFFFEE000, "");  // no offset table
  putItem(file, 0xFFFEE000,
          syntax_ == DicomSyntax::Rle ? runLengths(stored_)
                                      : even(losslessJpeg(stored_, columns, rows), '\0'));
  putItem(file, 0xFFFEE0DD, "");
  return file;
}

std::string DicomMaker::bytes() const {
  static const std::map<DicomSyntax, std::string> Uids = {
      {DicomSyntax::ImplicitLittle, "1.2.840.10008.1.2"},
      {DicomSyntax::ExplicitLittle, "1.2.840.10008.1.2.1"},
      {DicomSyntax::Rle, "1.2.840.10008.1.2.5"},
      {DicomSyntax::JpegLossless, "1.2.840.10008.1.2.4.70"},
      {DicomSyntax::Unknown, "1.2.840.10008.1.2.4.102"}};  // MPEG-4
  std::string meta;
  append(meta, 0x00020001, {"OB", std::string("\0\1", 2)}, true);
  append(meta, 0x00020002, {"UI", elements_.at(0x00080016).value}, true);
  append(meta, 0x00020003, {"UI", elements_.at(0x00080018).value}, true);
  append(meta, 0x00020010, {"UI", even(Uids.at(syntax_), '\0')}, true);
  append(meta, 0x00020012, {"UI", even("1.2.826.0.1.3680043.9", '\0')}, true);
  std::string length;
  put32(length, static_cast<std::uint32_t>(meta.size()));
  std::string file = std::string(128, '\0') + "DICM";
  append(file, 0x00020000, {"UL", length}, true);
  file += meta;
  bool written = stored_.empty();
  for (const auto& [tag, element] : elements_) {
    if (!written && tag > PixelData) {
      file += pixelElement();
      written = true;
    }
    append(file, tag, element, syntax_ != DicomSyntax::ImplicitLittle);
  }
  return written ? file : file + pixelElement();
}

std::filesystem::path DicomMaker::write(const std::filesystem::path& folder,
                                        const std::string& name) const {
  std::filesystem::create_directories(folder);
  const std::string content = bytes();
  std::ofstream(folder / name, std::ios::binary)
      .write(content.data(), static_cast<std::streamsize>(content.size()));
  return folder / name;
}

void writeSeries(const std::filesystem::path& folder, const SeriesSpec& spec) {
  for (int k = 0; k < spec.slices; ++k) {
    DicomMaker maker(spec.point(0, 0, k).z());
    maker.setText(0x0020000E, "UI", spec.uid);
    maker.setText(0x00080018, "UI", spec.uid + ".9." + std::to_string(k + 1));
    maker.setNumbers(0x00280030, {spec.pixelMm, spec.pixelMm});
    maker.axes(spec.row, spec.column).position(spec.point(0, 0, k)).size(spec.columns, spec.rows);
    maker.pixels([&](int i, int j) { return spec.hu(spec.point(i, j, k)); });
    if (!spec.change(maker, k)) continue;
    std::array<char, 16> name{};
    std::snprintf(name.data(), name.size(), "%03d.dcm", k + 1);
    maker.write(folder, name.data());
  }
}

void writeOddSeries(const std::filesystem::path& folder) {
  const auto write = [&](const char* name, int number, int slices, auto change) {
    SeriesSpec spec;
    spec.slices = slices;
    spec.columns = spec.rows = 32;
    spec.pixelMm = 10.0;
    spec.origin = Vec3(-160.0, -160.0, 0.0);
    spec.step = Vec3(0.0, 0.0, 10.0);
    spec.hu = [](const Vec3& p) { return p.head<2>().norm() < 100.0 ? -850.0 : 40.0; };
    spec.uid = "1.2.826.0.1.3680043.9.7." + std::to_string(number);
    spec.change = [=](DicomMaker& maker, int k) {
      maker.setText(0x0008103E, "LO", name);
      maker.setText(0x00200011, "IS", std::to_string(number));
      return change(maker, k);
    };
    writeSeries(folder / name, spec);
  };
  write("Scout", 1, 1, [](DicomMaker& maker, int) {
    maker.setText(0x00080008, "CS", "ORIGINAL\\PRIMARY\\LOCALIZER");
    return true;
  });
  write("Heart MR", 2, 20, [](DicomMaker& maker, int) {
    maker.setText(0x00080060, "CS", "MR");
    return true;
  });
  write("Head", 3, 20, [](DicomMaker& maker, int) {
    maker.setText(0x00180015, "CS", "HEAD");
    return true;
  });
  write("Chest, gaps", 4, 20, [](DicomMaker&, int k) { return k != 7 && k != 8; });
  write("Single", 5, 1, [](DicomMaker&, int) { return true; });
}

}  // namespace pneuma::testing
