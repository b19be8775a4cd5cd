#include "pipeline/detail/breathing_parts.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/mesh_doctor.h"
#include "geometry/surface_domain.h"
#include "pipeline/whole_lungs.h"

namespace pneuma {
namespace {

constexpr double RampMm = 30.0;  // over which airways take up the motion of their lobe
constexpr double SmallestLungMm = 50.0;
constexpr double WallVoxelMm =
    2.0;  // of walls around lobes that overlap; volumes are the lobes' own
constexpr std::size_t ChunkPoints = 4096;

bool isWhole(Lobe lobe) { return lobe == Lobe::RightLung || lobe == Lobe::LeftLung; }

/// From 0 to 1 and level at both ends.
double ramp(double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// How far along the airways each branch begins from where they enter a lung; below 0
/// outside.
std::vector<double> depthsMm(const AirwayTree& tree) {
  std::vector<double> depths(tree.size(), -1.0);
  for (std::size_t n = 0; n < tree.size(); ++n) {
    const Branch& branch = tree[n];
    if (side(branch.lobe) == Side::None) continue;
    const auto parent = static_cast<std::size_t>(branch.parent);
    const bool enters = branch.parent < 0 || depths[parent] < 0.0;
    depths[n] = enters ? 0.0 : depths[parent] + lengthMm(tree[parent]);
  }
  return depths;
}

/// det(I + s G) = 1 + tr(G) s + (sum of the principal minors) s^2 + det(G) s^3.
std::array<double, 3> determinantOf(const Eigen::Matrix3d& g) {
  const double trace = g.trace();
  const double minors = 0.5 * (trace * trace - (g * g).trace());
  return {trace, minors, g.determinant()};
}

/// @throws InvalidInput naming the surface if nothing is inside of it
void requireClosed(const LobeSurface& surface) {
  // One that was put together by hand was not examined before.
  const MeshReport health = surface.health.triangles > 0
                                ? surface.health
                                : examine(*surface.mesh, SelfIntersections::Skip);
  if (health.closed && health.misorientedEdges == 0 && health.volumeMl > 0.0) return;
  const std::vector<std::string> wrong = complaints(health);
  throw InvalidInput(
      "'" + surface.name + "' cannot breathe: " +
      (wrong.empty() ? "it encloses no volume; mend it with 'pneuma repair'" : wrong.front()));
}

}  // namespace

std::map<Side, TriangleMesh> wallsOf(const LungModel& model, std::vector<std::string>& warnings,
                                     const Progress& progress) {
  if (!model.surfaces || model.surfaces->empty()) {
    throw InvalidInput("there is no lung to breathe; give the surfaces of its lobes");
  }
  Box3 box;
  for (const LobeSurface& surface : *model.surfaces) box.extend(bounds(*surface.mesh));
  if (box.sizes().maxCoeff() < SmallestLungMm) {
    throw InvalidInput("the lungs are " + std::to_string(box.sizes().maxCoeff()) +
                       " mm long; are they in other units than mm? 'pneuma repair' and 'pneuma "
                       "export --from-units' change them");
  }
  const bool lobes = std::ranges::none_of(*model.surfaces, isWhole, &LobeSurface::lobe);
  const LungModel joined = lobes ? withWholeLungs(model, progress, WallVoxelMm) : model;
  requireSides(joined);
  std::map<Side, TriangleMesh> walls;
  for (const LobeSurface& surface : *joined.surfaces) {
    if (!isWhole(surface.lobe)) continue;
    requireClosed(surface);
    walls.emplace(side(surface.lobe), *surface.mesh);
  }
  if (walls.empty()) {
    throw InvalidInput(
        "no surface is a lung or a lobe by its name; names carry right, left, rul, "
        "rml, rll, lul or lll");
  }
  warnings.insert(warnings.end(),
                  joined.warnings.begin() + static_cast<std::ptrdiff_t>(model.warnings.size()),
                  joined.warnings.end());
  return walls;
}

std::vector<MovingSurface> movingSurfaces(const LungModel& model,
                                          const std::map<Side, LungMotion>& motion,
                                          const Progress& progress) {
  std::vector<MovingSurface> surfaces;
  for (const LobeSurface& surface : *model.surfaces) {
    const auto found = motion.find(side(surface.lobe));
    if (found == motion.end()) continue;
    const LungMotion& of = found->second;
    const std::vector<Vec3>& points = surface.mesh->points;
    MovingSurface moving{surface, found->first, {}, {}};
    moving.displacement.resize(points.size());
    moving.volumeChange.resize(points.size());
    for (std::size_t begin = 0; begin < points.size(); begin += ChunkPoints) {
      progress.throwIfStopped();
      const std::size_t count = std::min(ChunkPoints, points.size() - begin);
      parallelFor(count, [&](std::size_t offset) {
        const std::size_t n = begin + offset;
        const FieldAt field = of.withGradientAt(points[n]);
        moving.displacement[n] = field.value;
        moving.volumeChange[n] = determinantOf(field.gradient);
      });
    }
    surfaces.push_back(std::move(moving));
    progress.report(static_cast<double>(surfaces.size()) /
                    static_cast<double>(model.surfaces->size()));
  }
  return surfaces;
}

void moveTree(BreathingLungs& lungs, const Progress& progress) {
  const AirwayTree& tree = *lungs.tree;
  Box3 box;
  for (const auto& [side, motion] : lungs.motion) box.extend(bounds(motion.wall()));
  std::size_t inside = 0;
  std::size_t ofLungs = 0;
  for (const Branch& branch : tree) {
    if (lungs.motion.count(side(branch.lobe)) == 0) continue;
    ++ofLungs;
    if (box.contains(branch.distal)) ++inside;
  }
  if (ofLungs == 0) {
    throw InvalidInput(
        "no airway says which lobe it is in, so that none would move; give a tree "
        "that 'pneuma grow' grew in these lobes");
  }
  if (2 * inside < ofLungs) {
    throw InvalidInput("the tree lies elsewhere than the lungs: " + std::to_string(inside) +
                       " of " + std::to_string(ofLungs) +
                       " airways are within their box; are both of the same person?");
  }
  const std::vector<double> depths = depthsMm(tree);
  std::vector<char> atMothersEnd(tree.size(), 0);
  lungs.treeMotion.ends.assign(tree.size(), {Vec3::Zero(), Vec3::Zero()});
  lungs.treeMotion.via.resize(tree.size());
  for (std::size_t begin = 0; begin < tree.size(); begin += ChunkPoints) {
    progress.throwIfStopped();
    progress.report(static_cast<double>(begin) / static_cast<double>(tree.size()));
    parallelFor(std::min(ChunkPoints, tree.size() - begin), [&](std::size_t offset) {
      const std::size_t n = begin + offset;
      const Branch& branch = tree[n];
      lungs.treeMotion.via[n].assign(branch.via.size(), Vec3::Zero());
      const auto motion = lungs.motion.find(side(branch.lobe));
      if (motion == lungs.motion.end()) return;
      double depth = depths[n];
      const auto moved = [&](const Vec3& p) {
        return Vec3(ramp(depth / RampMm) * motion->second.at(p));
      };
      const auto mother = static_cast<std::size_t>(std::max(0, branch.parent));
      // A daughter begins where her mother ends, and needs no search of her own.
      atMothersEnd[n] = branch.parent >= 0 && side(tree[mother].lobe) == side(branch.lobe) &&
                        tree[mother].distal == branch.proximal;
      if (atMothersEnd[n] == 0) lungs.treeMotion.ends[n][0] = moved(branch.proximal);
      Vec3 last = branch.proximal;
      for (std::size_t v = 0; v < branch.via.size(); ++v) {
        depth += (branch.via[v].position - last).norm();
        last = branch.via[v].position;
        lungs.treeMotion.via[n][v] = moved(last);
      }
      depth += (branch.distal - last).norm();
      lungs.treeMotion.ends[n][1] = moved(branch.distal);
    });
  }
  for (std::size_t n = 0; n < tree.size(); ++n) {
    if (atMothersEnd[n] == 0) continue;
    const auto mother = static_cast<std::size_t>(tree[n].parent);
    lungs.treeMotion.ends[n][0] = lungs.treeMotion.ends[mother][1];
  }
}

std::vector<Vec3> pointsWithin(const TriangleMesh& surface, const Box3& box, double stepMm) {
  const SurfaceDomain domain(surface);
  std::vector<Vec3> points;
  for (double z = box.min().z(); z < box.max().z(); z += stepMm) {
    for (double y = box.min().y(); y < box.max().y(); y += stepMm) {
      for (double x = box.min().x(); x < box.max().x(); x += stepMm) {
        if (domain.contains({x, y, z})) points.emplace_back(x, y, z);
      }
    }
  }
  return points;
}

}  // namespace pneuma
