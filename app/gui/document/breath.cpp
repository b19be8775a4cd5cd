#include "document/breath.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "document/text.h"
#include "views/breath_pictures.h"

namespace pneuma {

namespace {

constexpr std::size_t MovingTriangles = 25000;  // of all surfaces, while they move
constexpr double MlPerLitre = 1000.0;

/// What colours the points of a surface, at the deepest of the breath.
std::vector<double> valuesOf(const MovingSurface& surface, BreathColour colour, double scale) {
  std::vector<double> values;
  if (colour == BreathColour::Displacement) {
    for (const Vec3& u : surface.displacement) values.push_back(scale * u.norm());
  } else if (colour == BreathColour::VolumeChange) {
    for (const auto& c : surface.volumeChange) {
      values.push_back(100.0 * scale * (c[0] + scale * (c[1] + scale * c[2])));
    }
  }
  return values;
}

}  // namespace

std::shared_ptr<const Breath> breathOf(const LungModel& model, BreathingLungs lungs,
                                       const BreatheOptions& options, Json report) {
  auto breath = std::make_shared<Breath>();
  breath->lungs = std::move(lungs);
  breath->options = options;
  breath->report = std::move(report);
  std::vector<const MovingSurface*> moving;
  std::vector<std::shared_ptr<const TriangleMesh>> meshes;
  for (const LobeSurface& surface : *model.surfaces) {
    const auto found = std::ranges::find_if(breath->lungs.surfaces, [&](const MovingSurface& one) {
      return one.surface.name == surface.name;
    });
    const bool moves = found != breath->lungs.surfaces.end();
    moving.push_back(moves ? &*found : nullptr);
    meshes.push_back(moves ? found->surface.mesh : surface.mesh);
    breath->surfaces.push_back({surface.lobe, meshes.back()});
  }
  const BreathScale deepest = breathScale(frameAt(breath->lungs, fullestPhase(breath->lungs)));
  const BreathScale emptiest = breathScale(frameAt(breath->lungs, emptiestPhase(breath->lungs)));
  for (const MovingSurface& surface : breath->lungs.surfaces) {
    const double s = deepest.of(surface.side);
    for (const Vec3& u : surface.displacement) {
      breath->farthestMm = std::max(breath->farthestMm, s * u.norm());
    }
  }
  static const std::array<const char*, 3> quantities = {"", "Displacement, mm", "Volume change, %"};
  for (const BreathColour colour :
       {BreathColour::Lobe, BreathColour::Displacement, BreathColour::VolumeChange}) {
    auto scene = std::make_shared<BreathingScene>();
    scene->tree = breath->lungs.treeMotion;
    scene->quantity = quantities[static_cast<std::size_t>(colour)];
    for (std::size_t i = 0; i < moving.size(); ++i) {
      BreathingScene::Surface surface;
      if (moving[i] != nullptr) {
        surface.side = moving[i]->side;
        surface.displacement = moving[i]->displacement;
        surface.values = valuesOf(*moving[i], colour, deepest.of(surface.side));
      } else {
        surface.displacement.assign(meshes[i]->points.size(), Vec3::Zero());
        if (colour != BreathColour::Lobe) surface.values.assign(meshes[i]->points.size(), 0.0);
      }
      if (const auto& first = breath->scenes.front(); first != nullptr) {
        surface.coarse = first->surfaces[i].coarse;
        surface.coarseOrigins = first->surfaces[i].coarseOrigins;
      }
      scene->surfaces.push_back(std::move(surface));
    }
    addCoarseSurfaces(*scene, meshes, MovingTriangles);
    if (const auto& first = breath->scenes.front(); first != nullptr) {
      scene->shells = first->shells;
    } else {
      addOnionSkin(*scene, meshes, emptiest, deepest);
      if (const auto& chest = breath->lungs.chestWall) {
        scene->shells.push_back(shellOf(BreathingScene::Shell::Of::ChestWall, chest->side(),
                                        chest->wall(), chest->ofWall()));
      }
    }
    breath->scenes[static_cast<std::size_t>(colour)] = std::move(scene);
  }
  return breath;
}

BreathScale scaleAt(const Breath& breath, double phase) {
  return breathScale(frameAt(breath.lungs, phase));
}

double volumeMlAt(const Breath& breath, double phase) {
  double sum = 0.0;
  for (const auto& [side, ml] : frameAt(breath.lungs, phase).volumeMl) sum += ml;
  return sum;
}

PropertySheet breathSheet(const Breath& breath) {
  const BreathCycle& cycle = breath.lungs.cycle;
  PropertySheet sheet;
  sheet.title = capitalised(scenarioOf(breath.options.scenario).title);
  sheet.headline = withUnit(MlPerLitre * cycle.tidal, 0, "mL");
  sheet.note = QStringLiteral("a breath");
  sheet.rows.push_back(
      {QStringLiteral("Breaths"), withUnit(60.0 / breath.lungs.drive.period, 1, "/min")});
  sheet.rows.push_back({QStringLiteral("Flow in, out"),
                        QStringLiteral("%1, %2").arg(withUnit(cycle.peakInspiratory, 2, ""),
                                                     withUnit(cycle.peakExpiratory, 2, "L/s"))});
  if (cycle.trapped > 0.01) {
    sheet.rows.push_back(
        {QStringLiteral("Trapped"), withUnit(MlPerLitre * cycle.trapped, 0, "mL")});
  }
  if (breath.lungs.chestWall) {
    sheet.rows.push_back(
        {QStringLiteral("Pleural gap"), withUnit(pleuralGapMl(breath.lungs), 0, "mL")});
  }
  sheet.rows.push_back({QStringLiteral("Farthest way"), withUnit(breath.farthestMm, 1, "mm")});
  for (const Json& check : breath.report.at("checks")) {
    const bool good = check.at("ok").get<bool>();
    const std::string id = check.at("id").get<std::string>();
    const QString lung = id.ends_with("-R") ? QStringLiteral("right") : QStringLiteral("left");
    const QString label = id.starts_with("VOLUME")
                              ? QStringLiteral("Volume as the curve, %1").arg(lung)
                              : QStringLiteral("Nothing folds, %1").arg(lung);
    sheet.rows.push_back({label, {}, good ? PropertyRow::Kind::Good : PropertyRow::Kind::Look});
  }
  return sheet;
}

}  // namespace pneuma
