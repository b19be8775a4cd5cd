#include "geometry/cell_triangles.h"

#include <algorithm>
#include <array>
#include <utility>

namespace pneuma {
namespace {

using Cell = Eigen::Vector3i;

/// A triangle asked about many boxes of a grid (Akenine-Moller 2001: the separating axes of a
/// triangle and a box). The boxes' own axes are left to the caller.
class TriangleInBoxes {
 public:
  TriangleInBoxes(const std::array<Vec3, 3>& corners, double cellHalf) {
    const std::array<Vec3, 3> edges = {corners[1] - corners[0], corners[2] - corners[1],
                                       corners[0] - corners[2]};
    std::size_t n = 0;
    const auto add = [&](const Vec3& direction) {
      const auto [low, high] = std::minmax(
          {direction.dot(corners[0]), direction.dot(corners[1]), direction.dot(corners[2])});
      axes_[n++] = {direction, low, high, cellHalf * direction.lpNorm<1>()};
    };
    add(edges[0].cross(edges[1]));
    for (const Vec3& edge : edges) {
      add({0.0, -edge.z(), edge.y()});
      add({edge.z(), 0.0, -edge.x()});
      add({-edge.y(), edge.x(), 0.0});
    }
  }

  /// False only if the cell at `centre` certainly keeps off the triangle.
  bool meetsCell(const Vec3& centre) const {
    for (const Axis& axis : axes_) {
      const double at = axis.direction.dot(centre);
      if (at - axis.cellReach > axis.high || at + axis.cellReach < axis.low) return false;
    }
    return true;
  }

  /// The same for a box.
  bool meets(const Vec3& centre, const Vec3& half) const {
    for (const Axis& axis : axes_) {
      const double at = axis.direction.dot(centre);
      const double reach = axis.direction.cwiseAbs().dot(half);
      if (at - reach > axis.high || at + reach < axis.low) return false;
    }
    return true;
  }

 private:
  struct Axis {
    Vec3 direction;
    double low;
    double high;
    double cellReach;
  };

  std::array<Axis, 10> axes_;
};

/// Visits the cells of a grid that a triangle passes through, halving large blocks of cells as long
/// as the triangle meets them: the cost follows the cells found, not the triangle's box.
template <class Visit>
class CellWalk {
 public:
  CellWalk(const ClearanceGrid& grid, Visit& visit) : grid_(grid), visit_(visit) {}

  void walk(const std::array<Vec3, 3>& corners) {
    const Vec3 slack = Vec3::Constant(Slack * grid_.cellMm());
    const Vec3 low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]) - slack;
    const Vec3 high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]) + slack;
    const Cell from = grid_.cellOf(low);
    const Cell to = grid_.cellOf(high);
    if (from == to) {
      visit_(from);
    } else {
      split(TriangleInBoxes(corners, grid_.cellMm() * (0.5 + Slack)), from, to);
    }
  }

 private:
  static constexpr double Slack = 1e-6;
  static constexpr int SmallBlock = 27;

  void split(const TriangleInBoxes& triangle, const Cell& from, const Cell& to) {
    const Cell size = to - from + Cell::Ones();
    if (size.cast<double>().prod() <= SmallBlock) {
      for (int k = from.z(); k <= to.z(); ++k)
        for (int j = from.y(); j <= to.y(); ++j)
          for (int i = from.x(); i <= to.x(); ++i)
            if (triangle.meetsCell(grid_.cellCentre(i, j, k))) visit_({i, j, k});
      return;
    }
    const Vec3 half = grid_.cellMm() * (0.5 * size.cast<double>() + Vec3::Constant(Slack));
    const Vec3 centre =
        grid_.origin() + 0.5 * grid_.cellMm() * (from + to + Cell::Ones()).cast<double>();
    if (!triangle.meets(centre, half)) return;
    int longest = 0;
    const int middle = (size.maxCoeff(&longest) - 1) / 2;
    Cell end = to;
    end[longest] = from[longest] + middle;
    split(triangle, from, end);
    Cell begin = from;
    begin[longest] += middle + 1;
    split(triangle, begin, to);
  }

  const ClearanceGrid& grid_;
  Visit& visit_;
};

}  // namespace

CellTriangles::CellTriangles(const WallCrossings& wall, const ClearanceGrid& grid)
    : wallCellOf_(grid.cellCount(), NotWall) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;  // wall cell, triangle
  std::vector<std::size_t> counts;
  pairs.reserve(4 * wall.size());
  for (std::size_t t = 0; t < wall.size(); ++t) {
    auto visit = [&](const Cell& cell) {
      std::uint32_t& wallCell = wallCellOf_[grid.index(cell.x(), cell.y(), cell.z())];
      if (wallCell == NotWall) {
        wallCell = static_cast<std::uint32_t>(counts.size());
        counts.push_back(0);
      }
      ++counts[wallCell];
      pairs.emplace_back(wallCell, static_cast<std::uint32_t>(t));
    };
    CellWalk(grid, visit).walk(wall.corners(t));
  }
  offsets_.assign(counts.size() + 1, 0);
  for (std::size_t i = 0; i < counts.size(); ++i) offsets_[i + 1] = offsets_[i] + counts[i];
  triangles_.resize(pairs.size());
  std::vector<std::size_t> next(offsets_.begin(), offsets_.end() - 1);
  for (const auto& [wallCell, triangle] : pairs) triangles_[next[wallCell]++] = triangle;
}

}  // namespace pneuma
