#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "anatomy/tree_motion.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// s of each lung, and of the chest wall around a collapsed one.
struct BreathScale {
  double right = 0.0;
  double left = 0.0;
  double chestWall = 0.0;

  double of(Side side) const {
    return side == Side::Right ? right : side == Side::Left ? left : 0.0;
  }

  bool operator==(const BreathScale&) const = default;
};

/// How everything in a scene moves while lungs breathe: from x to x + s u, with an s for each lung.
struct BreathingScene {
  struct Surface {
    Side side = Side::None;
    std::vector<Vec3> displacement;  ///< u of each point, mm
    std::vector<double> values;      ///< of each point, that colour it; none: the lobe's colour
    /// Fewer triangles for moving pictures, with the same of its points.
    std::shared_ptr<const TriangleMesh> coarse{};
    std::shared_ptr<const std::vector<std::size_t>>
        coarseOrigins{};  ///< of its points in the whole
    std::vector<Vec3> coarseDisplacement{};
    std::vector<double> coarseValues{};
  };

  /// Something around the lungs that is drawn by its rim alone.
  struct Shell {
    enum class Of { ChestWall, Expiration, Inspiration };

    Of of = Of::ChestWall;
    Side side = Side::None;
    std::shared_ptr<const TriangleMesh> mesh;
    std::vector<Vec3> displacement;  ///< u of each point, mm
    double scale = 0.0;              ///< at which it stands; the chest wall moves
  };

  std::vector<Surface> surfaces;  ///< one for each of the scene's
  TreeMotion tree;                ///< empty if there is none
  std::string quantity;           ///< and unit, of the values: "Displacement, mm"
  std::vector<Shell> shells{};
};

/// A shell with few triangles, of a surface that may have many.
/// @param displacement u of its points, mm
BreathingScene::Shell shellOf(BreathingScene::Shell::Of of, Side side, const TriangleMesh& surface,
                              std::span<const Vec3> displacement);

/// Fills in the surfaces' coarse forms, so that all have about `triangles` together; those of
/// surfaces that are no finer stay empty. Takes seconds for a million triangles; surfaces that have
/// a coarse form already, of another scene of the same meshes, keep it.
/// @param meshes of the surfaces, in their order
void addCoarseSurfaces(BreathingScene& breathing,
                       const std::vector<std::shared_ptr<const TriangleMesh>>& meshes,
                       std::size_t triangles);

/// Adds where the lungs are at the ends of expiration and inspiration, of the coarse surfaces where
/// there are some. What lobes share is left out: the outlines are those of whole lungs.
/// @param meshes of the surfaces, in their order
void addOnionSkin(BreathingScene& breathing,
                  const std::vector<std::shared_ptr<const TriangleMesh>>& meshes,
                  const BreathScale& expiration, const BreathScale& inspiration);

}  // namespace pneuma
