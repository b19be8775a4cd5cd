#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "io/detail/fissure_formats.h"
#include "io/detail/text_fields.h"

namespace pneuma {
namespace {

constexpr std::string_view MarkupsSchema =
    "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/"
    "Schema/markups-schema-v1.0.3.json#";

/// Kinds of markups whose control points lie upon what they mark.
constexpr std::array<std::string_view, 4> PointKinds = {"Fiducial", "Line", "Curve", "ClosedCurve"};

struct Spelling {
  std::string_view text;
  Fissure fissure;
};

constexpr std::array<Spelling, 9> Spellings = {{
    {"right oblique", Fissure::RightOblique},
    {"right major", Fissure::RightOblique},
    {"ro", Fissure::RightOblique},
    {"right horizontal", Fissure::RightHorizontal},
    {"right minor", Fissure::RightHorizontal},
    {"rh", Fissure::RightHorizontal},
    {"left oblique", Fissure::LeftOblique},
    {"left major", Fissure::LeftOblique},
    {"lo", Fissure::LeftOblique},
}};

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw InvalidInput(quoted(path) + " " + what);
}

/// 1 or -1 for x and y, by what a file calls its frame: a name, or 3D Slicer's number for it.
double toLps(const std::filesystem::path& path, std::string_view space) {
  if (space == "LPS" || space == "1") return 1.0;
  if (space == "RAS" || space == "0") return -1.0;
  fail(path, "is in a frame \"" + std::string(space) + "\"; there are LPS (1) and RAS (0)");
}

/// The fissure by the first of the names that speaks of one.
Fissure fissureOf(const std::filesystem::path& path, const std::string& which,
                  const std::vector<std::string>& names) {
  std::string tried;
  for (const std::string& name : names) {
    if (const std::optional<Fissure> fissure = fissureOfLabel(name)) return *fissure;
    if (!name.empty()) tried += (tried.empty() ? "" : ", ") + ("\"" + escaped(name) + "\"");
  }
  fail(path, "does not say upon which fissure " + which + " lies (" +
                 (tried.empty() ? "it has no name" : "named " + tried) + "); " + labelAdvice());
}

class Markups {
 public:
  Markups(const std::filesystem::path& path, const Json& json) : path_(path), json_(json) {}

  GivenFissures read() {
    if (!json_.is_object() || !json_.contains("markups") || !json_["markups"].is_array()) {
      fail(path_, "has no array \"markups\", as markups of 3D Slicer have");
    }
    for (const Json& markup : json_["markups"]) {
      ++list_;
      readList(markup);
    }
    if (sets_.empty()) fail(path_, "holds no defined points of fissures");
    return std::move(sets_);
  }

 private:
  void readList(const Json& markup) {
    const std::string which = "list " + std::to_string(list_);
    if (!markup.is_object()) fail(path_, "has no object as " + which);
    const std::string kind = textIn(markup, "type", "Fiducial");
    if (std::ranges::find(PointKinds, kind) == PointKinds.end()) {
      fail(path_, "has a markup of type \"" + escaped(kind) + "\" as " + which +
                      "; points are taken from Fiducial, Line, Curve and ClosedCurve");
    }
    const std::string units = textIn(markup, "coordinateUnits", "mm");
    if (units != "mm") fail(path_, "is in \"" + escaped(units) + "\", not mm, in " + which);
    const double sign = toLps(path_, spaceOf(markup));
    if (!markup.contains("controlPoints") || !markup["controlPoints"].is_array()) {
      fail(path_, "has no array \"controlPoints\" in " + which);
    }
    std::size_t number = 0;
    for (const Json& point : markup["controlPoints"]) {
      readPoint(point, "point " + std::to_string(++number) + " of " + which,
                textIn(markup, "name", ""), sign);
    }
  }

  void readPoint(const Json& point, const std::string& which, const std::string& listName,
                 double sign) {
    if (!point.is_object()) fail(path_, "has no object as " + which);
    if (textIn(point, "positionStatus", "defined") != "defined") return;
    Vec3 place;
    const Json position = point.value("position", Json());
    const bool three = position.is_array() && position.size() == 3;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!three || !position[axis].is_number()) {
        fail(path_, "has no three numbers as position of " + which);
      }
      place[static_cast<Eigen::Index>(axis)] = position[axis].get<double>();
    }
    if (!place.allFinite()) fail(path_, "has no place as " + which);
    const Fissure fissure = fissureOf(path_, which, {textIn(point, "label", ""), listName, stem()});
    sets_[fissure].points.emplace_back(sign * place.x(), sign * place.y(), place.z());
  }

  /// 3D Slicer names files as the list when it leaves the name out.
  std::string stem() const { return path_.stem().stem().string(); }

  static std::string textIn(const Json& json, const char* key, const std::string& otherwise) {
    const Json value = json.value(key, Json(otherwise));
    return value.is_string() ? value.get<std::string>() : value.dump();
  }

  std::string spaceOf(const Json& markup) const {
    return textIn(markup, "coordinateSystem", "LPS");
  }

  const std::filesystem::path& path_;
  const Json& json_;
  GivenFissures sets_;
  std::size_t list_ = 0;
};

/// The fields of a line; one in quotation marks may have commas in it.
std::vector<std::string> fieldsOf(std::string_view line) {
  std::vector<std::string> fields(1);
  bool quotes = false;
  for (const char c : line) {
    if (c == '"') {
      quotes = !quotes;
    } else if (c == ',' && !quotes) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  for (std::string& field : fields) field = std::string(trimmed(field));
  return fields;
}

/// Where the columns stand that are read.
struct FcsvColumns {
  std::size_t x = 1;
  std::size_t y = 2;
  std::size_t z = 3;
  std::size_t label = 11;
  std::size_t count = 14;
};

FcsvColumns columnsOf(const std::filesystem::path& path, std::string_view list) {
  const std::vector<std::string> names = fieldsOf(list);
  const auto place = [&](std::string_view name) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) {
      fail(path, "has no column \"" + std::string(name) + "\" among its columns");
    }
    return static_cast<std::size_t>(found - names.begin());
  };
  return {place("x"), place("y"), place("z"), place("label"), names.size()};
}

/// "LPS" of "# CoordinateSystem = LPS", if the line is of that name.
std::optional<std::string_view> valueOf(std::string_view line, std::string_view name) {
  line = trimmed(line.substr(1));
  if (!line.starts_with(name)) return std::nullopt;
  line = trimmed(line.substr(name.size()));
  if (!line.starts_with('=')) return std::nullopt;
  return trimmed(line.substr(1));
}

}  // namespace

std::optional<Fissure> fissureOfLabel(std::string_view label) {
  std::string words;
  for (const char c : lowerCase(label)) {
    const bool separator = c == '-' || c == '_' || c == ' ';
    if (!separator) {
      words += c;
    } else if (!words.empty() && words.back() != ' ') {
      words += ' ';
    }
  }
  while (!words.empty() &&
         (words.back() == ' ' || std::isdigit(static_cast<unsigned char>(words.back())) != 0)) {
    words.pop_back();
  }
  constexpr std::string_view Kind = " fissure";
  if (words.ends_with(Kind)) words.resize(words.size() - Kind.size());
  const auto found = std::ranges::find(Spellings, words, &Spelling::text);
  if (found == Spellings.end()) return std::nullopt;
  return found->fissure;
}

std::string labelAdvice() {
  return "call points or their list right-oblique, right-horizontal or left-oblique (RO, RH, LO), "
         "with a number behind it or not";
}

bool isMarkups(const Json& json) {
  if (!json.is_object()) return false;
  const Json schema = json.value("@schema", Json());
  return schema.is_string() &&
         schema.get<std::string>().find("markups-schema") != std::string::npos;
}

GivenFissures fissuresOfMarkups(const std::filesystem::path& path, const Json& json) {
  return Markups(path, json).read();
}

std::string markupsText(const GivenFissures& fissures) {
  Json json = {{"@schema", MarkupsSchema}, {"markups", Json::array()}};
  for (const auto& [fissure, set] : fissures) {
    const std::string name(shortName(fissure));
    Json list = {{"type", "Fiducial"},        {"name", name},
                 {"coordinateSystem", "LPS"}, {"coordinateUnits", "mm"},
                 {"labelFormat", "%N-%d"},    {"controlPoints", Json::array()}};
    std::size_t number = 0;
    for (const Vec3& p : set.points) {
      const std::string id = std::to_string(++number);
      list["controlPoints"].push_back({{"id", id},
                                       {"label", name + "-" + id},
                                       {"position", {p.x(), p.y(), p.z()}},
                                       {"positionStatus", "defined"}});
    }
    json["markups"].push_back(std::move(list));
  }
  return json.dump(2) + "\n";
}

GivenFissures fissuresOfFcsv(const std::filesystem::path& path, const std::string& text) {
  Lines lines(text);
  FcsvColumns columns;
  std::optional<double> sign;
  GivenFissures sets;
  while (const auto line = lines.next()) {
    if (trimmed(*line).empty()) continue;
    if (line->front() == '#') {
      if (const auto space = valueOf(*line, "CoordinateSystem")) sign = toLps(path, *space);
      if (const auto names = valueOf(*line, "columns")) columns = columnsOf(path, *names);
      continue;
    }
    const std::string where = "line " + std::to_string(lines.number());
    if (!sign) {
      fail(path, "does not say its frame before " + where +
                     "; a line '# CoordinateSystem = LPS' or RAS is needed");
    }
    const std::vector<std::string> fields = fieldsOf(*line);
    if (fields.size() < columns.count) {
      fail(path, "has " + std::to_string(fields.size()) + " fields in " + where + ", not " +
                     std::to_string(columns.count));
    }
    // 3D Slicer 5 adds two fields that its list of columns does not name: the first is 2 for a
    // point that has a place.
    if (fields.size() > columns.count && fields[columns.count] != "2") continue;
    const auto number = [&](std::size_t column) {
      const std::optional<double> value = parseDouble(fields[column]);
      if (value && std::isfinite(*value)) return *value;
      fail(path, "has no number in " + where + ": '" + fields[column] + "'");
    };
    const Fissure fissure =
        fissureOf(path, "the point in " + where, {fields[columns.label], path.stem().string()});
    sets[fissure].points.emplace_back(*sign * number(columns.x), *sign * number(columns.y),
                                      number(columns.z));
  }
  if (sets.empty()) fail(path, "holds no points of fissures");
  return sets;
}

std::string fcsvText(const GivenFissures& fissures) {
  std::string text =
      "# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n"
      "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n";
  std::size_t id = 0;
  for (const auto& [fissure, set] : fissures) {
    std::size_t number = 0;
    for (const Vec3& p : set.points) {
      text += std::to_string(++id);
      for (const double coordinate : p) {
        text += ',';
        appendNumber(text, coordinate);
      }
      text += ",0,0,0,1,1,1,0," + std::string(shortName(fissure)) + "-" + std::to_string(++number) +
              ",,\n";
    }
  }
  return text;
}

}  // namespace pneuma
