#include "core/clearance_grid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <span>

#include "core/error.h"

namespace pneuma {
namespace {

constexpr std::uint8_t MaxClearance = 100;

/// Steps, also diagonal ones, from each cell to the nearest of another kind, by a forward and a
/// backward sweep. A rim of one cell stands for what lies off the lattice: outside.
class ChessboardDistance {
 public:
  using Cell = ClearanceGrid::Cell;

  explicit ChessboardDistance(const Eigen::Vector3i& size)
      : nx_(size.x()),
        ny_(size.y()),
        nz_(size.z()),
        row_(nx_ + 2),
        plane_(row_ * (ny_ + 2)),
        kind_(static_cast<std::size_t>(plane_ * (nz_ + 2)),
              static_cast<std::int8_t>(Cell::Outside)),
        steps_(kind_.size(), MaxClearance) {}

  void setRow(std::size_t j, std::size_t k, std::span<const Cell> kinds) {
    std::size_t at = static_cast<std::size_t>(rowStart(j, k));
    for (const Cell kind : kinds) {
      kind_[at] = static_cast<std::int8_t>(kind);
      steps_[at] = kind == Cell::Wall ? 0 : MaxClearance;
      ++at;
    }
  }

  void sweep() {
    for (std::ptrdiff_t k = 0; k < nz_; ++k)
      for (std::ptrdiff_t j = 0; j < ny_; ++j) {
        const std::ptrdiff_t here = rowStart(j, k);
        lowerByRowsBehind(here, 1);
        for (std::ptrdiff_t i = 0; i < nx_; ++i) lower(here + i, -1);
      }
    for (std::ptrdiff_t k = nz_; k-- > 0;)
      for (std::ptrdiff_t j = ny_; j-- > 0;) {
        const std::ptrdiff_t here = rowStart(j, k);
        lowerByRowsBehind(here, -1);
        for (std::ptrdiff_t i = nx_; i-- > 0;) lower(here + i, 1);
      }
  }

  /// Steps with the sign of the cell's kind.
  void copyRow(std::size_t j, std::size_t k, std::span<std::int8_t> clearances) const {
    std::size_t at = static_cast<std::size_t>(rowStart(j, k));
    for (std::int8_t& clearance : clearances) {
      clearance = static_cast<std::int8_t>(kind_[at] * steps_[at]);
      ++at;
    }
  }

 private:
  template <class Integer>
  std::ptrdiff_t rowStart(Integer j, Integer k) const {
    return (static_cast<std::ptrdiff_t>(k) + 1) * plane_ +
           (static_cast<std::ptrdiff_t>(j) + 1) * row_ + 1;
  }

  /// By the nine neighbours in the plane behind and the three in the row behind; `sign` says which
  /// way the sweep goes.
  void lowerByRowsBehind(std::ptrdiff_t here, std::ptrdiff_t sign) {
    for (const std::ptrdiff_t back : {row_, plane_ - row_, plane_, plane_ + row_}) {
      for (const std::ptrdiff_t side : {-1, 0, 1}) {
        const std::ptrdiff_t offset = side - sign * back;
        // So plain that the compiler makes it vector instructions.
        const std::int8_t* kind = kind_.data() + here;
        std::uint8_t* steps = steps_.data() + here;
        for (std::ptrdiff_t i = 0; i < nx_; ++i) {
          const auto further = static_cast<std::uint8_t>(steps[i + offset] + 1);
          const std::uint8_t step = kind[i + offset] == kind[i] ? further : std::uint8_t{1};
          steps[i] = std::min(steps[i], step);
        }
      }
    }
  }

  void lower(std::ptrdiff_t here, std::ptrdiff_t offset) {
    const std::int8_t* kind = kind_.data() + here;
    std::uint8_t* steps = steps_.data() + here;
    const int step = kind[offset] == kind[0] ? steps[offset] + 1 : 1;
    steps[0] = static_cast<std::uint8_t>(std::min<int>(steps[0], step));
  }

  std::ptrdiff_t nx_;
  std::ptrdiff_t ny_;
  std::ptrdiff_t nz_;
  std::ptrdiff_t row_;
  std::ptrdiff_t plane_;
  std::vector<std::int8_t> kind_;
  std::vector<std::uint8_t> steps_;
};

}  // namespace

ClearanceGrid::ClearanceGrid(const Box3& box, double cellMm)
    : cellMm_(cellMm), inverseCellMm_(1.0 / cellMm) {
  // The odd fraction keeps cell centres off the round coordinates that meshes like to have.
  origin_ = box.min() - cellMm * Vec3(1.0 + 0.137, 1.0 + 0.269, 1.0 + 0.071);
  const Vec3 cells = ((box.max() - origin_) / cellMm).array().ceil() + 1.0;
  if (!(cells.prod() < 2147483648.0)) {
    throw InvalidInput("the region is " + std::to_string(std::lround(box.sizes().maxCoeff())) +
                       " mm large, too large for a grid of " + std::to_string(cellMm) +
                       " mm; check its units");
  }
  size_ = cells.cast<int>();
  clearance_.assign(static_cast<std::size_t>(size_.x()) * static_cast<std::size_t>(size_.y()) *
                        static_cast<std::size_t>(size_.z()),
                    -1);
}

void ClearanceGrid::setCells(const std::vector<Cell>& kinds) {
  const auto nx = static_cast<std::size_t>(size_.x());
  const auto rows = kinds.size() / nx;
  const auto ny = static_cast<std::size_t>(size_.y());
  ChessboardDistance distance(size_);
  for (std::size_t row = 0; row < rows; ++row) {
    distance.setRow(row % ny, row / ny, std::span(kinds).subspan(row * nx, nx));
  }
  distance.sweep();
  for (std::size_t row = 0; row < rows; ++row) {
    distance.copyRow(row % ny, row / ny, std::span(clearance_).subspan(row * nx, nx));
  }
}

bool ClearanceGrid::keepsInside(const Box3& box) const {
  const Vec3 centre = box.center();
  // A cell's clearance is that of a cube around it.
  return clearance(centre) > 0 && clearanceMm(centre) > box.sizes().maxCoeff() / 2.0;
}

double ClearanceGrid::clearanceMm(const Vec3& p) const {
  const Vec3 q = (p - origin_) * inverseCellMm_;
  if (!holds(q)) return 0.0;
  const int steps = std::abs(static_cast<int>(clearance_[indexOf(q)]));
  if (steps == 0) return 0.0;
  // Every cell within steps - 1 is of the same kind; to that adds the way to the cell's own side.
  double toSide = 1.0;
  for (const double v : {q.x(), q.y(), q.z()}) {
    const double inCell = v - static_cast<int>(v);
    toSide = std::min(toSide, std::min(inCell, 1.0 - inCell));
  }
  return cellMm_ * (static_cast<double>(steps - 1) + toSide);
}

}  // namespace pneuma
