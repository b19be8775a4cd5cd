#include <limits>

#include "bytes.h"

/// STL, OBJ and PLY.
namespace pneuma::damaged {
namespace {

constexpr std::size_t FirstFacet = 84;
constexpr std::size_t FacetSize = 50;

/// What is said of a number of things: as text.
const std::pair<const char*, const char*> Counts[] = {{"0", "0"},
                                                      {"minus-one", "-1"},
                                                      {"two-to-31", "2147483648"},
                                                      {"two-to-32", "4294967295"},
                                                      {"1e18", "1000000000000000000"},
                                                      {"two-to-64", "18446744073709551615"},
                                                      {"word", "many"},
                                                      {"missing", ""}};

/// Each x of the OBJ's points times `factor`.
Bytes scaled(const Bytes& obj, double factor) {
  Bytes result;
  std::size_t at = 0;
  while (at < obj.size()) {
    const std::size_t end = std::min(obj.find('\n', at), obj.size());
    const std::string line = obj.substr(at, end - at);
    at = end + 1;
    if (line.rfind("v ", 0) != 0) {
      result += line + "\n";
      continue;
    }
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    if (std::sscanf(line.c_str(), "v %lf %lf %lf", &x, &y, &z) != 3) continue;
    result += "v " + std::to_string(x * factor) + " " + std::to_string(y * factor) + " " +
              std::to_string(z * factor) + "\n";
  }
  return result;
}

}  // namespace

void damageStl(Corpus& corpus, const Format& format) {
  const auto facets = littleAt(*format.sound, 80, 4);
  for (const std::uint64_t count : {std::uint64_t{0}, facets - 1, facets + 1,
                                    std::uint64_t{0x80000000}, std::uint64_t{0xFFFFFFFF}}) {
    corpus.add(format, "stl", "facets-" + std::to_string(count),
               [count](const Bytes& stl) { return overwritten(stl, 80, little(count, 4)); });
  }
  const auto value = [&](const std::string& detail, float number, std::size_t facet) {
    corpus.add(format, "stl", detail, [=](const Bytes& stl) {
      return overwritten(stl, FirstFacet + facet * FacetSize + 12, floatBytes(number));
    });
  };
  value("nan", std::numeric_limits<float>::quiet_NaN(), 3);
  value("infinite", std::numeric_limits<float>::infinity(), 4);
  value("1e38", 1e38F, 5);
  value("1e9", 1e9F, 6);
  corpus.add(
      format, "stl", "header-only", [](const Bytes& stl) { return stl.substr(0, 84); },
      Wanted::Refused);
  corpus.add(format, "stl", "one-facet", [](const Bytes& stl) {
    return overwritten(stl.substr(0, FirstFacet + FacetSize), 80, little(1, 4));
  });
  corpus.add(format, "stl", "all-the-same-facet", [](Bytes stl) {
    const Bytes facet = stl.substr(FirstFacet, FacetSize);
    for (std::size_t at = FirstFacet; at + FacetSize <= stl.size(); at += FacetSize) {
      stl.replace(at, FacetSize, facet);
    }
    return stl;
  });
  corpus.add(format, "stl", "one-point", [](Bytes stl) {
    for (std::size_t at = FirstFacet; at + FacetSize <= stl.size(); at += FacetSize) {
      stl.replace(at + 12, 36, Bytes(36, '\0'));
    }
    return stl;
  });
  corpus.add(format, "stl", "hole", [facets](const Bytes& stl) {
    return overwritten(stl.substr(0, FirstFacet + (facets - 40) * FacetSize), 80,
                       little(facets - 40, 4));
  });
  corpus.add(format, "stl", "begins-with-solid",
             [](const Bytes& stl) { return overwritten(stl, 0, "solid x\n"); });
}

void damageObj(Corpus& corpus, const Format& format) {
  const auto behind = [&](const std::string& detail, const Bytes& text) {
    corpus.add(format, "obj", detail, [text](const Bytes& obj) { return obj + text; });
  };
  behind("index-too-large", "f 1 2 99999999\n");
  behind("index-0", "f 0 1 2\n");
  behind("index-negative", "f -1 -2 -99999999\n");
  behind("index-1e18", "f 1 2 1000000000000000000\n");
  behind("index-beyond-64-bits", "f 1 2 99999999999999999999999\n");
  behind("index-broken", "f 1/ /2 3//\n");
  behind("two-corners", "f 1 2\n");
  behind("same-corner", "f 1 1 1\n");
  behind("corners-100000", "f" + repeated(" 1 2", 50000) + "\n");
  behind("texture-missing", "f 1/77 2/78 3/79\n");
  behind("library-elsewhere", "mtllib ../../../../etc/passwd\nusemtl x\n");
  behind("point-of-two", "v 1 2\n");
  behind("point-nan", "v nan nan nan\nf 1 2 -1\n");
  behind("nul", Bytes("v 1 2 3\0 4\n", 11));
  behind("goes-on", "f 1 2 \\\n");
  corpus.add(format, "obj", "metres", [](const Bytes& obj) { return scaled(obj, 1e-3); });
  corpus.add(format, "obj", "tiny", [](const Bytes& obj) { return scaled(obj, 1e-6); });
  corpus.add(format, "obj", "a-million-times", [](const Bytes& obj) { return scaled(obj, 1e6); });
  corpus.add(format, "obj", "1e120-times", [](const Bytes& obj) { return scaled(obj, 1e120); });
  corpus.add(format, "obj", "flat", [](const Bytes& obj) { return scaled(obj, 0.0); });
}

void damagePly(Corpus& corpus, const Format& format) {
  const auto line = [&](const std::string& detail, const std::string& prefix,
                        const std::string& text) {
    corpus.add(format, "ply", detail,
               [=](const Bytes& ply) { return withLine(ply, prefix, text); });
  };
  for (const auto& [name, count] : Counts) {
    line(std::string("points-") + name, "element vertex", std::string("element vertex ") + count);
    line(std::string("faces-") + name, "element face", std::string("element face ") + count);
  }
  line("format-unknown", "format ", "format binary_middle_endian 1.0");
  line("format-missing", "format ", "");
  line("big-endian", "format ", "format binary_big_endian 1.0");
  line("as-text", "format ", "format ascii 1.0");
  line("version-9", "format ", "format binary_little_endian 9.0");
  line("no-points", "element vertex", "");
  line("no-faces", "element face", "");
  line("no-x", "property double x", "property double w");
  line("x-twice", "property double y", "property double x");
  line("x-as-list", "property double x", "property list uchar double x");
  line("x-of-unknown-type", "property double x", "property quadruple x");
  line("corners-counted-by-int", "property list", "property list int int vertex_indices");
  line("corners-counted-by-double", "property list", "property list double int vertex_indices");
  line("corners-as-chars", "property list", "property list uchar char vertex_indices");
  line("corners-no-list", "property list", "property int vertex_indices");
  line("header-open", "end_header", "");
  line("header-only-comment", "end_header", "comment end");
  corpus.add(format, "ply", "elements-10000", [](const Bytes& ply) {
    return replaced(ply, "element face", repeated("element other 0\n", 10000) + "element face");
  });
  corpus.add(
      format, "ply", "header-only",
      [](const Bytes& ply) { return ply.substr(0, ply.find("end_header\n") + 11); },
      Wanted::Refused);
  if (format.sound->find("binary") == Bytes::npos) return;
  // A face is its number of corners, one byte, and three times 4 bytes.
  for (const int corners : {0, 1, 2, 4, 255}) {
    corpus.add(format, "ply", "face-of-" + std::to_string(corners), [corners](const Bytes& ply) {
      return overwritten(ply, ply.size() - 13, little(static_cast<unsigned>(corners), 1));
    });
  }
  for (const std::uint32_t index : {0x7FFFFFFFU, 0xFFFFFFFFU, 0x80000000U}) {
    corpus.add(format, "ply", "index-" + std::to_string(index), [index](const Bytes& ply) {
      return overwritten(ply, ply.size() - 4, little(index, 4));
    });
  }
}

}  // namespace pneuma::damaged
