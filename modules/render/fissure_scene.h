#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "anatomy/fissure.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// A point that was set on a fissure, or a handle of its plane, as views draw it.
struct FissureMark {
  Vec3 place = Vec3::Zero();
  bool current = false;  ///< of the fissure that is edited
  bool handle = false;
  bool suspect = false;  ///< stands out from the others
};

/// What the 3-D view shows of lungs whose fissures are edited. A part is drawn anew where its
/// pointer is another.
struct FissureScene {
  /// A whole lung, coloured by the lobes that its fissures give.
  struct Lung {
    Side side = Side::None;
    std::shared_ptr<const TriangleMesh> mesh;
    std::shared_ptr<const std::vector<float>> oblique;     ///< heights of its points over it
    std::shared_ptr<const std::vector<float>> horizontal;  ///< null where there is none
    bool visible = true;

    bool operator==(const Lung&) const = default;
  };

  /// A fissure inside its lung.
  struct Sheet {
    std::shared_ptr<const TriangleMesh> patch;
    std::shared_ptr<const std::vector<std::vector<Vec3>>> rim;  ///< lines upon the lung
    bool proposed = false;                                      ///< nobody set it: dashed
    bool current = false;
    bool visible = true;
    std::shared_ptr<const std::vector<std::uint8_t>> shows;  ///< of the patch's triangles: 0 where
                                                             ///< the CT shows no fissure; or null

    bool operator==(const Sheet&) const = default;
  };

  std::vector<Lung> lungs;
  std::vector<Sheet> sheets;
  std::vector<FissureMark> marks;
};

/// What slices show of them.
struct SliceFissures {
  struct Line {
    Fissure fissure = Fissure::LeftOblique;
    std::function<double(const Vec3&)> heightMm;  ///< of a point over it, negative below
    bool proposed = false;
    bool current = false;
    std::function<bool(const Vec3&)> shows;  ///< false where the CT shows no fissure; may be empty
  };

  /// Of a side all or none; the horizontal one is drawn above the oblique one alone.
  std::vector<Line> lines;
  std::vector<FissureMark> marks;  ///< drawn where they are no farther than reachMm from the slice
  double reachMm = 2.0;
};

}  // namespace pneuma
