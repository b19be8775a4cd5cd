#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "core/units.h"
#include "io/detail/fissure_formats.h"
#include "io/detail/text_fields.h"
#include "io/surface_file.h"

namespace pneuma {
namespace {

constexpr std::string_view Schema = "pneuma/fissures/1";

/// Keys of an equation's coefficients, in their order.
constexpr std::array<const char*, 6> Terms = {"1", "x", "y", "xx", "xy", "yy"};

/// What a fissure may be given by.
constexpr std::array<const char*, 4> Ways = {"points", "plane", "equation", "surface"};

constexpr double LeastSine = 1e-3;  ///< of the angle between handles, else they lie on a line

Json numbers(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

class JsonFissures {
 public:
  explicit JsonFissures(const std::filesystem::path& path) : path_(path) {}

  FissureFile read(const Json& json) const {
    if (!json.is_object() || json.value("schema", Json()) != Schema) {
      fail("holds no fissures: its \"schema\" should be \"" + std::string(Schema) + "\"");
    }
    if (json.value("space", Json("LPS")) != "LPS") fail("is not in the frame LPS");
    const Json fissures = json.value("fissures", Json());
    FissureFile file;
    readAccessory(file, json.value("accessory", Json::array()));
    const bool may = fissures.is_null() && !file.accessory.empty();
    if (!may && (!fissures.is_object() || fissures.empty())) {
      fail("has no object under \"fissures\"");
    }
    for (const auto& [name, entry] : fissures.items()) {
      const std::optional<Fissure> fissure = fissureOfShortName(name);
      if (!fissure) {
        fail("names a fissure \"" + name +
             "\"; there are right-oblique, right-horizontal and left-oblique");
      }
      file.fissures[*fissure] = given(name, entry);
    }
    return file;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InvalidInput(quoted(path_) + " " + what);
  }

  void readAccessory(FissureFile& file, const Json& list) const {
    if (!list.is_array()) fail("has no array as \"accessory\"");
    for (const Json& entry : list) {
      const std::string which = "accessory fissure " + std::to_string(file.accessory.size() + 1);
      if (!entry.is_object()) fail("has no object as " + which);
      const Json name = entry.value("name", Json());
      AccessoryFissure accessory;
      if (name.is_string()) accessory.name = name.get<std::string>();
      const bool other = std::ranges::none_of(file.accessory, [&](const AccessoryFissure& before) {
        return before.name == accessory.name;
      });
      if (!isFileName(accessory.name) || fissureOfShortName(accessory.name) || !other) {
        fail("has no name of its own as \"name\" of " + which +
             "; small letters, digits and dashes may be in it");
      }
      const Json lobe = entry.value("lobe", Json());
      const std::optional<Lobe> named =
          lobe.is_string() ? lobeOfShortName(lobe.get<std::string>()) : std::nullopt;
      if (!named || std::ranges::find(FiveLobes, *named) == FiveLobes.end()) {
        fail("names no lobe as \"lobe\" of \"" + accessory.name +
             "\"; there are rul, rml, rll, lul and lll");
      }
      accessory.lobe = *named;
      accessory.fissure = given(accessory.name, entry);
      file.accessory.push_back(std::move(accessory));
    }
  }

  /// Also on systems that tell no capitals from small letters.
  static bool isFileName(const std::string& name) {
    constexpr std::string_view Allowed = "abcdefghijklmnopqrstuvwxyz0123456789-";
    return !name.empty() && name.size() <= 64 &&
           name.find_first_not_of(Allowed) == std::string::npos;
  }

  GivenFissure given(const std::string& name, const Json& entry) const {
    if (!entry.is_object()) fail("has no object under \"" + name + "\"");
    const auto ways = std::ranges::count_if(Ways, [&](auto* way) { return entry.contains(way); });
    if (ways > 1) {
      fail("gives \"" + name + "\" in two ways; take one of points, plane, equation and surface");
    }
    GivenFissure set;
    if (entry.contains("plane")) {
      set.plane = plane(name, entry["plane"]);
    } else if (entry.contains("equation")) {
      set.equation = equation(name, entry["equation"]);
    } else if (entry.contains("surface")) {
      set.patch = patch(name, entry["surface"]);
    } else {
      readPoints(set, name, entry);
    }
    return set;
  }

  Vec3 place(const Json& numbers, const std::string& which) const {
    if (!numbers.is_array() || numbers.size() != 3) fail("has no three numbers as " + which);
    Vec3 place;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!numbers[axis].is_number()) fail("has no three numbers as " + which);
      place[static_cast<Eigen::Index>(axis)] = numbers[axis].get<double>();
    }
    if (!place.allFinite()) fail("has no place as " + which);
    return place;
  }

  FissurePlane plane(const std::string& name, const Json& entry) const {
    const std::string of = " of the plane of \"" + name + "\"";
    if (entry.is_object() && entry.contains("handles")) return throughHandles(of, entry["handles"]);
    const bool angles = entry.is_object() && entry.contains("tilt_deg");
    if (!entry.is_object() || !entry.contains("point") || (!angles && !entry.contains("normal"))) {
      fail(
          "has neither \"point\" and \"normal\", nor \"point\" and \"tilt_deg\", nor \"handles\" "
          "under the plane of \"" +
          name + "\"");
    }
    FissurePlane plane{place(entry["point"], "point" + of), Vec3::Zero()};
    if (angles) {
      plane.normal = planeNormal(angle(entry, "tilt_deg", of), angle(entry, "turn_deg", of));
    } else {
      plane.normal = place(entry["normal"], "normal" + of);
    }
    if (!(plane.normal.norm() > 0.0)) fail("has a normal without length for \"" + name + "\"");
    return plane;
  }

  FissurePlane throughHandles(const std::string& of, const Json& handles) const {
    if (!handles.is_array() || handles.size() != 3) {
      fail("has no three handles" + of + ": three places of three numbers are needed");
    }
    std::array<Vec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = place(handles[i], "handle " + std::to_string(i + 1) + of);
    }
    const Vec3 a = corners[1] - corners[0];
    const Vec3 b = corners[2] - corners[0];
    const double longest = std::max({a.norm(), b.norm(), (b - a).norm()});
    const Vec3 normal = a.cross(b);
    if (!(normal.norm() > LeastSine * longest * longest)) {
      fail("has handles" + of + " that lie on one line; move one beside it");
    }
    return {(corners[0] + corners[1] + corners[2]) / 3.0, normal.normalized()};
  }

  double angle(const Json& entry, const char* key, const std::string& of) const {
    const Json value = entry.value(key, Json(0.0));
    if (!value.is_number() || !(std::abs(value.get<double>()) <= 90.0)) {
      fail("has no angle from -90 to 90 as " + std::string(key) + of);
    }
    return radians(value.get<double>());
  }

  FissureEquation equation(const std::string& name, const Json& entry) const {
    const std::string of = " of the equation of \"" + name + "\"";
    if (!entry.is_object()) fail("has no object as equation of \"" + name + "\"");
    FissureEquation equation;
    bool any = false;
    for (const auto& [key, value] : entry.items()) {
      if (key == "origin") {
        equation.origin = place(value, "origin" + of);
        continue;
      }
      const auto term = std::ranges::find(Terms, key);
      if (term == Terms.end()) {
        fail("has a term \"" + key + "\"" + of + "; there are 1, x, y, xx, xy, yy, and origin");
      }
      if (!value.is_number() || !std::isfinite(value.get<double>())) {
        fail("has no number as term \"" + key + "\"" + of);
      }
      equation.coefficients[static_cast<std::size_t>(term - Terms.begin())] = value.get<double>();
      any = true;
    }
    if (!any) fail("has no term" + of + "; there are 1, x, y, xx, xy, yy");
    return equation;
  }

  FissurePatch patch(const std::string& name, const Json& file) const {
    if (!file.is_string()) fail("has no file's name as surface of \"" + name + "\"");
    return readFissurePatch(path_.parent_path() / file.get<std::string>());
  }

  void readPoints(GivenFissure& set, const std::string& name, const Json& entry) const {
    if (!entry.contains("points") || !entry["points"].is_array()) {
      fail("has no array \"points\", nor a plane, an equation or a surface, under \"" + name +
           "\"");
    }
    for (const Json& point : entry["points"]) {
      const std::string which =
          "point " + std::to_string(set.points.size() + 1) + " of \"" + name + "\"";
      set.points.push_back(place(point, which));
    }
    if (!entry.contains("weights")) return;
    if (!entry["weights"].is_array() || entry["weights"].size() != set.points.size()) {
      fail("has other than one weight for each point of \"" + name + "\"");
    }
    for (const Json& weight : entry["weights"]) {
      if (!weight.is_number() || !(weight.get<double>() > 0.0)) {
        fail("has a weight of \"" + name + "\" that is no positive number");
      }
      set.weights.push_back(weight.get<double>());
    }
  }

  const std::filesystem::path& path_;
};

Json toJson(const GivenFissure& set, const std::filesystem::path& folder) {
  if (set.plane) {
    return {
        {"plane", {{"point", numbers(set.plane->point)}, {"normal", numbers(set.plane->normal)}}}};
  }
  if (set.equation) {
    Json equation = {{"origin", numbers(set.equation->origin)}};
    for (std::size_t i = 0; i < Terms.size(); ++i) {
      equation[Terms[i]] = set.equation->coefficients[i];
    }
    return {{"equation", std::move(equation)}};
  }
  if (set.patch) {
    std::error_code unknown;
    const std::filesystem::path from = folder.empty() ? "." : folder;
    const std::filesystem::path file = std::filesystem::proximate(set.patch->file, from, unknown);
    return {{"surface", (unknown ? set.patch->file : file).generic_string()}};
  }
  Json entry = {{"points", Json::array()}};
  for (const Vec3& p : set.points) entry["points"].push_back(numbers(p));
  if (!set.weights.empty()) entry["weights"] = set.weights;
  return entry;
}

}  // namespace

FissureFile fissuresOfJson(const std::filesystem::path& path, const Json& json) {
  return JsonFissures(path).read(json);
}

std::string fissureJsonText(const FissureFile& file, const std::filesystem::path& folder) {
  Json json = {{"schema", Schema}, {"space", "LPS"}, {"units", "mm"}, {"fissures", Json::object()}};
  for (const auto& [fissure, set] : file.fissures) {
    json["fissures"][std::string(shortName(fissure))] = toJson(set, folder);
  }
  if (file.fissures.empty()) json.erase("fissures");
  for (const AccessoryFissure& accessory : file.accessory) {
    Json entry = {{"name", accessory.name}, {"lobe", shortName(accessory.lobe)}};
    entry.update(toJson(accessory.fissure, folder));
    json["accessory"].push_back(std::move(entry));
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace pneuma
