#include "io/airway_table.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "anatomy/segment.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/detail/built_in_tables.h"
#include "io/json.h"

namespace pneuma {
namespace {

constexpr std::string_view Schema = "pneuma/airway-table/1";
constexpr std::string_view See = "; compare with docs/airway-table.md";

struct Limits {
  double low;
  double high;
};

constexpr Limits PositionMm = {-10000.0, 10000.0};
constexpr Limits VectorPart = {-1e6, 1e6};
constexpr Limits DiameterMm = {0.1, 100.0};
constexpr Limits LengthMm = {0.1, 1000.0};
constexpr Limits AzimuthDeg = {-360.0, 360.0};
constexpr Limits AngleDeg = {0.0, 120.0};
constexpr Limits LengthToDiameter = {0.1, 20.0};

std::string inQuotes(const std::string& text) { return "'" + text + "'"; }

/// One JSON object of the table with the words that say where it stands.
class Entry {
 public:
  Entry(const Json& json, std::string where) : json_(json), where_(std::move(where)) {
    if (!json_.is_object()) throw InvalidInput(where_ + " is no object" + std::string(See));
  }

  const std::string& where() const { return where_; }

  std::string text(const char* key) const {
    const Json& value = member(key);
    if (!value.is_string() || value.get_ref<const std::string&>().empty()) {
      throw wrong(key, "must be a name, not " + value.dump());
    }
    return value.get<std::string>();
  }

  double number(const char* key, Limits limits) const { return numberOf(member(key), key, limits); }

  Vec3 vector(const char* key, Limits limits) const {
    const Json& value = member(key);
    if (!value.is_array() || value.size() != 3) {
      throw wrong(key, "must be a list of three numbers, not " + value.dump());
    }
    Vec3 result;
    for (int i = 0; i < 3; ++i)
      result[i] = numberOf(value[static_cast<std::size_t>(i)], key, limits);
    return result;
  }

  Vec3 directionOf(const char* key) const {
    const Vec3 v = vector(key, VectorPart);
    if (!(v.norm() > 1e-9)) throw wrong(key, "has no length");
    return v;
  }

  Entry part(const char* key) const { return {member(key), where_ + ", \"" + key + "\""}; }

  const Json& list(const char* key) const {
    const Json& value = member(key);
    if (!value.is_array()) throw wrong(key, "must be a list");
    return value;
  }

 private:
  const Json& member(const char* key) const {
    const auto found = json_.find(key);
    if (found == json_.end()) {
      throw InvalidInput(where_ + " has no \"" + key + "\"" + std::string(See));
    }
    return *found;
  }

  InvalidInput wrong(const char* key, const std::string& what) const {
    return InvalidInput(where_ + ": \"" + key + "\" " + what + std::string(See));
  }

  double numberOf(const Json& value, const char* key, Limits limits) const {
    if (!value.is_number()) throw wrong(key, "must be a number, not " + value.dump());
    const double number = value.get<double>();
    if (!(number >= limits.low && number <= limits.high)) {
      throw wrong(key, "must lie in [" + textOf(limits.low) + ", " + textOf(limits.high) +
                           "], not " + value.dump());
    }
    return number;
  }

  const Json& json_;
  std::string where_;
};

PredefinedDaughter daughterOf(const Entry& entry) {
  return {entry.text("name"), entry.number("angle_deg", AngleDeg),
          entry.number("length_to_diameter", LengthToDiameter)};
}

PredefinedBifurcation bifurcationOf(const Entry& entry) {
  PredefinedBifurcation bifurcation;
  bifurcation.parent = entry.text("parent");
  bifurcation.a = daughterOf(entry.part("a"));
  bifurcation.b = daughterOf(entry.part("b"));
  bifurcation.hint = entry.directionOf("hint");
  bifurcation.azimuthDeg = entry.number("azimuth_deg", AzimuthDeg);
  return bifurcation;
}

using Bifurcations = std::vector<PredefinedBifurcation>;

/// The names of all daughters. @throws InvalidInput if an airway is named or divided twice
std::set<std::string> daughterNames(const PredefinedAirways& table, const std::string& name) {
  std::set<std::string> daughters;
  std::set<std::string> parents;
  for (const PredefinedBifurcation& bifurcation : table.bifurcations) {
    if (!parents.insert(bifurcation.parent).second) {
      throw InvalidInput(name + ": the airway " + inQuotes(bifurcation.parent) +
                         " is divided twice; give one bifurcation for each parent");
    }
    for (const PredefinedDaughter* daughter : {&bifurcation.a, &bifurcation.b}) {
      if (daughter->name == table.root || !daughters.insert(daughter->name).second) {
        throw InvalidInput(name + ": two airways are called " + inQuotes(daughter->name) +
                           "; every airway needs a name of its own");
      }
    }
  }
  return daughters;
}

/// The same bifurcations, parents first, else in their order.
Bifurcations parentsFirst(const PredefinedAirways& table, const std::set<std::string>& daughters,
                          const std::string& name) {
  Bifurcations left = table.bifurcations;
  Bifurcations ordered;
  std::set<std::string> known = {table.root};
  while (!left.empty()) {
    const auto next = std::ranges::find_if(
        left, [&](const PredefinedBifurcation& b) { return known.contains(b.parent); });
    if (next == left.end()) {
      const auto unknown = std::ranges::find_if(
          left, [&](const PredefinedBifurcation& b) { return !daughters.contains(b.parent); });
      if (unknown == left.end()) {
        throw InvalidInput(name + ": the airway " + inQuotes(left.front().parent) +
                           " descends from itself; every airway must lead back to " +
                           inQuotes(table.root));
      }
      throw InvalidInput(name + ": no airway is called " + inQuotes(unknown->parent) +
                         ", the parent of " + inQuotes(unknown->a.name) + " and " +
                         inQuotes(unknown->b.name) + "; airways begin at " + inQuotes(table.root));
    }
    known.insert({next->a.name, next->b.name});
    ordered.push_back(std::move(*next));
    left.erase(next);
  }
  return ordered;
}

/// @throws InvalidInput if an airway that is not divided is none of the 18 segments
void requireSegmentsAtTheEnds(const PredefinedAirways& table,
                              const std::set<std::string>& daughters, const std::string& name) {
  std::set<std::string> ends = daughters;
  for (const PredefinedBifurcation& bifurcation : table.bifurcations)
    ends.erase(bifurcation.parent);
  for (const std::string& end : ends) {
    if (segmentOfName(end).has_value()) continue;
    throw InvalidInput(name + ": the airway " + inQuotes(end) +
                       " is not divided, but no segment is called so; segments are RB1 to RB10, "
                       "LB1+2, LB3, LB4, LB5, LB6, LB8, LB9 and LB10");
  }
}

Json jsonOf(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json jsonOf(const PredefinedDaughter& daughter) {
  return {{"name", daughter.name},
          {"angle_deg", daughter.angleDeg},
          {"length_to_diameter", daughter.lengthToDiameter}};
}

}  // namespace

PredefinedAirways airwayTableOf(std::string_view text, const std::string& name) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::exception& error) {
    throw InvalidInput(name + " is no JSON, or damaged: " + error.what());
  }
  const Entry whole(json, name);
  if (whole.text("schema") != Schema || whole.text("frame") != "LPS") {
    throw InvalidInput(name + " is no table of airways: its \"schema\" must be \"" +
                       std::string(Schema) + "\" and its \"frame\" \"LPS\"" + std::string(See));
  }
  PredefinedAirways table;
  const Entry root = whole.part("root");
  table.root = root.text("name");
  table.start = root.vector("start_mm", PositionMm);
  table.direction = root.directionOf("direction").normalized();
  table.diameterMm = root.number("diameter_mm", DiameterMm);
  table.lengthMm = root.number("length_mm", LengthMm);
  for (const Json& entry : whole.list("bifurcations")) {
    table.bifurcations.push_back(bifurcationOf(
        Entry(entry, name + ", bifurcation " + std::to_string(table.bifurcations.size() + 1))));
  }
  if (table.bifurcations.empty()) throw InvalidInput(name + " has no bifurcation");
  const std::set<std::string> daughters = daughterNames(table, name);
  table.bifurcations = parentsFirst(table, daughters, name);
  requireSegmentsAtTheEnds(table, daughters, name);
  return table;
}

PredefinedAirways readAirwayTable(const std::filesystem::path& path) {
  constexpr std::size_t Limit = std::size_t{1} << 20;
  return airwayTableOf(readFile(path, Limit), inQuotes(path.string()));
}

std::string airwayTableText(const PredefinedAirways& table) {
  Json json = {{"schema", Schema}, {"frame", "LPS"}};
  json["root"] = {{"name", table.root},
                  {"start_mm", jsonOf(table.start)},
                  {"direction", jsonOf(table.direction)},
                  {"diameter_mm", table.diameterMm},
                  {"length_mm", table.lengthMm}};
  json["bifurcations"] = Json::array();
  for (const PredefinedBifurcation& bifurcation : table.bifurcations) {
    json["bifurcations"].push_back({{"parent", bifurcation.parent},
                                    {"hint", jsonOf(bifurcation.hint)},
                                    {"azimuth_deg", bifurcation.azimuthDeg},
                                    {"a", jsonOf(bifurcation.a)},
                                    {"b", jsonOf(bifurcation.b)}});
  }
  return json.dump(2) + "\n";
}

PredefinedAirways thoraxAirways() {
  return airwayTableOf(detail::ThoraxAirwayTable, "the table of the thorax");
}

}  // namespace pneuma
