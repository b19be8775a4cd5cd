#include "io/detail/dicom_nesting.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>

#include <vtkDICOMDictionary.h>
#include <vtkDICOMVR.h>

#include "io/detail/dicom_marks.h"
#include "io/detail/input_file.h"

namespace pneuma {
namespace {

constexpr std::size_t HeadBytes = 8;  // of the shortest element
constexpr std::size_t LongestUid = 64;

/// Ends the walk; what() is the fault.
struct Unsound : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Deflated {};

/// The file ends in the middle of something: outside of sequences the parser just stops there.
struct CutOff : Unsound {
  using Unsound::Unsound;
};

/// How elements are written.
struct Form {
  bool isImplicit = false;
  bool isBigEndian = false;
};

struct Head {
  std::uint32_t tag = 0;
  vtkDICOMVR vr;  ///< as written, or of the dictionary
  std::uint32_t length = 0;
  Form inner;  ///< of elements in it
};

/// Who has which private elements of a data set: the text of element (gggg,00bb) by gggg00bb.
using Creators = std::map<std::uint32_t, std::string>;

bool isPrivate(std::uint32_t tag) { return (tag >> 16) % 2 == 1; }

bool isCreator(std::uint32_t tag) {
  return isPrivate(tag) && (tag & 0xFFFF) >= 0x10 && (tag & 0xFFFF) <= 0xFF;
}

std::string withoutPadding(std::string text) {
  text.erase(text.find_last_not_of(std::string_view(" \0", 2)) + 1);
  return text;
}

/// UN for what is not in the dictionary, but for lengths of groups and names of creators.
vtkDICOMVR knownVr(std::uint32_t tag, const Creators& creators) {
  if ((tag & 0xFFFF) == 0) return vtkDICOMVR(vtkDICOMVR::UL);
  if (isCreator(tag)) return vtkDICOMVR(vtkDICOMVR::LO);
  const vtkDICOMTag key(static_cast<unsigned short>(tag >> 16),
                        static_cast<unsigned short>(tag & 0xFFFF));
  if (const auto creator = creators.find((tag & 0xFFFF0000) | (tag >> 8 & 0xFF));
      isPrivate(tag) && creator != creators.end()) {
    const vtkDICOMTag inBlock(key.GetGroup(), static_cast<unsigned short>(tag & 0xFF));
    for (const vtkDICOMTag& asked : {inBlock, key}) {
      const vtkDICOMVR vr =
          vtkDICOMDictionary::FindDictEntry(asked, creator->second.c_str()).GetVR();
      if (vr.IsValid()) return vr;
    }
    return vtkDICOMVR(vtkDICOMVR::UN);
  }
  const vtkDICOMVR vr = vtkDICOMDictionary::FindDictEntry(key).GetVR();
  if (vr == vtkDICOMVR::OX) return vtkDICOMVR(vtkDICOMVR::OW);  // or OB: both have long lengths
  return vr.IsValid() ? vr : vtkDICOMVR(vtkDICOMVR::UN);
}

class Walk {
 public:
  explicit Walk(const std::filesystem::path& path) : file_(path) {}

  void run() {
    try {
      elements();
    } catch (const CutOff&) {
      if (depth_ > 0) throw;
    }
  }

 private:
  void elements() {
    if (startsWith(128, "DICM")) {
      at_ = 132;
    } else if (startsWith(0, "DICM")) {
      at_ = 4;
    }
    Form form;
    const std::string syntax = meta();
    if (syntax == "1.2.840.10008.1.2" || syntax == "1.2.840.10008.1.20" ||
        syntax == "1.2.840.113619.5.2") {
      form.isImplicit = true;
    } else if (syntax == "1.2.840.10008.1.2.2") {
      form.isBigEndian = true;
    } else if (syntax == "1.2.840.10008.1.2.1.99") {
      throw Deflated();
    } else if (syntax.empty() && left() >= HeadBytes) {
      form.isBigEndian = byte(at_) == 0x00 && byte(at_ + 1) == 0x08;
      form.isImplicit = !vrAt(at_ + 4).IsValid();
    }
    Creators creators;
    while (left() >= HeadBytes && element(form, 0, creators)) {
    }
  }

  std::uint64_t left() const { return at_ < file_.size() ? file_.size() - at_ : 0; }

  unsigned char byte(std::uint64_t at) {
    if (at < begin_ || at >= begin_ + filled_) {
      begin_ = at;
      filled_ = file_.read(window_, at);
      if (filled_ == 0) throw CutOff("is cut off");
    }
    return static_cast<unsigned char>(window_[at - begin_]);
  }

  bool startsWith(std::uint64_t at, std::string_view text) {
    if (at + text.size() > file_.size()) return false;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (byte(at + i) != static_cast<unsigned char>(text[i])) return false;
    }
    return true;
  }

  vtkDICOMVR vrAt(std::uint64_t at) {
    const std::array<char, 3> letters = {static_cast<char>(byte(at)),
                                         static_cast<char>(byte(at + 1)), '\0'};
    return vtkDICOMVR(letters.data());
  }

  std::uint32_t number(std::uint64_t at, int bytes, bool isBigEndian) {
    std::uint32_t value = 0;
    for (int i = 0; i < bytes; ++i) {
      value = value << 8 | byte(at + static_cast<std::uint64_t>(isBigEndian ? i : bytes - 1 - i));
    }
    return value;
  }

  std::uint32_t tagAt(std::uint64_t at, bool isBigEndian) {
    return number(at, 2, isBigEndian) << 16 | number(at + 2, 2, isBigEndian);
  }

  /// Group 0002; returns the transfer syntax, "" if it is not there.
  std::string meta() {
    std::string syntax;
    if (left() < HeadBytes + 4 || number(at_, 2, false) != 0x0002) return syntax;
    const Form form{!vrAt(at_ + 4).IsValid(), false};
    const std::uint64_t start = at_;
    std::uint64_t size = UINT64_MAX;
    if (number(at_ + 2, 2, false) == 0 && number(at_ + 6, 2, false) == 4) {
      size = std::uint64_t{number(at_ + 8, 4, false)} + 12;
    }
    Creators creators;
    while (at_ - start < size && left() >= HeadBytes && number(at_, 2, false) == 0x0002) {
      const std::uint64_t from = at_;
      const Head head = takeHead(form, creators);
      if (head.tag == dicom::TransferSyntax) {
        if (head.length > LongestUid) throw Unsound("states no transfer syntax");
        syntax = withoutPadding(textAt(at_, head.length));
        if (syntax.find_first_not_of("0123456789.") != std::string::npos) {
          throw Unsound("states no transfer syntax");
        }
      }
      at_ = from;
      if (!element(form, 0, creators)) break;
    }
    return syntax;
  }

  std::string textAt(std::uint64_t at, std::uint64_t size) {
    std::string text;
    for (std::uint64_t i = 0; i < size && at + i < file_.size(); ++i) {
      text += static_cast<char>(byte(at + i));
    }
    return text;
  }

  Head takeHead(const Form& form, const Creators& creators) {
    Head head;
    head.tag = tagAt(at_, form.isBigEndian);
    at_ += 4;
    if (form.isImplicit || head.tag >> 16 == 0xFFFE) {
      head.length = number(at_, 4, form.isBigEndian);
      if ((head.tag & 0xFFFF) == 0) head.length = 4;  // in some files it is wrong
      head.vr = knownVr(head.tag, creators);
      head.inner = form.isImplicit || head.vr != vtkDICOMVR::UN ? form : Form{true, false};
      at_ += 4;
      return head;
    }
    head.vr = vrAt(at_);
    head.length = number(at_ + 2, 2, form.isBigEndian);
    bool isLong = true;
    if (!head.vr.IsValid()) {
      const auto isPrintable = [](unsigned char c) { return c >= 0x20 && c < 0x7F; };
      isLong = isPrintable(byte(at_)) && isPrintable(byte(at_ + 1));
      if (!isLong) head.length = number(at_, 4, form.isBigEndian);
      head.vr = knownVr(head.tag, creators);
    }
    at_ += 4;
    if (isLong && head.vr.HasLongVL()) {
      if (left() < 4) throw CutOff("is cut off");
      head.length = number(at_, 4, form.isBigEndian);
      at_ += 4;
    }
    // What is written as unknown may be known all the same; it is implicit inside (PS3.5, 6.2.2).
    const bool isUnknown = head.vr == vtkDICOMVR::UN;
    head.inner = isUnknown ? Form{true, false} : form;
    if (isUnknown) head.vr = knownVr(head.tag, creators);
    return head;
  }

  /// False where the parser stops: the file has less than an element outside of sequences says.
  bool element(const Form& form, int depth, Creators& creators) {
    const Head head = takeHead(form, creators);
    if (depth == 0 && (head.tag >> 16 & 0xFF01) == 0x7F00) {
      if ((head.tag & 0xFFFF) != 0) return pixels(head, form);
      if (head.length < 4) throw Unsound("has a group of pixels without its length");
    }
    if (head.length == dicom::UndefinedLength) {
      if (head.vr == vtkDICOMVR::OB) {
        fragments(form);
      } else if (head.vr == vtkDICOMVR::SQ || head.vr == vtkDICOMVR::UN) {
        items(head, depth + 1);
      } else {
        throw Unsound("has an element of no length");
      }
      return true;
    }
    if (head.length > left()) {
      if (depth == 0) return false;
      throw Unsound("has an element that is longer than the file");
    }
    if (head.vr == vtkDICOMVR::SQ && head.length > 0) {
      if (head.length < HeadBytes) throw Unsound("has a sequence that ends early");
      items(head, depth + 1);
      return true;
    }
    if (isCreator(head.tag)) {
      creators[head.tag] = withoutPadding(textAt(at_, std::min(head.length, 256U)));
    }
    at_ += head.length;
    return true;
  }

  bool pixels(const Head& head, const Form& form) {
    if (head.length == dicom::UndefinedLength) {
      // Of a file that ends among its pixels, the parser tells.
      try {
        fragments(form);
      } catch (const Unsound&) {
        if (left() < HeadBytes) return false;
        throw;
      }
      return true;
    }
    if (head.length >= left()) return false;
    at_ += head.length;
    return true;
  }

  /// Items that hold no elements.
  void fragments(const Form& form) {
    for (;;) {
      const std::uint32_t tag = takeTag(form);
      const std::uint32_t length = takeLength(form);
      if (tag == dicom::SequenceEnd) return;
      if (tag != dicom::Item || length == dicom::UndefinedLength)
        throw Unsound("holds compressed data that are none");
      if (length > left()) {
        at_ = file_.size();
        throw Unsound("ends within its compressed data");
      }
      at_ += length;
    }
  }

  void items(const Head& head, int depth) {
    if (depth > dicom::MostNested) throw Unsound("has sequences in sequences, too deep");
    depth_ = depth;
    const std::optional<std::uint64_t> end =
        head.length == dicom::UndefinedLength ? std::nullopt : std::optional(at_ + head.length);
    while (!end || at_ < *end) {
      const std::uint32_t tag = takeTag(head.inner);
      const std::uint32_t size = takeLength(head.inner);
      if (tag == dicom::SequenceEnd) break;
      if (tag != dicom::Item) {
        // The parser leaves a sequence there, but not what is unknown.
        if (!end && head.vr != vtkDICOMVR::SQ) {
          throw Unsound("has a sequence of something else than items");
        }
        if (end) at_ = *end;
        break;
      }
      if (size != dicom::UndefinedLength && (size > left() || (end && at_ + size > *end))) {
        throw Unsound("has an item that is longer than its sequence");
      }
      item(size, head.inner, depth);
    }
    if (end && at_ != *end) throw Unsound("has a sequence that is longer than it says");
    depth_ = depth - 1;
  }

  void item(std::uint32_t size, const Form& form, int depth) {
    const std::optional<std::uint64_t> end =
        size == dicom::UndefinedLength ? std::nullopt : std::optional(at_ + size);
    Creators creators;
    while (!end || at_ < *end) {
      if (left() < HeadBytes) throw CutOff("is cut off");
      if (tagAt(at_, form.isBigEndian) == dicom::ItemEnd) {
        at_ += HeadBytes;
        break;
      }
      element(form, depth, creators);
    }
    if (end && at_ != *end) throw Unsound("has an item that is longer than it says");
  }

  std::uint32_t takeTag(const Form& form) {
    if (left() < HeadBytes) throw CutOff("is cut off");
    at_ += 4;
    return tagAt(at_ - 4, form.isBigEndian);
  }

  std::uint32_t takeLength(const Form& form) {
    at_ += 4;
    return number(at_ - 4, 4, form.isBigEndian);
  }

  ReadableFile file_;
  std::array<char, 1 << 13> window_{};
  std::uint64_t begin_ = 0;
  std::size_t filled_ = 0;
  std::uint64_t at_ = 0;
  int depth_ = 0;  ///< of the sequences that are being followed
};

}  // namespace

std::string nestingFault(const std::filesystem::path& file) {
  try {
    Walk(file).run();
    return "";
  } catch (const Deflated&) {
    return "is deflated as a whole, which is not supported; convert it, for example with gdcmconv "
           "--raw";
  } catch (const Unsound& fault) {
    return std::string(fault.what()) + ", or is damaged; copy it again from its source";
  }
}

}  // namespace pneuma
