#include "growth/lobe_lattice.h"

#include <algorithm>
#include <array>

#include "core/parallel.h"

namespace pneuma {
namespace {

using Cell = LatticeCell<3>;
using Words = AggregationLattice<3>::BrickWords;

constexpr int BrickSide = AggregationLattice<3>::BrickSide;
constexpr int BricksInRow = 4;  // rows of 32 voxels are asked for at once
constexpr std::uint64_t Full = ~std::uint64_t{0};

struct InsideBrick {
  Cell brick;
  Words words;
};

/// Which voxels of four bricks along x lie inside.
std::array<Words, BricksInRow> sampled(const Domain& domain, const Vec3& first, double voxelMm) {
  std::array<Words, BricksInRow> bricks{};
  const Box3 box(first.array() - voxelMm / 2.0,
                 (first + voxelMm * Vec3(31, 7, 7)).array() + voxelMm / 2.0);
  if (domain.containsBox(box)) {
    for (Words& words : bricks) words.fill(Full);
    return bricks;
  }
  for (int z = 0; z < BrickSide; ++z)
    for (int y = 0; y < BrickSide; ++y) {
      const std::uint32_t row =
          domain.insideAlongX(first + voxelMm * Vec3(0, y, z), voxelMm, 0xFFFFFFFFU);
      for (int k = 0; k < BricksInRow; ++k) {
        const std::uint64_t bits = row >> (BrickSide * k) & 0xFFU;
        bricks[static_cast<std::size_t>(k)][static_cast<std::size_t>(z)] |= bits << (8 * y);
      }
    }
  return bricks;
}

/// Whole bricks over a box with a margin of a voxel: number of the first voxel from the anchor, and
/// how many bricks.
struct Frame {
  Cell first;
  Cell bricks;

  Frame(const Box3& box, const Vec3& anchor, double voxelMm)
      : first(((box.min() - anchor) / voxelMm).array().floor().cast<int>() - 1),
        bricks(((((box.max() - anchor) / voxelMm).array().ceil().cast<int>() + 2 - first.array()) +
                BrickSide - 1) /
               BrickSide) {}
};

}  // namespace

LobeLattice::LobeLattice(const Domain& domain, const Vec3& anchor, double voxelMm,
                         std::span<const Vec3> seeds, const Progress& progress)
    : voxelMm_(voxelMm) {
  const Frame whole(domain.bounds(), anchor, voxelMm);
  std::vector<std::vector<InsideBrick>> slabs(static_cast<std::size_t>(whole.bricks.z()));
  parallelFor(slabs.size(), [&](std::size_t slab) {
    progress.throwIfStopped();
    for (int y = 0; y < whole.bricks.y(); ++y)
      for (int x = 0; x < whole.bricks.x(); x += BricksInRow) {
        const Cell brick(x, y, static_cast<int>(slab));
        const Vec3 first = anchor + voxelMm * (whole.first + brick * BrickSide).cast<double>();
        const auto bricks = sampled(domain, first, voxelMm);
        for (int k = 0; k < BricksInRow; ++k) {
          const Words& words = bricks[static_cast<std::size_t>(k)];
          if (std::ranges::all_of(words, [](std::uint64_t w) { return w == 0; })) continue;
          slabs[slab].push_back({brick + Cell(k, 0, 0), words});
        }
      }
  });

  // The box of a domain may be much larger than what is inside.
  Eigen::AlignedBox<int, 3> used;
  for (const auto& slab : slabs) {
    for (const InsideBrick& inside : slab) used.extend(inside.brick);
  }
  for (const Vec3& seed : seeds) {
    const Cell cell = ((seed - anchor) / voxelMm).array().round().matrix().cast<int>();
    // A margin, and floor division: seeds may lie before the first voxel.
    const auto brickOf = [](int number) { return (number >= 0 ? number : number - 7) / BrickSide; };
    const Cell from = cell - whole.first;
    used.extend(Cell(brickOf(from.x() - 1), brickOf(from.y() - 1), brickOf(from.z() - 1)));
    used.extend(Cell(brickOf(from.x() + 1), brickOf(from.y() + 1), brickOf(from.z() + 1)));
  }
  if (used.isEmpty()) used.extend(Cell(0, 0, 0));
  first_ = anchor + voxelMm * (whole.first + used.min() * BrickSide).cast<double>();
  cells_.emplace((used.sizes().array() + 1) * BrickSide);
  for (const auto& slab : slabs) {
    for (const InsideBrick& inside : slab) {
      cells_->setOpen(inside.brick - used.min(), inside.words);
    }
  }
}

double LobeLattice::bytesFor(const Box3& box, double voxelMm) {
  const Vec3 cells = box.sizes() / voxelMm + Vec3::Constant(2.0 * BrickSide);
  return AggregationLattice<3>::bytesFor(cells);
}

}  // namespace pneuma
