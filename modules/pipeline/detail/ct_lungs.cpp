#include <algorithm>
#include <cmath>
#include <memory>

#include "pipeline/detail/ct_thorax.h"
#include "pipeline/sample_lung.h"

namespace pneuma {
namespace {

/// Air and tissue of a lung at rest: denser towards the back, where a person on a table lies on it.
double parenchymaHu(const Vec3& p) { return -868.0 + 0.22 * (p.y() - 10.0); }

constexpr double CollapsedHu = 35.0;
constexpr double FissureHu = 40.0;

/// Below this height the left lung is collapsed, if it is; higher at the back.
double collapsedBelow(const Vec3& p) { return -75.0 + 0.35 * p.y(); }

/// What a lung reaches towards the midline, to touch the other but for a sheet.
/// @param depth below the wall of the chest, which it lies along in front
double touchLevel(Side side, double deepMm, double depth, const Vec3& p) {
  constexpr double HalfSheetMm = 0.15;
  constexpr double ReachMm = 34.0;     // well into the lung
  constexpr double PosteriorMm = 7.0;  // all the room between oesophagus and spine
  const double across = side == Side::Left ? p.x() : -p.x();
  const double sideways = slabLevel(across, HalfSheetMm, ReachMm);
  const double front =
      std::min({slabLevel(depth, 2.0, 2.0 + deepMm), slabLevel(p.z(), -4.0, 52.0), -p.y() - 20.0});
  const double back = std::min(slabLevel(p.y(), 27.0, 27.0 + std::min(deepMm, PosteriorMm)),
                               slabLevel(p.z(), 55.0, 85.0));
  return std::min(sideways, std::max(front, back));
}

/// From a table, and by the formula where it must be exact: near the pleura.
std::function<double(const Vec3&)> lungLevel(Side side, double touchingMm,
                                             const std::shared_ptr<const ThoraxLevels>& levels) {
  constexpr double CellMm = 2.0;
  constexpr double NearMm = 0.2;  // the table errs by less
  const SampleLung lung = sampleLung(side);
  const auto exact = [lung](const Vec3& p) { return lung.pleura(lung.modelFromLps(p)); };
  const auto table =
      std::make_shared<const LevelTable>(exact, widened(lung.bounds(), CellMm), CellMm);
  return [=, box = lung.bounds()](const Vec3& p) {
    const double toBox = box.exteriorDistance(p);
    double level = (*table)(p);  // outside the box that of its nearest point
    if (toBox > 0.0) {
      level = std::min(-toBox, level + toBox);
    } else if (std::abs(level) < NearMm) {
      level = exact(p);
    }
    if (touchingMm > 0.0) level = std::max(level, touchLevel(side, touchingMm, levels->cage(p), p));
    return level;
  };
}

/// Positive in a thin sheet along a fissure; at most the distance to its wall.
double sheetLevel(const SampleFissure& fissure, const Vec3& p) {
  constexpr double HalfMm = 0.3;
  constexpr double NearMm = 1.5;  // where the surface can be taken for flat
  const double off = std::abs(p.z() - fissure.zAt(p.x(), p.y()));
  const double close = off / fissure.steepness(p.x(), p.y());
  return HalfMm - (close < NearMm ? close : std::max(NearMm, off / fissure.steepest));
}

/// Two layers of pleura, where lobes meet.
CtShape fissureShape(const SampleFissure& fissure, const SampleLung& lung,
                     const std::function<double(const Vec3&)>& lungLevel) {
  CtShape sheet;
  sheet.box = lung.bounds();
  sheet.hu = FissureHu;
  sheet.labelledAsLung = true;
  sheet.level = [=, horizontal = lung.horizontal && fissure.name == lung.horizontal->name,
                 oblique = lung.oblique](const Vec3& p) {
    const double level = std::min(sheetLevel(fissure, p), lungLevel(p));
    return horizontal ? std::min(level, oblique.above(p)) : level;
  };
  return sheet;
}

}  // namespace

CtBody lungShapes(const ThoraxVariant& variant, const std::shared_ptr<const ThoraxLevels>& levels) {
  CtBody body;
  for (const Side side : {Side::Right, Side::Left}) {
    CtShape lung;
    lung.box = widened(sampleLung(side).bounds(), variant.touchingLungsMm > 0.0 ? 25.0 : 0.0);
    lung.level = lungLevel(side, variant.touchingLungsMm, levels);
    lung.huAt = parenchymaHu;
    lung.label = side == Side::Right ? Lobe::RightLung : Lobe::LeftLung;
    if (side == Side::Left && variant.collapsed) {
      CtShape dense = lung;
      dense.huAt = {};
      dense.hu = CollapsedHu;
      dense.level = [all = lung.level](const Vec3& p) {
        constexpr double Steepest = 1.06;
        return std::min(all(p), (collapsedBelow(p) - p.z()) / Steepest);
      };
      body.push_back(std::move(dense));
    }
    const SampleLung shape = sampleLung(side);
    for (const SampleFissure& fissure : shape.fissures()) {
      body.push_back(fissureShape(fissure, shape, lung.level));
    }
    body.push_back(std::move(lung));
  }
  return body;
}

}  // namespace pneuma
