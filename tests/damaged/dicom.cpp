#include <cstdint>
#include <map>

#include "bytes.h"

/// Series of DICOM files of which one is damaged.
namespace pneuma::damaged {
namespace fs = std::filesystem;

namespace {

/// An element in explicit little endian.
struct Element {
  std::uint32_t tag = 0;
  std::string vr;
  Bytes value;
};

bool isLong(const std::string& vr) {
  return vr == "OB" || vr == "OW" || vr == "SQ" || vr == "UN" || vr == "UT" || vr == "OF";
}

std::vector<Element> elementsOf(const Bytes& file) {
  std::vector<Element> elements;
  std::size_t at = 132;
  while (at + 8 <= file.size()) {
    Element element;
    element.tag =
        static_cast<std::uint32_t>(littleAt(file, at, 2) << 16 | littleAt(file, at + 2, 2));
    element.vr = file.substr(at + 4, 2);
    const bool wide = isLong(element.vr);
    const std::size_t size = wide ? littleAt(file, at + 8, 4) : littleAt(file, at + 6, 2);
    at += wide ? 12 : 8;
    element.value = file.substr(at, size);
    at += size;
    elements.push_back(std::move(element));
  }
  return elements;
}

Bytes headOf(const Element& element, std::uint64_t size) {
  return little(element.tag >> 16, 2) + little(element.tag & 0xFFFF, 2) + element.vr +
         (isLong(element.vr) ? little(0, 2) + little(size, 4) : little(size, 2));
}

Bytes bytesOf(const Element& element) {
  return headOf(element, element.value.size()) + element.value;
}

Bytes fileOf(const Bytes& sound, const std::vector<Element>& elements) {
  Bytes file = sound.substr(0, 132);
  for (const Element& element : elements) file += bytesOf(element);
  return file;
}

/// Changes the bytes of one element; what comes out stands in its place.
Change element(std::uint32_t tag, std::function<Bytes(Element)> change) {
  return [=](const Bytes& sound) {
    Bytes file = sound.substr(0, 132);
    for (const Element& one : elementsOf(sound)) {
      file += one.tag == tag ? change(one) : bytesOf(one);
    }
    return file;
  };
}

Change value(std::uint32_t tag, const Bytes& text) {
  return element(tag, [text](Element one) {
    one.value = text.size() % 2 == 1 ? text + " " : text;
    return bytesOf(one);
  });
}

Change without(std::uint32_t tag) {
  return element(tag, [](const Element&) { return Bytes(); });
}

/// `text` before the pixels.
Change beforePixels(const Bytes& text) {
  return element(0x7FE00010, [text](const Element& one) { return text + bytesOf(one); });
}

constexpr std::uint32_t Rows = 0x00280010;
constexpr std::uint32_t Columns = 0x00280011;
constexpr std::uint32_t Spacing = 0x00280030;
constexpr std::uint32_t Position = 0x00200032;
constexpr std::uint32_t Orientation = 0x00200037;
constexpr std::uint32_t SeriesUid = 0x0020000E;
constexpr std::uint32_t Pixels = 0x7FE00010;
constexpr std::uint32_t Syntax = 0x00020010;

void damageElements(Corpus& corpus, const Format& format) {
  const auto add = [&](const std::string& detail, Change change) {
    corpus.add(format, "dicom", detail, std::move(change));
  };
  const std::map<std::string, std::uint32_t> needed = {
      {"rows", Rows},         {"columns", Columns},         {"spacing", Spacing},
      {"position", Position}, {"orientation", Orientation}, {"series", SeriesUid},
      {"pixels", Pixels},     {"syntax", Syntax},           {"modality", 0x00080060},
      {"bits", 0x00280100},   {"slope", 0x00281053}};
  for (const auto& [name, tag] : needed) {
    add("without-" + name, without(tag));
    add("empty-" + name, value(tag, ""));
    add("length-odd-" + name, element(tag, [](const Element& one) {
          return headOf(one, one.value.size() + 1) + one.value;
        }));
    add("length-too-long-" + name, element(tag, [](const Element& one) {
          return headOf(one, isLong(one.vr) ? 0xFFFFFFF0U : 0xFFFEU) + one.value;
        }));
    add("vr-unknown-" + name, element(tag, [](Element one) {
          one.vr = "ZZ";
          return bytesOf(one);
        }));
    add("twice-" + name,
        element(tag, [](const Element& one) { return bytesOf(one) + bytesOf(one); }));
  }
  add("rows-0", value(Rows, little(0, 2)));
  add("rows-65535", value(Rows, little(65535, 2)));
  add("columns-1", value(Columns, little(1, 2)));
  add("rows-of-4-bytes", value(Rows, little(0xFFFFFFFF, 4)));
  add("bits-7", value(0x00280100, little(7, 2)));
  add("bits-65535", value(0x00280100, little(65535, 2)));
  add("high-bit-99", value(0x00280102, little(99, 2)));
  add("samples-3", value(0x00280002, little(3, 2)));
  for (const char* text :
       {"0\\0", "-5\\5", "nan\\nan", "1e-9\\1e-9", "1e300\\1", "5", "x\\y", "25\\25"}) {
    std::string name = text;
    for (char& c : name) c = c == '\\' ? '_' : c;
    add("spacing-" + name, value(Spacing, text));
  }
  add("position-nan", value(Position, "nan\\0\\0"));
  add("position-1e300", value(Position, "1e300\\0\\0"));
  add("position-of-two", value(Position, "1\\2"));
  add("position-of-another", value(Position, "0\\0\\77.7"));
  add("orientation-0", value(Orientation, "0\\0\\0\\0\\0\\0"));
  add("orientation-singular", value(Orientation, "1\\0\\0\\1\\0\\0"));
  add("orientation-nan", value(Orientation, "nan\\0\\0\\0\\1\\0"));
  add("orientation-turned", value(Orientation, "0\\1\\0\\1\\0\\0"));
  add("slope-nan", value(0x00281053, "nan"));
  add("slope-1e300", value(0x00281053, "1e300"));
  add("intercept-word", value(0x00281052, "zero"));
  add("series-other", value(SeriesUid, "1.2.3.4.5"));
  add("series-no-uid", value(SeriesUid, "../../../../evil"));
  add("modality-MR", value(0x00080060, "MR"));
  add("position-text-60-kb", value(Position, Bytes(60000, '1')));
  for (const char* syntax :
       {"1.2.840.10008.1.2.4.50", "1.2.840.10008.1.2.4.70", "1.2.840.10008.1.2.4.90",
        "1.2.840.10008.1.2.5", "1.2.840.10008.1.2.1.99", "1.2.840.10008.1.2.2", "1.2.840.10008.1.2",
        "9.9.9"}) {
    add(std::string("syntax-") + syntax, value(Syntax, syntax));
  }
  const Element frames{0x00280008, "IS", "1000000000"};
  add("frames-1e9",
      element(Rows, [frames](const Element& one) { return bytesOf(frames) + bytesOf(one); }));
  add("pixels-undefined-length",
      element(Pixels, [](const Element& one) { return headOf(one, 0xFFFFFFFF) + one.value; }));
  add("pixels-in-broken-pieces", element(Pixels, [](const Element& one) {
        return headOf(one, 0xFFFFFFFF) + little(0xE000FFFE, 4) + little(0xFFFFFFF0, 4) + one.value;
      }));
  add("pixels-half", element(Pixels, [](Element one) {
        one.value.resize(one.value.size() / 2);
        return bytesOf(one);
      }));
  add("pixels-more", element(Pixels, [](Element one) {
        one.value += Bytes(100, 'x');
        return bytesOf(one);
      }));

  const Element sequence{0x00081140, "SQ", ""};
  const Bytes open = headOf(sequence, 0xFFFFFFFF) + little(0xE000FFFE, 4) + little(0xFFFFFFFF, 4);
  const Bytes close = little(0xE00DFFFE, 4) + little(0, 4) + little(0xE0DDFFFE, 4) + little(0, 4);
  add("sequences-10000-deep", beforePixels(repeated(open, 10000) + repeated(close, 10000)));
  add("sequences-10000-open", beforePixels(repeated(open, 10000)));
  add("sequence-of-100000", beforePixels(headOf(sequence, 0xFFFFFFFF) +
                                         repeated(little(0xE000FFFE, 4) + little(0, 4), 100000) +
                                         little(0xE0DDFFFE, 4) + little(0, 4)));
  add("item-too-long", beforePixels(headOf(sequence, 16) + little(0xE000FFFE, 4) +
                                    little(0xFFFFFFF0, 4) + Bytes(8, 'x')));
  add("group-length-lies", value(0x00020000, little(0xFFFFFFFF, 4)));
  add("without-preamble", [](const Bytes& sound) { return sound.substr(132); });
  add("header-only", [](const Bytes& sound) { return sound.substr(0, 132); });
  add("elements-turned", [](const Bytes& sound) {
    const std::vector<Element> elements = elementsOf(sound);
    return fileOf(sound, {elements.rbegin(), elements.rend()});
  });
}

/// Folders as wholes. `file` is a slice in them.
void damageFolders(Corpus& corpus, const Format& format, const fs::path& series) {
  std::vector<fs::path> slices;
  for (const auto& entry : fs::directory_iterator(series)) slices.push_back(entry.path());
  std::sort(slices.begin(), slices.end());
  Format alone = format;
  alone.beside.clear();
  const auto add = [&](const std::string& detail, Wanted wanted, const auto& write) {
    corpus.addWritten(alone, "series", detail, wanted, write);
  };
  add("of-one", Wanted::Anything,
      [slices](const fs::path& file) { fs::create_symlink(slices[0], file); });
  add("of-two", Wanted::Anything, [slices](const fs::path& file) {
    fs::create_symlink(slices[0], file);
    fs::create_symlink(slices[9], file.parent_path() / "other.dcm");
  });
  add("gap", Wanted::Anything, [slices](const fs::path& file) {
    fs::create_symlink(slices[0], file);
    for (std::size_t i = 1; i < slices.size(); ++i) {
      if (i < 9 || i > 14) fs::create_symlink(slices[i], file.parent_path() / slices[i].filename());
    }
  });
  add("all-twice", Wanted::Anything, [slices](const fs::path& file) {
    fs::create_symlink(slices[0], file);
    for (std::size_t i = 0; i < slices.size(); ++i) {
      fs::create_symlink(slices[i], file.parent_path() / slices[i].filename());
    }
  });
  add("the-same-30-times", Wanted::Anything, [slices](const fs::path& file) {
    fs::create_symlink(slices[0], file);
    for (int i = 0; i < 30; ++i) {
      fs::create_symlink(slices[0], file.parent_path() / (std::to_string(i) + ".dcm"));
    }
  });
  add("folder-in-itself", Wanted::Anything, [slices](const fs::path& file) {
    fs::create_directory_symlink(".", file.parent_path() / "again");
    for (const fs::path& slice : slices) {
      fs::create_symlink(slice, file.parent_path() / slice.filename());
    }
    fs::create_symlink(slices[0], file);
  });
}

}  // namespace

void damageDicom(Corpus& corpus, const Format& format, const fs::path& series) {
  damageElements(corpus, format);
  damageFolders(corpus, format, series);
}

}  // namespace pneuma::damaged
