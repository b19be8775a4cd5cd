#include "views/breath_gltf.h"

#include <map>
#include <string>
#include <vector>

#include "io/animated_gltf.h"
#include "render/branch_colours.h"
#include "render/breath_attributes.h"
#include "render/colour_map.h"
#include "render/tube_mesh.h"

namespace pneuma {
namespace {

/// Motions of the file: what no lung has a scale for goes with the right one, as on the screen.
constexpr std::size_t RightMotion = 0;
constexpr std::size_t LeftMotion = 1;

std::size_t motionOf(Side side) { return side == Side::Left ? LeftMotion : RightMotion; }

std::vector<float> threeOfFour(const std::vector<float>& values) {
  std::vector<float> result;
  result.reserve(values.size() / 4 * 3);
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (n % 4 != 3) result.push_back(values[n]);
  }
  return result;
}

MorphingMesh meshOf(const MovingSurface& surface, const SceneOptions& look) {
  const TriangleMesh& at = *surface.surface.mesh;
  const BreathAttributes attributes = breathAttributes(at, surface.displacement, surface.side);
  const Rgb colour = lobeColour(surface.surface.lobe, look.palette);
  MorphingMesh mesh;
  mesh.name = std::string(longName(surface.surface.lobe));
  mesh.colour = {colour.r, colour.g, colour.b, look.lobeOpacity};
  for (const Vec3& p : at.points) {
    for (int axis = 0; axis < 3; ++axis) mesh.points.push_back(static_cast<float>(p[axis]));
  }
  mesh.normals = attributes.normals;
  mesh.triangles = at.triangles;
  mesh.displacement = threeOfFour(attributes.displacement);
  mesh.normalSlope = attributes.normalSlope;
  mesh.motion = motionOf(surface.side);
  return mesh;
}

/// The airways as tubes, those of each lung by themselves: each follows its lung.
std::vector<MorphingMesh> airways(const BreathingLungs& lungs, const SceneOptions& look,
                                  const Progress& progress) {
  const AirwayTree& tree = *lungs.tree;
  const std::vector<bool> all(tree.size(), true);
  const std::vector<Rgb> colours = branchColours(tree, all, look).colours;
  std::vector<MorphingMesh> meshes;
  for (const bool left : {false, true}) {
    progress.report(left ? 0.5 : 0.0);
    std::vector<bool> visible(tree.size());
    for (std::size_t n = 0; n < tree.size(); ++n) {
      visible[n] = (side(tree[n].lobe) == Side::Left) == left;
    }
    TubeMesh tubes = tubeMesh(tree, visible, colours, {});
    if (tubes.triangles.empty()) continue;
    progress.throwIfStopped();
    BreathAttributes attributes =
        breathAttributes(tree, lungs.treeMotion, tubes.points, tubes.branches);
    MorphingMesh mesh;
    mesh.name = left ? "Airways of the left lung" : "Airways, central and of the right lung";
    mesh.points = std::move(tubes.points);
    mesh.normals = std::move(tubes.normals);
    mesh.colours = std::move(tubes.colours);
    for (std::size_t n = 0; n < tubes.triangles.size(); n += 3) {
      mesh.triangles.push_back({static_cast<std::uint32_t>(tubes.triangles[n]),
                                static_cast<std::uint32_t>(tubes.triangles[n + 1]),
                                static_cast<std::uint32_t>(tubes.triangles[n + 2])});
    }
    mesh.displacement = threeOfFour(attributes.displacement);
    mesh.normalSlope = std::move(attributes.normalSlope);
    mesh.motion = left ? LeftMotion : RightMotion;
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

}  // namespace

void writeBreathGltf(const std::filesystem::path& path, const BreathingLungs& lungs,
                     Existing existing, const Progress& progress) {
  const SceneOptions look;
  // Airways first: what is seen through the lobes is drawn before them.
  std::vector<MorphingMesh> meshes;
  if (lungs.tree) meshes = airways(lungs, look, progress.part(0.0, 0.4, "shaping airways"));
  for (const MovingSurface& surface : lungs.surfaces) {
    progress.throwIfStopped();
    meshes.push_back(meshOf(surface, look));
  }
  std::vector<double> seconds;
  std::vector<MorphWeights> weights(2);
  const auto add = [&](double at, const BreathFrame& frame) {
    seconds.push_back(at);
    for (const Side side : {Side::Right, Side::Left}) {
      const auto scale = frame.scale.find(side);
      weights[motionOf(side)].push_back(scale == frame.scale.end() ? 0.0 : scale->second);
    }
  };
  for (const BreathFrame& frame : lungs.frames) add(frame.phase * lungs.drive.period, frame);
  add(lungs.drive.period, lungs.frames.front());
  writeAnimatedGltf(path, meshes, seconds, weights, existing, progress.part(0.6, 1.0, "writing"));
}

}  // namespace pneuma
