#include "pipeline/lobes_model.h"

#include <algorithm>
#include <utility>

#include "core/error.h"

namespace pneuma {
namespace {

bool isWholeLung(const LobeSurface& surface) {
  return surface.lobe == Lobe::RightLung || surface.lobe == Lobe::LeftLung;
}

}  // namespace

std::shared_ptr<const std::vector<LobeSurface>> wholeLungsOf(const LungModel& model) {
  if (model.wholeLungs) return model.wholeLungs;
  const bool whole = model.surfaces && std::ranges::any_of(*model.surfaces, isWholeLung);
  return whole ? model.surfaces : nullptr;
}

LungModel withLobes(const LungModel& model, const LobeInputs& inputs, const LobeOptions& options,
                    const Progress& progress) {
  LungModel result = model;
  result.wholeLungs = wholeLungsOf(model);
  if (!result.wholeLungs) {
    throw InvalidInput("there is no whole lung to split; open a CT, or surfaces of whole lungs");
  }
  LungModel whole = model;
  whole.surfaces = result.wholeLungs;
  auto lobes = std::make_shared<LobesOfLungs>(
      splitLobes(whole, inputs, options, progress.part(0.0, 0.9, "splitting lungs")));
  auto surfaces = std::make_shared<std::vector<LobeSurface>>();
  for (const SplitLung& lung : lobes->lungs) {
    for (const Lobe lobe : lobesOf(lung.side)) {
      TriangleMesh mesh = surfaceOf(lung.complex, static_cast<RegionId>(lobe)).mesh;
      LobeSurface surface;
      surface.lobe = lobe;
      surface.name = std::string(shortName(lobe));
      surface.health = examine(mesh, SelfIntersections::Skip, progress);
      surface.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
      surfaces->push_back(std::move(surface));
    }
  }
  std::ranges::stable_sort(*surfaces, {}, &LobeSurface::lobe);
  result.lobes = std::move(lobes);
  result.surfaces = std::move(surfaces);
  result.regions = nullptr;
  progress.report(1.0);
  return result;
}

}  // namespace pneuma
