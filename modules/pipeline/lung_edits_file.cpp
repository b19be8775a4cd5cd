#include "pipeline/lung_edits_file.h"

#include <cmath>

#include "core/error.h"
#include "core/options.h"
#include "io/atomic_file.h"
#include "io/json.h"

namespace pneuma {
namespace {

constexpr std::string_view LungEditsSchema = "pneuma/lung-edits/1";
constexpr std::size_t MostEditBytes = std::size_t{256} << 20;

/// Complaints name the file and the edit.
class LungEditsReader {
 public:
  explicit LungEditsReader(const std::filesystem::path& path) : path_(path) {}

  std::vector<LungEdit> read() {
    Json json;
    try {
      json = Json::parse(readFile(path_, MostEditBytes));
    } catch (const Json::parse_error& error) {
      fail("is no JSON near byte " + std::to_string(error.byte));
    } catch (const Json::out_of_range&) {
      fail("holds a number that is too large");
    }
    if (!json.is_object() || json.value("schema", Json()) != LungEditsSchema) {
      fail("holds no corrections of lungs: its \"schema\" should be \"" +
           std::string(LungEditsSchema) + "\"");
    }
    if (json.value("space", Json("LPS")) != "LPS") fail("is not in the frame LPS");
    const Json list = json.value("edits", Json());
    if (!list.is_array()) fail("has no list under \"edits\"");
    std::vector<LungEdit> edits;
    for (const Json& entry : list) {
      at_ = edits.size() + 1;
      edits.push_back(edit(entry));
    }
    return edits;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InvalidInput("'" + path_.string() + "' " + what +
                       (at_ > 0 ? " in edit " + std::to_string(at_) : std::string()));
  }

  LungEdit edit(const Json& entry) const {
    if (!entry.is_object()) fail("has no object");
    LungEdit edit;
    if (!entry.contains("tool")) fail("does not say the \"tool\": paint, erase or seed");
    if (!entry.contains("points")) fail("has no \"points\"");
    for (const auto& [key, value] : entry.items()) {
      if (key == "tool") {
        edit.tool = word(value, key, LungTool{});
      } else if (key == "lung") {
        edit.side = lung(value);
      } else if (key == "shape") {
        edit.shape = word(value, key, BrushShape{});
      } else if (key == "radius_mm") {
        edit.radiusMm = number(value, key);
        if (!(edit.radiusMm >= LeastBrushMm && edit.radiusMm <= MostBrushMm)) {
          fail("has a \"radius_mm\" that is not from 0.5 to 100");
        }
      } else if (key == "below_hu") {
        edit.belowHu = number(value, key);
      } else if (key == "points") {
        edit.points = points(value);
      } else {
        const std::string_view nearest =
            nearestWord(key, {"tool", "lung", "shape", "radius_mm", "below_hu", "points"});
        fail("has an unknown key \"" + key + "\"" +
             (nearest.empty() ? "" : " (did you mean \"" + std::string(nearest) + "\"?)"));
      }
    }
    if (edit.points.empty()) fail("has no \"points\"");
    if (edit.tool == LungTool::Seed && edit.points.size() > 1) {
      fail("has more than one point for a seed");
    }
    if (edit.tool != LungTool::Erase && edit.side == Side::None) {
      fail("does not say which \"lung\": right or left");
    }
    return edit;
  }

  template <class Enum>
  Enum word(const Json& value, const std::string& key, Enum) const {
    const auto names = choices(Enum{});
    std::string list;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (value == names[i]) return static_cast<Enum>(i);
      list += (i == 0 ? "" : i + 1 < names.size() ? ", " : " or ") + std::string(names[i]);
    }
    fail("has an unknown \"" + key + "\", which is " + list + ", not " + value.dump());
  }

  Side lung(const Json& value) const {
    if (value == "right") return Side::Right;
    if (value == "left") return Side::Left;
    fail("has an unknown \"lung\", which is right or left, not " + value.dump());
  }

  double number(const Json& value, const std::string& key) const {
    if (!value.is_number() || !std::isfinite(value.get<double>())) {
      fail("has no number under \"" + key + "\"");
    }
    return value.get<double>();
  }

  std::vector<Vec3> points(const Json& list) const {
    if (!list.is_array()) fail("has no list under \"points\"");
    std::vector<Vec3> points;
    for (const Json& place : list) {
      if (!place.is_array() || place.size() != 3) {
        fail("has a point that is no list of three numbers");
      }
      points.emplace_back(number(place[0], "points"), number(place[1], "points"),
                          number(place[2], "points"));
    }
    return points;
  }

  std::filesystem::path path_;
  std::size_t at_ = 0;  ///< the edit that is read; 0: none yet
};

Json jsonOfEdit(const LungEdit& edit) {
  Json json = {{"tool", textOf(edit.tool)}};
  if (edit.side != Side::None) json["lung"] = name(edit.side);
  if (edit.tool != LungTool::Seed) {
    json["shape"] = textOf(edit.shape);
    json["radius_mm"] = edit.radiusMm;
  }
  if (edit.belowHu) json["below_hu"] = *edit.belowHu;
  json["points"] = Json::array();
  for (const Vec3& p : edit.points) json["points"].push_back({p.x(), p.y(), p.z()});
  return json;
}

}  // namespace

std::vector<LungEdit> readLungEdits(const std::filesystem::path& path) {
  return LungEditsReader(path).read();
}

void requireWithin(std::span<const LungEdit> edits, const ImageGeometry& geometry,
                   const std::filesystem::path& file) {
  for (std::size_t i = 0; i < edits.size(); ++i) {
    const std::string problem = problemOf(edits[i], geometry);
    if (problem.empty()) continue;
    throw InvalidInput("edit " + std::to_string(i + 1) + " of '" + file.string() + "' " + problem);
  }
}

LungModel withLungEdits(const LungModel& model, std::span<const LungEdit> edits,
                        const std::filesystem::path& file, double thresholdHu,
                        const Progress& progress) {
  try {
    return withLungEdits(model, edits, thresholdHu, progress);
  } catch (const InvalidInput& error) {
    throw InvalidInput("'" + file.string() + "': " + error.what());
  }
}

std::string lungEditsText(std::span<const LungEdit> edits) {
  // One edit a line: strokes are long lists.
  std::string text = "{\n  \"schema\": \"" + std::string(LungEditsSchema) +
                     "\",\n  \"space\": \"LPS\",\n  \"units\": \"mm\",\n  \"edits\": [";
  for (std::size_t i = 0; i < edits.size(); ++i) {
    text += (i == 0 ? "\n    " : ",\n    ") + jsonOfEdit(edits[i]).dump();
  }
  return text + "\n  ]\n}\n";
}

}  // namespace pneuma
