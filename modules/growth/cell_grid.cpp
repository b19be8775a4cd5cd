#include "growth/cell_grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

namespace pneuma {
namespace {

/// How the box of a grid lies to the half-space of a wedge.
enum class Lies { Inside, Outside, Across };

Lies liesTo(const Box3& box, const Vec3& point, const Vec3& normal) {
  const double middle = normal.dot(box.center() - point);
  const double reach = normal.cwiseAbs().dot(box.sizes()) / 2.0;
  return middle >= reach ? Lies::Inside : middle < -reach ? Lies::Outside : Lies::Across;
}

/// May the box touch a capsule? No if some axis of the box, or the way between their centres,
/// keeps them apart.
bool touches(const Box3& box, const Capsule& capsule) {
  const Vec3 middle = (capsule.start + capsule.end) / 2.0;
  const Vec3 halfWay = (capsule.end - capsule.start) / 2.0;
  const Vec3 halfBox = box.sizes() / 2.0;
  const Vec3 apart = middle - box.center();
  const Vec3 reach = halfWay.cwiseAbs() + halfBox + Vec3::Constant(capsule.radiusMm);
  if ((apart.cwiseAbs().array() > reach.array()).any()) return false;
  const double distance = apart.norm();
  return distance * distance <=
         std::abs(halfWay.dot(apart)) + halfBox.dot(apart.cwiseAbs()) + capsule.radiusMm * distance;
}

/// Tiles of rows along y and z in which the organ is asked for.
constexpr int TilesAcross = 4;

float toFloat(double value) { return static_cast<float>(value); }

}  // namespace

CellGrid::CellGrid(int cells)
    : cells_(cells), all_((1U << static_cast<unsigned>(cells)) - 1U), kernels_(rowKernels()) {
  for (std::size_t row = 0; row < MostRows; ++row) {
    const int index = static_cast<int>(row);
    template_.j[row] = static_cast<float>(index % cells);
    template_.k[row] = static_cast<float>(index / cells);
  }
}

int CellGrid::lay(Region& region) {
  box_ = region.box;
  step_ = (box_.sizes() / cells_).cwiseMax(1e-9);
  first_ = box_.min() + 0.5 * step_;
  const auto rows = static_cast<std::size_t>(cells_) * static_cast<std::size_t>(cells_);
  rows_ = (rows + RowStep - 1) / RowStep * RowStep;
  places_ = template_;
  std::fill_n(masks_.bits, rows, all_);
  std::fill(masks_.bits + rows, masks_.bits + rows_, 0U);
  used_ = rows;
  findPlanes();
  keepWalls(region);
  dropAncestors(region);
  keepOrgan(region);
  compact();
  count_ = kernels_.cells(rows_, masks_);
  return count_;
}

RowPlane CellGrid::planeOf(const Vec3& point, const Vec3& normal) const {
  const double depth = normal.dot(first_ - point);
  Vec3 slope = normal.cwiseProduct(step_);
  // A plane along the rows takes them whole: from so steep a slope follows the same.
  const double least = 1e-6 * slope.cwiseAbs().maxCoeff();
  if (std::abs(slope.x()) < least) slope.x() = slope.x() < 0.0 ? -least : least;
  const double scale = -1.0 / slope.x();
  return {.a = toFloat(depth * scale + 1.0),
          .b = toFloat(slope.y() * scale),
          .c = toFloat(slope.z() * scale),
          .cells = static_cast<float>(cells_),
          .flip = slope.x() > 0.0 ? all_ : 0U};
}

void CellGrid::keepWalls(Region& region) {
  // The youngest walls cut most: after two of them many rows are empty.
  constexpr int ManyWalls = 2;
  int cutting = 0;
  std::size_t first = region.cuts.size();
  for (std::size_t i = region.cuts.size(); i-- > 0;) {
    if (!keepWall(region.cuts[i])) continue;
    --first;
    if (first != i) region.cuts[first] = region.cuts[i];
    if (++cutting == ManyWalls) compact();
  }
  region.cuts.erase(region.cuts.begin(), region.cuts.begin() + static_cast<std::ptrdiff_t>(first));
}

/// Keeps the cells in `wedge`; false if the whole box lies in it.
bool CellGrid::keepWall(const Wedge& wedge) {
  const bool two = wedge.kind != WedgeKind::Plane;
  const bool either = wedge.kind == WedgeKind::Either;
  const Lies first = liesTo(box_, wedge.point, wedge.first);
  const Lies second = two ? liesTo(box_, wedge.point, wedge.second) : first;
  if (either ? first == Lies::Inside || second == Lies::Inside
             : first == Lies::Inside && second == Lies::Inside) {
    return false;
  }
  // A half-space that decides nothing in this box leaves the other.
  const Lies idle = either ? Lies::Outside : Lies::Inside;
  if (!two || second == idle) {
    const RowPlane p = planeOf(wedge.point, wedge.first);
    kernels_.select(places_, rows_, WedgeKind::Plane, p, p, masks_, masks_);
  } else if (first == idle) {
    const RowPlane q = planeOf(wedge.point, wedge.second);
    kernels_.select(places_, rows_, WedgeKind::Plane, q, q, masks_, masks_);
  } else {
    kernels_.select(places_, rows_, wedge.kind, planeOf(wedge.point, wedge.first),
                    planeOf(wedge.point, wedge.second), masks_, masks_);
  }
  return true;
}

void CellGrid::dropAncestors(Region& region) {
  std::erase_if(region.ancestors, [&](const Capsule& capsule) { return !touches(box_, capsule); });
  for (const Capsule& capsule : region.ancestors) {
    const Vec3 way = capsule.end - capsule.start;
    const double length = way.norm();
    const Vec3 along = length > 0.0 ? Vec3(way / length) : Vec3(Vec3::UnitX());
    const Vec3 place = first_ - capsule.start;
    const double lowZ = std::min(0.0, way.z()) - capsule.radiusMm - place.z();
    const double highZ = std::max(0.0, way.z()) + capsule.radiusMm - place.z();
    const auto [begin, end] = rowsBetween(lowZ / step_.z(), highZ / step_.z());
    if (begin == end) continue;
    kernels_.drop(places_, begin, end,
                  {.x0 = toFloat(place.x()),
                   .y0 = toFloat(place.y()),
                   .z0 = toFloat(place.z()),
                   .stepX = toFloat(step_.x()),
                   .stepY = toFloat(step_.y()),
                   .stepZ = toFloat(step_.z()),
                   .ax = toFloat(along.x()),
                   .ay = toFloat(along.y()),
                   .az = toFloat(along.z()),
                   .length = toFloat(length),
                   .radius = toFloat(capsule.radiusMm),
                   .cells = static_cast<float>(cells_)},
                  masks_);
  }
}

void CellGrid::keepOrgan(Region& region) {
  if (!region.organCuts) return;
  if (region.organ->containsBox(box_)) {
    region.organCuts = false;
    return;
  }
  // Tiles of rows that lie wholly inside need not be asked row by row.
  const int tile = (cells_ + TilesAcross - 1) / TilesAcross;
  std::array<bool, TilesAcross * TilesAcross> inside{};
  for (int k = 0; k * tile < cells_; ++k) {
    for (int j = 0; j * tile < cells_; ++j) {
      const Vec3 low = box_.min() + step_.cwiseProduct(Vec3(0.0, j * tile, k * tile));
      const Vec3 size = step_.cwiseProduct(Vec3(cells_, tile, tile));
      inside[static_cast<std::size_t>(k * TilesAcross + j)] =
          region.organ->containsBox({low, low + size});
    }
  }
  std::array<std::size_t, 30> tileOf{};
  for (int i = 0; i < cells_; ++i) {
    tileOf[static_cast<std::size_t>(i)] = static_cast<std::size_t>(i / tile);
  }
  for (std::size_t row = 0; row < used_; ++row) {
    if (masks_.bits[row] == 0) continue;
    const auto j = static_cast<std::size_t>(places_.j[row]);
    const auto k = static_cast<std::size_t>(places_.k[row]);
    if (inside[tileOf[k] * TilesAcross + tileOf[j]]) continue;
    const Vec3 start =
        first_ + Vec3(0.0, step_.y() * static_cast<double>(j), step_.z() * static_cast<double>(k));
    masks_.bits[row] = region.organ->insideAlongX(start, step_.x(), masks_.bits[row]);
  }
}

/// The rows, in whole steps, that may lie from `low` to `high` along z, in cells. As they were when
/// they were compacted last.
std::pair<std::size_t, std::size_t> CellGrid::rowsBetween(double low, double high) const {
  if (high < 0.0 || low > cells_ - 1) return {0, 0};
  const auto first = static_cast<std::size_t>(std::max(0.0, std::ceil(low)));
  const auto last = static_cast<std::size_t>(std::min(std::floor(high), cells_ - 1.0));
  return {planeBegins_[first] / RowStep * RowStep,
          (planeBegins_[last + 1] + RowStep - 1) / RowStep * RowStep};
}

/// Leaves out the rows without a cell.
void CellGrid::compact() {
  const std::size_t kept = kernels_.compact(places_, used_, masks_);
  used_ = kept;
  findPlanes();
  rows_ = (kept + RowStep - 1) / RowStep * RowStep;
  std::fill(masks_.bits + kept, masks_.bits + rows_, 0U);
}

/// Rows are laid plane after plane: where does each begin?
void CellGrid::findPlanes() {
  std::size_t row = 0;
  for (std::size_t k = 0; k <= static_cast<std::size_t>(cells_); ++k) {
    while (row < used_ && places_.k[row] < static_cast<float>(k)) ++row;
    planeBegins_[k] = row;
  }
}

int CellGrid::countAll(const RowMasks& cells) const { return kernels_.cells(rows_, cells); }

int CellGrid::countIn(const Wedge& wedge) const { return countIn(wedge, masks_); }

int CellGrid::countIn(const Wedge& wedge, const RowMasks& from) const {
  const RowPlane p = planeOf(wedge.point, wedge.first);
  const RowPlane q = wedge.kind == WedgeKind::Plane ? p : planeOf(wedge.point, wedge.second);
  return kernels_.count(places_, rows_, wedge.kind, p, q, from);
}

int CellGrid::select(const Wedge& wedge, const RowMasks& from, RowMasks& out) const {
  const RowPlane p = planeOf(wedge.point, wedge.first);
  const RowPlane q = wedge.kind == WedgeKind::Plane ? p : planeOf(wedge.point, wedge.second);
  return kernels_.select(places_, rows_, wedge.kind, p, q, from, out);
}

void CellGrid::selectRest(const RowMasks& taken, RowMasks& out) const {
  for (std::size_t row = 0; row < rows_; ++row) out.bits[row] = masks_.bits[row] & ~taken.bits[row];
}

Box3 CellGrid::boxOf(const RowMasks& cells) const {
  const RowExtent extent = kernels_.extent(places_, rows_, cells);
  const Vec3 low(std::countr_zero(extent.i), extent.lowJ, extent.lowK);
  const Vec3 high(31 - std::countl_zero(extent.i), extent.highJ, extent.highK);
  const Box3 wider(box_.min() + step_.cwiseProduct(low - Vec3::Ones()),
                   box_.min() + step_.cwiseProduct(high + 2.0 * Vec3::Ones()));
  return wider.intersection(box_);
}

Vec3 CellGrid::centroidOf(const RowMasks& cells) const {
  const RowMoments sums = kernels_.moments(places_, rows_, cells);
  const Vec3 mean =
      Vec3(static_cast<double>(sums.i), static_cast<double>(sums.j), static_cast<double>(sums.k)) /
      static_cast<double>(sums.count);
  return first_ + step_.cwiseProduct(mean);
}

Vec3 CellGrid::farthestCentre(const RowMasks& cells, const Vec3& from) const {
  Vec3 farthest = from;
  double distance = -1.0;
  for (std::size_t row = 0; row < used_; ++row) {
    const std::uint32_t mask = cells.bits[row];
    if (mask == 0) continue;
    // In a row one of the outermost is farthest.
    for (const int i : {std::countr_zero(mask), 31 - std::countl_zero(mask)}) {
      const Vec3 centre = first_ + step_.cwiseProduct(Vec3(i, static_cast<double>(places_.j[row]),
                                                           static_cast<double>(places_.k[row])));
      const double squared = (centre - from).squaredNorm();
      if (squared <= distance) continue;
      distance = squared;
      farthest = centre;
    }
  }
  return farthest;
}

std::optional<Vec3> CellGrid::nearestCentre(const RowMasks& cells, const Vec3& from,
                                            const std::function<bool(const Vec3&)>& accepts) const {
  std::vector<std::pair<double, Vec3>> centres;
  for (std::size_t row = 0; row < rows_; ++row) {
    for (std::uint32_t left = cells.bits[row]; left != 0; left &= left - 1) {
      const Vec3 centre = first_ + step_.cwiseProduct(Vec3(std::countr_zero(left),
                                                           static_cast<double>(places_.j[row]),
                                                           static_cast<double>(places_.k[row])));
      centres.emplace_back((centre - from).squaredNorm(), centre);
    }
  }
  std::ranges::stable_sort(centres, {}, &std::pair<double, Vec3>::first);
  for (const auto& [distance, centre] : centres) {
    if (accepts(centre)) return centre;
  }
  return std::nullopt;
}

}  // namespace pneuma
