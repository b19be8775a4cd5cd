#pragma once

#include <memory>

#include "core/clearance_grid.h"
#include "core/domain.h"

namespace pneuma {

/// Another domain made fast: a grid answers far from the wall, the domain itself near it, so that
/// every answer is the domain's own.
///
/// A cell counts as far from the wall if the corners of the 3 x 3 x 3 cells around it all lie on
/// the same side. That is certain for walls made of pieces that bend with radii well above 3 cells
/// (a piece that reached the middle cell and none of the corners would bulge by more than that).
class GridDomain : public Domain {
 public:
  /// @param cellMm side of the grid's cells, mm
  GridDomain(std::shared_ptr<const Domain> domain, double cellMm);

  bool contains(const Vec3& p) const override;
  bool containsSegment(const Vec3& a, const Vec3& b) const override;
  bool containsBox(const Box3& box) const override;
  double distanceToWall(const Vec3& p) const override;
  std::uint32_t insideAlongX(const Vec3& first, double stepMm, std::uint32_t wanted) const override;

  Box3 bounds() const override { return domain_->bounds(); }

  double volumeMm3() const override { return domain_->volumeMm3(); }

 private:
  /// How far one may go from `p` in any direction before asking again, mm; -1 if `p` is outside.
  double insideFor(const Vec3& p, double nearStep) const;

  std::shared_ptr<const Domain> domain_;
  ClearanceGrid grid_;
};

}  // namespace pneuma
