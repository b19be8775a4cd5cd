#include "core/grid_domain.h"

#include <algorithm>

#include "core/parallel.h"

namespace pneuma {

GridDomain::GridDomain(std::shared_ptr<const Domain> domain, double cellMm)
    : domain_(std::move(domain)), grid_(domain_->bounds(), cellMm) {
  const Eigen::Vector3i size = grid_.size();
  const Eigen::Vector3i corners = size.array() + 1;
  const auto cornerIndex = [&](int i, int j, int k) {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(corners.x()) *
               (static_cast<std::size_t>(j) +
                static_cast<std::size_t>(corners.y()) * static_cast<std::size_t>(k));
  };
  std::vector<char> inside(cornerIndex(0, 0, corners.z()));
  parallelFor(static_cast<std::size_t>(corners.z()), [&](std::size_t plane) {
    const int k = static_cast<int>(plane);
    for (int j = 0; j < corners.y(); ++j)
      for (int i = 0; i < corners.x(); ++i)
        inside[cornerIndex(i, j, k)] =
            domain_->contains(grid_.origin() + cellMm * Vec3(i, j, k)) ? 1 : 0;
  });
  std::vector<ClearanceGrid::Cell> cells(grid_.cellCount());
  parallelFor(static_cast<std::size_t>(size.z()), [&](std::size_t plane) {
    const int k = static_cast<int>(plane);
    for (int j = 0; j < size.y(); ++j) {
      for (int i = 0; i < size.x(); ++i) {
        int count = 0;
        int all = 0;
        for (int c = std::max(0, k - 1); c <= std::min(k + 2, corners.z() - 1); ++c)
          for (int b = std::max(0, j - 1); b <= std::min(j + 2, corners.y() - 1); ++b)
            for (int a = std::max(0, i - 1); a <= std::min(i + 2, corners.x() - 1); ++a) {
              count += inside[cornerIndex(a, b, c)];
              ++all;
            }
        cells[grid_.index(i, j, k)] = count == all ? ClearanceGrid::Cell::Inside
                                      : count == 0 ? ClearanceGrid::Cell::Outside
                                                   : ClearanceGrid::Cell::Wall;
      }
    }
  });
  grid_.setCells(cells);
}

bool GridDomain::contains(const Vec3& p) const {
  const int clearance = grid_.clearance(p);
  return clearance == 0 ? domain_->contains(p) : clearance > 0;
}

bool GridDomain::containsBox(const Box3& box) const {
  return grid_.keepsInside(box) || domain_->containsBox(box);
}

std::uint32_t GridDomain::insideAlongX(const Vec3& first, double stepMm,
                                       std::uint32_t wanted) const {
  return grid_.insideAlongX(first, stepMm, wanted, [this](const Vec3& p) { return contains(p); });
}

double GridDomain::distanceToWall(const Vec3& p) const {
  return std::max(domain_->distanceToWall(p), grid_.clearanceMm(p));
}

double GridDomain::insideFor(const Vec3& p, double nearStep) const {
  const int clearance = grid_.clearance(p);
  if (clearance < 0 || (clearance == 0 && !domain_->contains(p))) return -1.0;
  return clearance == 0 ? nearStep : std::max(nearStep, grid_.clearanceMm(p));
}

bool GridDomain::containsSegment(const Vec3& a, const Vec3& b) const {
  // March by the clearance where there is some, by small steps near the wall.
  const double length = (b - a).norm();
  const double nearStep = std::min(0.5, grid_.cellMm() / 4.0);
  const double fromB = insideFor(b, nearStep);
  if (fromB < 0.0) return false;
  double done = insideFor(a, nearStep);
  if (done < 0.0) return false;
  while (done + fromB < length) {
    const double step = insideFor(a + (b - a) * (done / length), nearStep);
    if (step < 0.0) return false;
    done += step;
  }
  return true;
}

}  // namespace pneuma
