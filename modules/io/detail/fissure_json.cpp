#include "core/error.h"
#include "io/detail/fissure_formats.h"
#include "io/detail/text_fields.h"

namespace pneuma {
namespace {

constexpr std::string_view Schema = "pneuma/fissures/1";

class JsonFissures {
 public:
  explicit JsonFissures(const std::filesystem::path& path) : path_(path) {}

  GivenFissures read(const Json& json) const {
    if (!json.is_object() || json.value("schema", Json()) != Schema) {
      fail("holds no fissures: its \"schema\" should be \"" + std::string(Schema) + "\"");
    }
    if (json.value("space", Json("LPS")) != "LPS") fail("is not in the frame LPS");
    const Json fissures = json.value("fissures", Json());
    if (!fissures.is_object() || fissures.empty()) fail("has no object under \"fissures\"");
    GivenFissures sets;
    for (const auto& [name, entry] : fissures.items()) {
      const std::optional<Fissure> fissure = fissureOfShortName(name);
      if (!fissure) {
        fail("names a fissure \"" + name +
             "\"; there are right-oblique, right-horizontal and left-oblique");
      }
      if (!entry.is_object()) fail("has no object under \"" + name + "\"");
      sets[*fissure] = entry.contains("plane") ? plane(name, entry["plane"]) : points(name, entry);
    }
    return sets;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InvalidInput(quoted(path_) + " " + what);
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

  GivenFissure plane(const std::string& name, const Json& entry) const {
    if (!entry.is_object() || !entry.contains("point") || !entry.contains("normal")) {
      fail("has no \"point\" and \"normal\" under the plane of \"" + name + "\"");
    }
    FissurePlane plane{place(entry["point"], "point of the plane of \"" + name + "\""),
                       place(entry["normal"], "normal of the plane of \"" + name + "\"")};
    if (!(plane.normal.norm() > 0.0)) fail("has a normal without length for \"" + name + "\"");
    return {{}, {}, plane};
  }

  GivenFissure points(const std::string& name, const Json& entry) const {
    if (!entry.contains("points") || !entry["points"].is_array()) {
      fail("has no array \"points\" under \"" + name + "\"");
    }
    GivenFissure set;
    for (const Json& point : entry["points"]) {
      const std::string which =
          "point " + std::to_string(set.points.size() + 1) + " of \"" + name + "\"";
      set.points.push_back(place(point, which));
    }
    if (!entry.contains("weights")) return set;
    if (!entry["weights"].is_array() || entry["weights"].size() != set.points.size()) {
      fail("has other than one weight for each point of \"" + name + "\"");
    }
    for (const Json& weight : entry["weights"]) {
      if (!weight.is_number() || !(weight.get<double>() > 0.0)) {
        fail("has a weight of \"" + name + "\" that is no positive number");
      }
      set.weights.push_back(weight.get<double>());
    }
    return set;
  }

  const std::filesystem::path& path_;
};

}  // namespace

GivenFissures fissuresOfJson(const std::filesystem::path& path, const Json& json) {
  return JsonFissures(path).read(json);
}

std::string fissureJsonText(const GivenFissures& fissures) {
  Json json = {{"schema", Schema}, {"space", "LPS"}, {"units", "mm"}, {"fissures", Json::object()}};
  for (const auto& [fissure, set] : fissures) {
    Json& entry = json["fissures"][std::string(shortName(fissure))];
    if (set.plane) {
      const auto& [point, normal] = *set.plane;
      entry["plane"] = {{"point", {point.x(), point.y(), point.z()}},
                        {"normal", {normal.x(), normal.y(), normal.z()}}};
      continue;
    }
    entry["points"] = Json::array();
    for (const Vec3& p : set.points) entry["points"].push_back({p.x(), p.y(), p.z()});
    if (!set.weights.empty()) entry["weights"] = set.weights;
  }
  return json.dump(2) + "\n";
}

}  // namespace pneuma
