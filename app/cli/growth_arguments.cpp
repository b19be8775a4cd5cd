#include "cli/growth_arguments.h"

namespace pneuma::cli {

void addShortcut(CLI::App& app, GrowthArguments& arguments, const std::string& name,
                 const std::string& help) {
  app.add_option_function<std::string>(
         "--" + name,
         [&arguments, name](const std::string& text) {
           arguments.shortcuts.push_back(name + "=" + text);
         },
         help)
      ->type_name("N");
}

void addGrowthArguments(CLI::App& app, GrowthArguments& arguments) {
  addFiles(app, "LOBES", arguments.lobes,
           "Closed surfaces whose names carry rul, rml, rll, lul, lll; a folder of them; or one "
           "surface of any name.");
  app.add_option("--organ", arguments.organ, "A built-in organ instead of surfaces.")
      ->type_name(choiceType(organNames()));
  addFields(app, arguments.organOptions);
  app.add_option("--airway-table", arguments.organOptions.airwayTable,
                 "Central airways of a built-in organ from a table of angles and lengths (JSON).")
      ->type_name("FILE");
  app.add_option("--central", arguments.central,
                 "Central airways (VTP, VTU, SWC, CSV, JSON); without it a template is used.")
      ->type_name("FILE");
  std::vector<std::string_view> methods;
  for (const GrowthMethod& method : growthMethods()) methods.push_back(method.name);
  app.add_option("--method", arguments.method, "How to grow.")
      ->type_name(choiceType(methods))
      ->default_str(arguments.method);
  addRepeatable(app, "--set", arguments.assignments, "KEY=VALUE",
                "Set an option of the method (list below). May be repeated.");
  addShortcut(app, arguments, "terminals", "Aim at about this many terminals.");
  addRepeatable(app, "--vary", arguments.variation, "KEY=VALUE",
                "Vary the trunk or the organ at random (list below). May be repeated.");
}

std::string growthOptionsHelp() {
  std::string text;
  for (const GrowthMethod& method : growthMethods()) {
    text += "Options of --method " + std::string(method.name) + " (" + std::string(method.title) +
            "; " + std::string(method.citation) + "), for --set:\n" +
            std::visit([](const auto& options) { return fieldsHelp(options); }, method.defaults);
  }
  return text + "Standard deviations, for --vary:\n" + fieldsHelp(VariationOptions{});
}

void requireOneOrgan(const GrowthArguments& arguments, const std::string& command) {
  const OrganOptions& organ = arguments.organOptions;
  if (arguments.organ.empty() && (organ.sizeMl > 0.0 || !organ.airwayTable.empty())) {
    throw InvalidOption(std::string(organ.sizeMl > 0.0 ? "--organ-size" : "--airway-table") +
                        " is for a built-in organ; name one with --organ");
  }
  if (!arguments.central.empty() && !organ.airwayTable.empty()) {
    throw InvalidOption(command + " takes --central or --airway-table, not both");
  }
  if (arguments.lobes.empty() != arguments.organ.empty()) return;
  throw InvalidOption(command + (arguments.lobes.empty()
                                     ? " needs lobe surfaces, a folder of them, or --organ NAME"
                                     : " takes lobe surfaces or --organ, not both"));
}

GrowthOptions growthOptions(const GrowthArguments& arguments) {
  GrowthOptions options = growthMethod(arguments.method).defaults;
  std::visit(
      [&](auto& chosen) {
        for (const std::string& text : arguments.assignments) setFromAssignment(chosen, text);
        for (const std::string& text : arguments.shortcuts) setFromAssignment(chosen, text);
        requireValid(chosen);
      },
      options);
  return options;
}

VariationOptions variationOptions(const GrowthArguments& arguments) {
  VariationOptions options;
  for (const std::string& text : arguments.variation) setFromAssignment(options, text, "--vary");
  return options;
}

LungModel opened(const GrowthArguments& arguments, const Progress& progress) {
  LungModel model = arguments.organ.empty() ? openLobes(arguments.lobes, progress)
                                            : openOrgan(arguments.organ, arguments.organOptions);
  return arguments.central.empty() ? model : withCentral(model, arguments.central);
}

}  // namespace pneuma::cli
