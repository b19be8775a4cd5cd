#include "pipeline/recipe_arguments.h"

#include <type_traits>

namespace pneuma {
namespace {

using Arguments = std::vector<std::string>;

/// The options of a struct that differ from its defaults.
template <HasFields Options>
void add(Arguments& arguments, const Options& chosen, const Options& defaults = {},
         const std::string& before = "--") {
  forEachField<Options>([&](const auto& field) {
    using Value = typename std::remove_cvref_t<decltype(field)>::value_type;
    if (chosen.*(field.member) == defaults.*(field.member)) return;
    const std::string name = before + std::string(field.name);
    if constexpr (std::is_same_v<Value, bool>) {
      arguments.push_back(name);
    } else {
      arguments.push_back(name + "=" + textOf(chosen.*(field.member)));
    }
  });
}

std::string pathOption(const std::string& name, const std::filesystem::path& path) {
  return "--" + name + "=" + std::filesystem::absolute(path).string();
}

void addSeries(Arguments& arguments, const Recipe& recipe) {
  const std::string series = keptSeries(recipe.series.wanted);
  if (!series.empty()) arguments.push_back("--series=" + series);
}

}  // namespace

std::vector<std::string> infoArguments(const Recipe& recipe) {
  Arguments arguments;
  addSeries(arguments, recipe);
  if (recipe.corrections.resampleMm > 0.0) {
    arguments.push_back("--resample=" + textOf(recipe.corrections.resampleMm));
  }
  return arguments;
}

std::vector<std::string> importArguments(const Recipe& recipe) {
  Arguments arguments;
  addSeries(arguments, recipe);
  add(arguments, recipe.corrections);
  return arguments;
}

std::vector<std::string> segmentArguments(const Recipe& recipe) {
  Arguments arguments;
  add(arguments, recipe.lungs);
  add(arguments, recipe.surfaces);
  if (!recipe.lungEdits.empty()) arguments.push_back(pathOption("edits", recipe.lungEdits));
  return arguments;
}

std::vector<std::string> lobesArguments(const Recipe& recipe) {
  Arguments arguments;
  const LobesRecipe& lobes = recipe.lobes;
  if (!lobes.fissures.empty()) arguments.push_back(pathOption("fissures", lobes.fissures));
  if (!lobes.fractions.empty()) arguments.push_back("--fractions=" + lobes.fractions);
  if (lobes.snap) arguments.emplace_back("--snap");
  add(arguments, lobes.options);
  if (lobes.snap) add(arguments, lobes.snapOptions);
  return arguments;
}

std::vector<std::string> growArguments(const GrowthOptions& options) {
  Arguments arguments;
  std::visit(
      [&](const auto& chosen) {
        using Options = std::remove_cvref_t<decltype(chosen)>;
        add(arguments, chosen, std::get<Options>(growthMethods()[options.index()].defaults),
            "--set=");
      },
      options);
  return arguments;
}

}  // namespace pneuma
