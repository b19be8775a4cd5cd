#include "bytes.h"

/// JSON and XML.
namespace pneuma::damaged {
namespace {

struct Named {
  std::string name;
  std::string text;
};

/// Where the keys of a JSON text stand, without their quotation marks.
std::vector<Span> keysIn(const Bytes& json) {
  std::vector<Span> keys;
  for (std::size_t colon = json.find("\":"); colon != Bytes::npos;
       colon = json.find("\":", colon + 1)) {
    const std::size_t open = json.rfind('"', colon - 1);
    if (open != Bytes::npos) keys.push_back({open + 1, colon - open - 1});
  }
  return keys;
}

void set(Corpus& corpus, const Format& format, const std::string& kind, const Named& change,
         Span span) {
  corpus.add(format, kind, change.name, [span, text = change.text](Bytes bytes) {
    return bytes.replace(span.at, span.size, text);
  });
}

const Bytes LaughsDoctype = [] {
  Bytes text = "<!DOCTYPE lolz [<!ENTITY a0 \"lollollollollol\">";
  for (int i = 1; i < 12; ++i) {
    const std::string mention = "&a" + std::to_string(i - 1) + ";";
    text += "<!ENTITY a" + std::to_string(i) + " \"" + repeated(mention, 10) + "\">";
  }
  return text + "]>\n";
}();

/// The value of the XML attribute that stands first behind `from`.
Change attribute(const std::string& name, const std::string& value, const std::string& from = "") {
  return [=](const Bytes& xml) {
    const std::size_t begin = from.empty() ? 0 : xml.find(from);
    if (begin == Bytes::npos) return xml;
    const std::string key = name + "=\"";
    const std::size_t at = xml.find(key, begin);
    if (at == Bytes::npos) return xml;
    const std::size_t end = xml.find('"', at + key.size());
    Bytes changed = xml;
    return changed.replace(at + key.size(), end - at - key.size(), value);
  };
}

/// Writes into an appended array, behind the 8 bytes of its size.
Change appended(const std::string& array, std::size_t at, const Bytes& part) {
  return [=](const Bytes& xml) {
    const std::size_t place = xml.find("Name=\"" + array + "\"");
    const std::size_t data = xml.find("<AppendedData");
    if (place == Bytes::npos || data == Bytes::npos) return xml;
    const std::size_t key = xml.find("offset=\"", place);
    if (key > data) return xml;
    const std::size_t offset = std::stoul(xml.substr(key + 8, 20));
    return overwritten(xml, xml.find('_', data) + 1 + offset + at, part);
  };
}

void damageAppended(Corpus& corpus, const Format& format) {
  const auto add = [&](const std::string& detail, const std::string& array, std::size_t at,
                       const Bytes& part) {
    corpus.add(format, "appended", detail, appended(array, at, part));
  };
  for (const char* array : {"Points", "connectivity", "offsets"}) {
    const std::string name = array;
    add(name + "-size-0", name, 0, little(0, 8));
    add(name + "-size-2-to-63", name, 0, little(std::uint64_t{1} << 63, 8));
    add(name + "-size-all", name, 0, little(~std::uint64_t{0}, 8));
    add(name + "-size-odd", name, 0, little(23, 8));
  }
  add("nan", "Points", 8, little(0x7FF8000000000000U, 8));
  add("infinite", "Points", 16, little(0x7FF0000000000000U, 8));
  add("1e300", "Points", 24, little(0x7E37E43C8800759CU, 8));
  add("index-too-large", "connectivity", 8, little(1000000000, 8));
  add("index-negative", "connectivity", 16, little(~std::uint64_t{0}, 8));
  add("offset-0", "offsets", 8, little(0, 8));
  add("offset-huge", "offsets", 8, little(std::uint64_t{1} << 62, 8));
  add("offset-falls", "offsets", 24, little(1, 8));
}

}  // namespace

void damageJson(Corpus& corpus, const Format& format) {
  const Bytes& json = *format.sound;
  const auto whole = [&](const std::string& detail, const Bytes& text) {
    corpus.add(
        format, "json", detail, [text](const Bytes&) { return text; }, Wanted::Refused);
  };
  whole("number", "3");
  whole("null", "null");
  whole("list", "[]");
  whole("nothing-in-it", "{}");
  whole("lists-10000-deep", repeated("[", 10000) + repeated("]", 10000));
  whole("lists-1000000-deep", repeated("[", 1000000));
  whole("objects-10000-deep", repeated("{\"a\":", 10000) + "1" + repeated("}", 10000));

  const std::vector<Span> keys = keysIn(json);
  for (std::size_t i = 0; i < keys.size() && i < 8; ++i) {
    const std::string key = json.substr(keys[i].at, keys[i].size);
    set(corpus, format, "json", {"without-" + std::to_string(i) + "-" + key, "gone"}, keys[i]);
  }
  const std::size_t first = json.find('{') + 1;
  for (const Named& change :
       {Named{"doubled-schema", "\"schema\": \"other/9\","}, Named{"trailing-comma", ",,"},
        Named{"comment", "/* a comment */"}, Named{"long-key", "\"" + Bytes(200000, 'k') + "\":1,"},
        Named{"unknown-deep", "\"x\":" + repeated("[", 9000) + repeated("]", 9000) + ","}}) {
    set(corpus, format, "json", change, {first, 0});
  }
  corpus.add(
      format, "json", "more-behind", [](const Bytes& text) { return text + "{}"; },
      Wanted::Refused);
  corpus.add(format, "json", "byte-order-mark",
             [](const Bytes& text) { return "\xEF\xBB\xBF" + text; });

  const std::vector<Span> numbers = numbersIn(json);
  if (numbers.empty()) return;
  const Span last = numbers.back();
  for (const Named& change : {Named{"text", "\"text\""}, Named{"null", "null"}, Named{"list", "[]"},
                              Named{"object", "{}"}, Named{"true", "true"}, Named{"1e999", "1e999"},
                              Named{"huge-text", "\"" + Bytes(1000000, 's') + "\""},
                              Named{"deep", repeated("[", 10000) + repeated("]", 10000)}}) {
    set(corpus, format, "json", {"first-is-" + change.name, change.text}, numbers.front());
    set(corpus, format, "json", {"last-is-" + change.name, change.text}, last);
  }
  const std::size_t text = json.find(": \"");
  if (text == Bytes::npos) return;
  const std::size_t at = text + 3;
  const Span value{at, json.find('"', at) - at};
  for (const Named& change :
       {Named{"nul", "a\\u0000b"}, Named{"no-utf8", "\xC3\x28"}, Named{"surrogate", "\\ud800"},
        Named{"huge", Bytes(1000000, 's')}, Named{"empty", ""}, Named{"up", "../../../etc"}}) {
    set(corpus, format, "json", {"text-" + change.name, change.text}, value);
  }
}

void damageXml(Corpus& corpus, const Format& format) {
  const auto add = [&](const std::string& detail, Change change) {
    corpus.add(format, "xml", detail, std::move(change));
  };
  const auto before = [](const std::string& mark, const Bytes& text) {
    return [=](const Bytes& xml) { return replaced(xml, mark, text + mark); };
  };
  add("billion-laughs",
      [](const Bytes& xml) { return LaughsDoctype + replaced(xml, "<Piece", "&a11;<Piece"); });
  add("billion-laughs-in-attribute",
      [](const Bytes& xml) { return LaughsDoctype + attribute("Name", "&a11;")(xml); });
  add("external-entity", [](const Bytes& xml) {
    return "<!DOCTYPE x [<!ENTITY e SYSTEM \"file:///dev/zero\">]>\n" +
           replaced(xml, "<Piece", "&e;<Piece");
  });
  add("elements-10000-deep", before("<Piece", repeated("<a>", 10000) + repeated("</a>", 10000)));
  add("elements-10000-open", before("<Piece", repeated("<a>", 10000)));
  add("attribute-2-mb", before("<Piece", "<a b=\"" + Bytes(2000000, 'x') + "\"/>"));
  add("comment-open", before("<Piece", "<!-- "));
  add("no-end", [](const Bytes& xml) { return replaced(xml, "</VTKFile>", ""); });
  add("no-points", [](const Bytes& xml) { return replaced(xml, "<Points>", "<Other>"); });
  add("other-kind", attribute("type", "ImageData"));
  add("unknown-kind", attribute("type", "Nonsense"));
  add("type-doubled", before(" type=", " type=\"PolyData\""));
  for (const auto& [name, value] : nastyNumbers()) {
    add("points-" + name, attribute("NumberOfPoints", value));
    const bool hasLines = format.sound->find("NumberOfLines") != Bytes::npos;
    add("cells-" + name, [hasLines, value = value](const Bytes& xml) {
      const bool areLines = hasLines && xml.find("NumberOfLines=\"0\"") == Bytes::npos;
      const bool isGrid = xml.find("NumberOfCells") != Bytes::npos;
      return attribute(isGrid     ? "NumberOfCells"
                       : areLines ? "NumberOfLines"
                                  : "NumberOfPolys",
                       value)(xml);
    });
    add("components-" + name, attribute("NumberOfComponents", value, "<Points>"));
  }
  for (const char* value : {"1000000000000", "-8", "18446744073709551615", "x"}) {
    add(std::string("offset-") + value, attribute("offset", value, "<Points>"));
  }
  for (const char* type : {"Int8", "String", "Bit", "Nonsense"}) {
    add(std::string("points-as-") + type, attribute("type", type, "<Points>"));
  }
  add("cells-as-floats", attribute("type", "Float32", "\"connectivity\""));
  add("points-as-text", attribute("format", "ascii", "<Points>"));
  add("points-as-nonsense", attribute("format", "nonsense", "<Points>"));
  add("header-of-32-bits", attribute("header_type", "UInt32"));
  add("big-endian", attribute("byte_order", "BigEndian"));
  add("encoding-base64", attribute("encoding", "base64"));
  for (const char* name : {"vtkZLibDataCompressor", "vtkLZMADataCompressor", "vtkNonsense"}) {
    add(std::string("claims-") + name,
        before(" byte_order", std::string(" compressor=\"") + name + "\""));
  }
  damageAppended(corpus, format);
}

}  // namespace pneuma::damaged
