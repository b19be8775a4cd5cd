#include "pipeline/organs.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "anatomy/organ.h"
#include "anatomy/right_lung.h"
#include "anatomy/thorax.h"
#include "core/error.h"
#include "core/units.h"
#include "growth/predefined_growth.h"
#include "io/airway_table.h"
#include "io/atomic_file.h"
#include "pipeline/domain_surface.h"

namespace pneuma {
namespace {

constexpr std::array<std::string_view, 6> Names = {"right-lung", "simple", "sphere",
                                                   "cylinder",   "cube",   "thorax"};

/// The table for an organ whose lengths are `scale` times those it was made for.
PredefinedAirways scaled(PredefinedAirways table, double scale) {
  table.start *= scale;
  table.diameterMm *= scale;
  table.lengthMm *= scale;
  return table;
}

LungModel modelOf(std::vector<LobeRegion> regions, AirwayTree central) {
  LungModel model;
  model.regions = std::make_shared<const std::vector<LobeRegion>>(std::move(regions));
  model.central = std::make_shared<const AirwayTree>(std::move(central));
  return model;
}

/// One region with the airways of a table that was made for it at `ownMl`.
LungModel modelOf(LobeRegion region, const PredefinedAirways& table, double ownMl) {
  const double scale = std::cbrt(millilitres(region.domain->volumeMm3()) / ownMl);
  AirwayTree central = growPredefined(scaled(table, scale), region, kitaokaPaper());
  return modelOf({std::move(region)}, std::move(central));
}

LungModel rightLungModel(const OrganOptions& options) {
  if (!options.airwayTable.empty()) {
    throw InvalidOption(
        "the organ right-lung has three lobes and takes no table of airways; use one with simple, "
        "sphere, cylinder, cube or thorax");
  }
  RightLung lung = options.sizeMl > 0.0 ? rightLung(options.sizeMl) : rightLung();
  return modelOf(std::move(lung.lobes), std::move(lung.central));
}

LungModel thoraxModel(const OrganOptions& options) {
  LungModel model =
      modelOf(thoraxRegion(options.sizeMl > 0.0 ? options.sizeMl : Thorax::VolumeMl),
              options.airwayTable.empty() ? thoraxAirways() : readAirwayTable(options.airwayTable),
              Thorax::VolumeMl);
  model.cubes = thoraxCubes();
  return model;
}

Organ shapeOf(std::string_view name, double volumeMl) {
  if (name == "sphere") return sphereOrgan(volumeMl);
  if (name == "cylinder") return cylinderOrgan(volumeMl);
  if (name == "cube") return cubeOrgan(volumeMl);
  return simpleOrgan(volumeMl);
}

LungModel shapeModel(std::string_view name, const OrganOptions& options) {
  Organ organ = shapeOf(name, options.sizeMl > 0.0 ? options.sizeMl : SimpleOrgan::VolumeMl);
  if (options.airwayTable.empty()) return modelOf({organ.region}, std::move(organ.central));
  return modelOf(organ.region, readAirwayTable(options.airwayTable), SimpleOrgan::VolumeMl);
}

}  // namespace

std::span<const std::string_view> organNames() { return Names; }

LungModel openOrgan(std::string_view name, const OrganOptions& options) {
  if (std::ranges::find(Names, name) == Names.end()) {
    detail::throwUnknownChoice("the organ", name, {Names.begin(), Names.end()});
  }
  requireValid(options);
  LungModel model = name == "right-lung" ? rightLungModel(options)
                    : name == "thorax"   ? thoraxModel(options)
                                         : shapeModel(name, options);
  if (!options.airwayTable.empty()) {
    model.inputs.push_back({options.airwayTable.string(), sha256(readFile(options.airwayTable))});
  }
  if (options.airwayTable.empty() && options.sizeMl == 0.0) model.organ = name;
  return model;
}

std::shared_ptr<const std::vector<LobeSurface>> surfacesOf(const std::vector<LobeRegion>& regions,
                                                           double cellMm) {
  auto surfaces = std::make_shared<std::vector<LobeSurface>>();
  for (const LobeRegion& region : regions) {
    LobeSurface surface;
    surface.lobe = region.lobe;
    surface.name = shortName(region.lobe);
    surface.mesh = std::make_shared<const TriangleMesh>(surfaceOf(*region.domain, cellMm));
    surface.health = examine(*surface.mesh, SelfIntersections::Skip);
    surfaces->push_back(std::move(surface));
  }
  return surfaces;
}

}  // namespace pneuma
