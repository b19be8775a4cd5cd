#include "pipeline/recipe.h"

#include <algorithm>

#include "core/error.h"
#include "io/atomic_file.h"

namespace pneuma {
namespace {

constexpr std::string_view Schema = "pneuma/recipe/1";
constexpr std::array<std::string_view, 3> TreeFormats = {"swc", "csv", "json"};
constexpr std::size_t MostBytes = std::size_t{1} << 20;

/// Complaints name the file and the place in it.
class RecipeReader {
 public:
  explicit RecipeReader(const std::filesystem::path& path) : path_(path) {}

  Recipe read() {
    Json json;
    try {
      json = Json::parse(readFile(path_, MostBytes));
    } catch (const Json::parse_error& error) {
      fail("is no JSON near byte " + std::to_string(error.byte));
    } catch (const Json::out_of_range&) {
      fail("holds a number that is too large");
    }
    if (!json.is_object()) fail("is no recipe: its outermost value is no object");
    if (!json.contains("schema") || json.at("schema") != Schema) {
      fail("is no recipe: its \"schema\" should be \"" + std::string(Schema) + "\"");
    }
    Recipe recipe;
    recipe.split = json.contains("lobes");
    recipe.grow = json.contains("airways");
    for (const auto& [stage, options] : json.items()) {
      if (stage == "schema") continue;
      if (stage == "breathing") {
        throw Unsupported("'" + path_.string() + "' asks for the stage \"" + stage +
                          "\", which this version does not have; remove it");
      }
      if (!options.is_object()) fail("has no object under \"" + stage + "\"");
      try {
        readStage(stage, options, recipe);
      } catch (const InvalidOption& error) {
        throw InvalidOption("'" + path_.string() + "': " + error.what());
      }
    }
    return recipe;
  }

 private:
  void readStage(const std::string& stage, const Json& options, Recipe& recipe) const {
    if (stage == "open") {
      readOpen(options, recipe);
    } else if (stage == "lungs") {
      readLungs(options, recipe);
    } else if (stage == "lobes") {
      readLobes(options, recipe.lobes);
    } else if (stage == "airways") {
      readAirways(options, recipe);
    } else if (stage == "export") {
      readExport(options, recipe);
    } else {
      unknown(stage, "stage", {"open", "lungs", "lobes", "airways", "export"});
    }
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InvalidInput("'" + path_.string() + "' " + what);
  }

  [[noreturn]] void unknown(const std::string& word, const std::string& kind,
                            const std::vector<std::string_view>& words) const {
    const std::string_view nearest = nearestWord(word, words);
    fail("has an unknown " + kind + " \"" + word + "\"" +
         (nearest.empty() ? "" : "; did you mean \"" + std::string(nearest) + "\"?"));
  }

  std::string text(const Json& value, const std::string& where) const {
    if (!value.is_string()) fail("should have a text under \"" + where + "\"");
    return value.get<std::string>();
  }

  /// Sets a field of an options struct if it has one of this name.
  template <HasFields Options>
  bool set(Options& options, const std::string& key, const Json& value) const {
    bool known = false;
    bool isFlag = false;  // choices such as off and on are none
    forEachField<Options>([&](const auto& field) {
      if (field.name != key) return;
      known = true;
      isFlag = std::is_same_v<typename std::remove_cvref_t<decltype(field)>::value_type, bool>;
    });
    if (!known) return false;
    if (value.is_structured() || value.is_null()) {
      fail("should have a number or a text under \"" + key + "\"");
    }
    setOption(options, key,
              value.is_string() ? value.get<std::string>()
              : value.is_boolean()
                  ? std::string(value.get<bool>() ? (isFlag ? "1" : "on") : (isFlag ? "0" : "off"))
                  : value.dump());
    return true;
  }

  template <HasFields Options>
  static void addNames(std::vector<std::string_view>& names) {
    forEachField<Options>([&](const auto& field) { names.push_back(field.name); });
  }

  std::filesystem::path besideRecipe(const std::filesystem::path& path) const {
    return path.is_absolute() ? path : path_.parent_path() / path;
  }

  void readOpen(const Json& options, Recipe& recipe) const {
    for (const auto& [key, value] : options.items()) {
      if (key == "ct") {
        recipe.ct = besideRecipe(text(value, "ct"));
      } else if (key == "series") {
        recipe.series.wanted = value.is_number_unsigned() ? value.dump() : text(value, "series");
      } else if (!set(recipe.corrections, key, value)) {
        std::vector<std::string_view> names = {"ct", "series"};
        addNames<CtCorrections>(names);
        unknown(key, "key under \"open\":", names);
      }
    }
  }

  void readLungs(const Json& options, Recipe& recipe) const {
    for (const auto& [key, value] : options.items()) {
      if (key == "edits") {
        recipe.lungEdits = besideRecipe(text(value, "edits"));
        continue;
      }
      if (set(recipe.lungs, key, value) || set(recipe.surfaces, key, value)) continue;
      std::vector<std::string_view> names = {"edits"};
      addNames<LungOptions>(names);
      addNames<SurfaceOptions>(names);
      unknown(key, "key under \"lungs\":", names);
    }
  }

  void readLobes(const Json& options, LobesRecipe& lobes) const {
    for (const auto& [key, value] : options.items()) {
      if (key == "fissures") {
        lobes.fissures = besideRecipe(text(value, "fissures"));
      } else if (key == "fractions") {
        lobes.fractions = text(value, "fractions");
      } else if (key == "snap") {
        if (!value.is_boolean()) fail("should have true or false under \"snap\"");
        lobes.snap = value.get<bool>();
      } else if (!set(lobes.options, key, value) && !set(lobes.snapOptions, key, value)) {
        std::vector<std::string_view> names = {"fissures", "fractions", "snap"};
        addNames<LobeOptions>(names);
        addNames<SnapOptions>(names);
        unknown(key, "key under \"lobes\":", names);
      }
    }
    if (lobes.snap && !lobes.fractions.empty()) {
      fail(
          "has both \"fractions\" and \"snap\" under \"lobes\": the one would move the fissures "
          "off what the other finds; leave one");
    }
  }

  void readAirways(const Json& options, Recipe& recipe) const {
    if (options.contains("method")) {
      recipe.growth = growthMethod(text(options.at("method"), "method")).defaults;
    }
    std::visit(
        [&](auto& chosen) {
          using Options = std::remove_cvref_t<decltype(chosen)>;
          for (const auto& [key, value] : options.items()) {
            if (key == "method" || set(chosen, key, value)) continue;
            std::vector<std::string_view> names = {"method"};
            addNames<Options>(names);
            unknown(key, "key under \"airways\":", names);
          }
          requireValid(chosen);
        },
        recipe.growth);
  }

  void readExport(const Json& options, Recipe& recipe) const {
    for (const auto& [key, value] : options.items()) {
      if (key != "tree") unknown(key, "key under \"export\":", {"tree"});
      if (!value.is_array()) fail("should have a list of formats under \"tree\"");
      for (const Json& format : value) {
        const std::string name = text(format, "tree");
        if (std::find(TreeFormats.begin(), TreeFormats.end(), name) == TreeFormats.end()) {
          unknown(name, "format of trees", {TreeFormats.begin(), TreeFormats.end()});
        }
        recipe.formats.push_back(name);
      }
    }
  }

  std::filesystem::path path_;
};

}  // namespace

Recipe readRecipe(const std::filesystem::path& path) { return RecipeReader(path).read(); }

Json toJson(const Recipe& recipe) {
  Json json = {{"schema", Schema}};
  json["open"] = {{"ct", recipe.ct.string()}};
  if (!recipe.series.wanted.empty()) json["open"]["series"] = keptSeries(recipe.series.wanted);
  json["open"].update(toJson(recipe.corrections));
  json["lungs"] = toJson(recipe.lungs);
  json["lungs"].update(toJson(recipe.surfaces));
  if (!recipe.lungEdits.empty()) json["lungs"]["edits"] = recipe.lungEdits.string();
  if (recipe.split) {
    json["lobes"] = {{"snap", recipe.lobes.snap}};
    if (!recipe.lobes.fissures.empty()) {
      json["lobes"]["fissures"] = recipe.lobes.fissures.string();
    }
    if (!recipe.lobes.fractions.empty()) json["lobes"]["fractions"] = recipe.lobes.fractions;
    json["lobes"].update(toJson(recipe.lobes.options));
    json["lobes"].update(toJson(recipe.lobes.snapOptions));
  }
  if (recipe.grow) {
    json["airways"] = {{"method", growthMethod(recipe.growth).name}};
    json["airways"].update(
        std::visit([](const auto& options) { return toJson(options); }, recipe.growth));
  }
  json["export"] = {{"tree", recipe.formats}};
  return json;
}

}  // namespace pneuma
