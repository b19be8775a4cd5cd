#include "io/detail/dicom_elements.h"

#include <algorithm>
#include <array>

#include <vtkDICOMDictionary.h>
#include <vtkDICOMVR.h>

#include "core/error.h"
#include "io/detail/dicom_marks.h"
#include "io/detail/text_fields.h"

namespace pneuma {
namespace {

constexpr std::size_t PreambleSize = 128;
constexpr std::uint32_t PixelData = 0x7FE00010;

/// Representations whose length takes four bytes.
bool isLong(std::string_view vr) {
  static constexpr std::array<std::string_view, 13> Long = {
      "OB", "OD", "OF", "OL", "OV", "OW", "SQ", "SV", "UC", "UN", "UR", "UT", "UV"};
  return std::ranges::find(Long, vr) != Long.end();
}

std::string dictionaryVr(std::uint32_t tag) {
  const vtkDICOMTag key(static_cast<unsigned short>(tag >> 16),
                        static_cast<unsigned short>(tag & 0xFFFF));
  const vtkDICOMDictEntry entry = vtkDICOMDictionary::FindDictEntry(key);
  const vtkDICOMVR vr = entry.GetVR();
  if (!entry.IsValid() || !vr.IsValid()) return "UN";
  const std::string text = vr.GetText();
  return text == "OX" ? "OW" : text == "XS" ? "US" : text;
}

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  std::size_t at() const { return at_; }

  bool atEnd() const { return at_ >= bytes_.size(); }

  void moveTo(std::size_t at) { at_ = at; }

  std::uint32_t peekTag() {
    const std::size_t start = at_;
    const std::uint32_t found = tag();
    at_ = start;
    return found;
  }

  /// All elements up to `end`, or to the end of an item where that is not known.
  DicomDataSet dataSet(std::size_t end, bool isExplicit, int depth) {
    if (depth > dicom::MostNested) damaged("its sequences are nested too deeply");
    DicomDataSet elements;
    while (at_ < end) {
      const std::uint32_t next = tag();
      if (next == dicom::ItemEnd) {
        if (depth == 0) damaged("an item ends that never began");
        number(4);
        return elements;
      }
      elements.push_back(element(next, isExplicit, depth));
    }
    if (at_ > end) damaged("an element reaches beyond its item");
    return elements;
  }

  /// Elements of group 0002, which are always explicit.
  DicomDataSet meta() {
    DicomDataSet elements;
    while (!atEnd() && peekTag() >> 16 == 0x0002) {
      const std::uint32_t next = tag();
      elements.push_back(element(next, true, 0));
    }
    return elements;
  }

 private:
  [[noreturn]] void damaged(const std::string& how) const {
    throw InvalidInput(quotedName(name_) + " is damaged: " + how + " (byte " + std::to_string(at_) +
                       ")");
  }

  std::string_view take(std::size_t size) {
    if (size > bytes_.size() - std::min(at_, bytes_.size())) damaged("it ends early");
    const std::string_view part = bytes_.substr(at_, size);
    at_ += size;
    return part;
  }

  std::uint32_t number(std::size_t size) {
    std::uint32_t value = 0;
    const std::string_view part = take(size);
    for (std::size_t i = size; i-- > 0;) value = value << 8 | static_cast<unsigned char>(part[i]);
    return value;
  }

  std::uint32_t tag() {
    const std::uint32_t group = number(2);
    return group << 16 | number(2);
  }

  DicomElement element(std::uint32_t found, bool isExplicit, int depth) {
    DicomElement result;
    result.tag = found;
    std::uint32_t length = 0;
    if (isExplicit) {
      result.vr = take(2);
      if (isLong(result.vr)) {
        number(2);
        length = number(4);
      } else {
        length = number(2);
      }
    } else {
      result.vr = dictionaryVr(found);
      length = number(4);
    }
    if (found == PixelData && length == dicom::UndefinedLength) {
      result.encapsulated = true;
      result.value = fragments();
    } else if (result.vr == "SQ" || length == dicom::UndefinedLength) {
      // What is unknown and of no stated length is a sequence in implicit encoding (PS3.5, 6.2.2).
      const bool inner = isExplicit && result.vr != "UN";
      result.items = sequence(length, inner, depth + 1);
      result.vr = "SQ";
    } else {
      result.value = take(length);
    }
    return result;
  }

  std::vector<DicomDataSet> sequence(std::uint32_t length, bool isExplicit, int depth) {
    std::vector<DicomDataSet> items;
    const std::size_t end = length == dicom::UndefinedLength ? bytes_.size() : at_ + length;
    if (end > bytes_.size()) damaged("a sequence reaches beyond its end");
    while (at_ < end) {
      const std::uint32_t next = tag();
      const std::uint32_t size = number(4);
      if (next == dicom::SequenceEnd) return items;
      if (next != dicom::Item) damaged("a sequence holds something that is no item");
      const std::size_t itemEnd = size == dicom::UndefinedLength ? bytes_.size() : at_ + size;
      if (itemEnd > bytes_.size()) damaged("an item reaches beyond the end");
      items.push_back(dataSet(itemEnd, isExplicit, depth));
    }
    return items;
  }

  /// Compressed pixels with their items, up to and with the end of the sequence.
  std::string fragments() {
    const std::size_t start = at_;
    while (true) {
      const std::uint32_t next = tag();
      const std::uint32_t size = number(4);
      if (next == dicom::SequenceEnd) return std::string(bytes_.substr(start, at_ - start));
      if (next != dicom::Item) damaged("its compressed pixels hold something that is no item");
      take(size);
    }
  }

  std::string_view bytes_;
  std::string name_;
  std::size_t at_ = 0;
};

void put16(std::string& text, std::uint32_t value) {
  text += static_cast<char>(value & 0xFF);
  text += static_cast<char>(value >> 8 & 0xFF);
}

void put32(std::string& text, std::uint32_t value) {
  put16(text, value & 0xFFFF);
  put16(text, value >> 16);
}

void putTag(std::string& text, std::uint32_t tag) {
  put16(text, tag >> 16);
  put16(text, tag & 0xFFFF);
}

std::string encoded(const DicomDataSet& elements, bool isExplicit);

std::string valueOf(const DicomElement& element, bool isExplicit) {
  if (element.vr != "SQ") return element.value;
  std::string value;
  for (const DicomDataSet& item : element.items) {
    const std::string content = encoded(item, isExplicit);
    putTag(value, dicom::Item);
    put32(value, static_cast<std::uint32_t>(content.size()));
    value += content;
  }
  return value;
}

std::string encoded(const DicomDataSet& elements, bool isExplicit) {
  std::string text;
  for (const DicomElement& element : elements) {
    const std::string value = valueOf(element, isExplicit);
    const std::uint32_t length =
        element.encapsulated ? dicom::UndefinedLength : static_cast<std::uint32_t>(value.size());
    putTag(text, element.tag);
    if (!isExplicit) {
      put32(text, length);
    } else {
      text += element.vr;
      if (isLong(element.vr)) {
        put16(text, 0);
        put32(text, length);
      } else {
        put16(text, length);
      }
    }
    text += value;
  }
  return text;
}

}  // namespace

std::string DicomElement::text() const {
  std::string_view content = value;
  while (!content.empty() && (content.back() == ' ' || content.back() == '\0')) {
    content.remove_suffix(1);
  }
  return std::string(content);
}

DicomElement dicomText(std::uint32_t tag, const std::string& vr, std::string value) {
  if (value.size() % 2 == 1) value += vr == "UI" ? '\0' : ' ';
  DicomElement element;
  element.tag = tag;
  element.vr = vr;
  element.value = std::move(value);
  return element;
}

DicomElements dicomElements(std::string_view file, const std::string& name) {
  if (file.size() < PreambleSize + 4 || file.substr(PreambleSize, 4) != "DICM") {
    throw Unsupported(quotedName(name) + " has no DICOM file header; convert it first");
  }
  Reader reader(file, name);
  reader.moveTo(PreambleSize + 4);
  DicomElements result;
  result.meta = reader.meta();
  std::erase_if(result.meta, [](const DicomElement& e) { return e.tag == 0x00020000; });
  const auto syntax = std::ranges::find(result.meta, dicom::TransferSyntax, &DicomElement::tag);
  if (syntax == result.meta.end()) {
    throw InvalidInput(quotedName(name) + " does not state its transfer syntax");
  }
  const std::string uid = syntax->text();
  if (uid == "1.2.840.10008.1.2.2" || uid == "1.2.840.10008.1.2.1.99" ||
      uid == "1.2.840.113619.5.2") {
    throw Unsupported(quotedName(name) +
                      " is written in big endian or deflated, which is not supported; convert it, "
                      "for example with gdcmconv");
  }
  result.isExplicit = uid != "1.2.840.10008.1.2";
  result.data = reader.dataSet(file.size(), result.isExplicit, 0);
  return result;
}

std::string dicomFile(const DicomElements& elements) {
  const std::string meta = encoded(elements.meta, true);
  std::string file(PreambleSize, '\0');
  file += "DICM";
  putTag(file, 0x00020000);
  file += "UL";
  put16(file, 4);
  put32(file, static_cast<std::uint32_t>(meta.size()));
  file += meta;
  return file + encoded(elements.data, elements.isExplicit);
}

}  // namespace pneuma
