#include "pipeline/sample_ct.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/random.h"
#include "core/units.h"
#include "pipeline/detail/ct_bronchi.h"
#include "pipeline/detail/ct_scan.h"
#include "pipeline/detail/ct_thorax.h"

namespace pneuma {
namespace {

constexpr double FieldOfViewMm = 409.6;  // 512 voxels of 0.8 mm
constexpr double CentreY = 18.0;         // of the slices: the table is seen as well
constexpr double LowestMm = -192.0;      // below the costophrenic recesses
constexpr double HighestMm = 136.0;      // above the tops of the lungs

ImageGeometry geometryOf(const SampleCtOptions& options) {
  ImageGeometry geometry;
  const int inPlane = static_cast<int>(std::lround(FieldOfViewMm / options.spacingMm));
  // A tilted slice reaches from lower to higher, so there must be more of them.
  const double tilt = radians(options.tiltDeg);
  const double more = 135.0 * std::abs(std::tan(tilt));
  const double high = HighestMm - LowestMm + 2.0 * more;
  geometry.size = {inPlane, inPlane, static_cast<int>(std::lround(high / options.thickMm))};
  geometry.spacing = {options.spacingMm, options.spacingMm, options.thickMm};
  geometry.direction.col(1) = Vec3(0.0, std::cos(tilt), std::sin(tilt));
  const Vec3 middle = (Vec3(inPlane, inPlane, geometry.size[2]) - Vec3::Ones()) / 2.0;
  geometry.origin = Vec3(0.0, CentreY, (LowestMm + HighestMm) / 2.0) - geometry.steps() * middle;
  return geometry;
}

/// The body seen in a mirror, left for right. Labels keep to the side of the image.
CtBody mirrored(CtBody body) {
  for (CtShape& shape : body) {
    const auto flip = [](const Vec3& p) { return Vec3(-p.x(), p.y(), p.z()); };
    shape.level = [level = shape.level, flip](const Vec3& p) { return level(flip(p)); };
    if (shape.huAt) {
      shape.huAt = [huAt = shape.huAt, flip](const Vec3& p) { return huAt(flip(p)); };
    }
    const Vec3 low = shape.box.min();
    const Vec3 high = shape.box.max();
    shape.box = {Vec3(-high.x(), low.y(), low.z()), Vec3(-low.x(), high.y(), high.z())};
    if (shape.label == Lobe::RightLung) {
      shape.label = Lobe::LeftLung;
    } else if (shape.label == Lobe::LeftLung) {
      shape.label = Lobe::RightLung;
    }
  }
  return body;
}

AirwayTree mirrored(const AirwayTree& tree) {
  AirwayTree result;
  for (Branch branch : tree) {
    branch.proximal.x() = -branch.proximal.x();
    branch.distal.x() = -branch.distal.x();
    result.add(std::move(branch));
  }
  return result;
}

/// Slices inside the volume, none beside another.
std::vector<int> missingSlices(const SampleCtOptions& options, int slices) {
  std::vector<int> candidates;
  for (int k = 2; k < slices - 2; ++k) candidates.push_back(k);
  Random random(options.seed ^ 0x6761707321U);
  random.shuffle(candidates);
  std::vector<int> missing;
  for (const int k : candidates) {
    if (std::ssize(missing) == options.gaps) break;
    const bool alone =
        std::ranges::none_of(missing, [&](int other) { return std::abs(k - other) < 3; });
    if (alone) missing.push_back(k);
  }
  std::ranges::sort(missing);
  return missing;
}

void append(CtBody& body, CtBody more) {
  for (CtShape& shape : more) body.push_back(std::move(shape));
}

}  // namespace

SampleCt sampleCt(const SampleChest& chest, const SampleCtOptions& options,
                  const Progress& progress) {
  requireValid(options);
  const ImageGeometry geometry = geometryOf(options);
  CtBronchi airways = bronchi(chest, geometry.bounds().max().z() + 10.0, options.seed,
                              progress.part(0.0, 0.15, "growing bronchi and vessels"));
  const ThoraxVariant variant{options.collapsed, options.stomachGas, options.touchingLungsMm};
  CtBody body = std::move(airways.shapes);
  const std::shared_ptr<const ThoraxLevels> levels = thoraxLevels();
  append(body, lungShapes(variant, levels));
  append(body, trunkShapes(variant, levels));

  SampleCt result;
  result.central = chest.central;
  result.airways = std::move(airways.airways);
  if (options.mirror) {
    body = mirrored(std::move(body));
    result.central = mirrored(result.central);
    result.airways = mirrored(result.airways);
  }
  ScanSettings settings;
  settings.noiseHu = options.noiseHu;
  settings.circleMm = FieldOfViewMm / 2.0;
  settings.seed = options.seed;
  ScannedBody scan = scanned(body, geometry, settings, progress.part(0.15, 1.0, "scanning"));
  result.image = std::move(scan.image);
  result.truth = std::move(scan.labels);
  result.missing = missingSlices(options, geometry.size[2]);
  return result;
}

SampleChest mirrored(SampleChest chest) {
  for (LobeSurface& lobe : chest.lobes) {
    TriangleMesh mesh = *lobe.mesh;
    for (Vec3& p : mesh.points) p.x() = -p.x();
    for (auto& [a, b, c] : mesh.triangles) std::swap(b, c);  // outward again
    lobe.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  }
  for (SampleFissure& fissure : chest.fissures) fissure = fissure.mirrored();
  chest.central = mirrored(chest.central);
  return chest;
}

SampleCt sampleCt(const SampleCtOptions& options, const Progress& progress) {
  return sampleCt(sampleChest(2.0, progress.part(0.0, 0.2, "making a chest")), options,
                  progress.part(0.2, 1.0, "making a CT"));
}

double labelMl(const LabelImage& labels, Lobe label) {
  const auto voxels = std::ranges::count(labels.voxels, static_cast<std::uint8_t>(label));
  return millilitres(static_cast<double>(voxels) * labels.geometry.voxelMm3());
}

}  // namespace pneuma
