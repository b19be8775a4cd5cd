#include "cli/region_arguments.h"

#include <memory>

#include "geometry/surface_domain.h"

namespace pneuma::cli {

void addRegionArguments(CLI::App& app, RegionArguments& arguments) {
  app.add_option("--domain", arguments.domain,
                 "The lobes' surfaces, or a folder of them: gives homogeneity and counts what "
                 "leaves its lobe.")
      ->type_name("FILE");
  app.add_option("--organ", arguments.organ, "A built-in organ instead of surfaces.")
      ->type_name(choiceType(organNames()));
  addFields(app, arguments.organOptions);
  addFields(app, arguments);
}

void requireOneRegion(const RegionArguments& arguments, const std::string& command) {
  if (!arguments.domain.empty() && !arguments.organ.empty()) {
    throw InvalidOption(command + " takes --domain or --organ, not both");
  }
  if (arguments.organ.empty() && arguments.organOptions.sizeMl > 0.0) {
    throw InvalidOption("--organ-size is for a built-in organ; name one with --organ");
  }
}

Json parametersOf(const RegionArguments& arguments) {
  Json parameters = Json::object();
  if (!arguments.organ.empty()) {
    parameters["organ"] = arguments.organ;
    parameters.update(toJson(arguments.organOptions));
  }
  return parameters;
}

LungModel opened(const RegionArguments& arguments, const Progress& progress) {
  if (!arguments.organ.empty()) return openOrgan(arguments.organ, arguments.organOptions);
  if (arguments.domain.empty()) return {};
  LungModel model = openLobes(arguments.domain, progress);
  auto regions = std::make_shared<std::vector<LobeRegion>>();
  for (const LobeSurface& surface : *model.surfaces) {
    requireOrganSize(surface);
    if (!surface.health.fitToGrow()) {
      throw InvalidInput("'" + surface.name +
                         "' is not fit to measure in: " + complaints(surface.health).front());
    }
    regions->push_back({surface.lobe, std::make_shared<SurfaceDomain>(*surface.mesh)});
  }
  model.regions = std::move(regions);
  return model;
}

}  // namespace pneuma::cli
