#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

/// Counting cells of a region, many rows at a time.
///
/// A region's grid has up to 30 cells along x, the bits of one 32-bit mask, and a row for every
/// pair of cells along y and z. A row's masks are found in closed form from the interval of x that
/// a half-space or a capsule takes of it, so that no cell is looked at alone.
///
/// Every kernel is compiled for several instruction sets from one source. All of them round alike
/// (single precision, no fused operations, sums of integers only), so that the same tree grows on
/// every machine.
namespace pneuma {

/// Rows per step: arrays of rows are padded to a multiple of this with empty masks.
inline constexpr std::size_t RowStep = 16;

/// Rows of the largest grid, padded.
inline constexpr std::size_t MostRows = (30 * 30 + RowStep - 1) / RowStep * RowStep;

/// Positions of rows along y and z, in cells.
struct RowPlaces {
  alignas(64) float j[MostRows];
  alignas(64) float k[MostRows];
};

/// One mask for every row; bit i is the cell i along x.
struct RowMasks {
  alignas(64) std::uint32_t bits[MostRows];
};

/// A half-space as rows see it: of a row at (j, k), the first clamp(a + b j + c k, 0, cells) cells
/// are exchanged for the others by `flip` (all cells' bits) or kept (0).
struct RowPlane {
  float a = 0.0F;
  float b = 0.0F;
  float c = 0.0F;
  float cells = 0.0F;
  std::uint32_t flip = 0;
};

/// A capsule (all points within `radius` of a segment) in millimetres from the segment's start.
struct RowCapsule {
  float x0 = 0.0F;  ///< place of the cell (0, 0, 0)
  float y0 = 0.0F;
  float z0 = 0.0F;
  float stepX = 1.0F;  ///< sides of a cell
  float stepY = 1.0F;
  float stepZ = 1.0F;
  float ax = 0.0F;  ///< unit vector along the segment
  float ay = 0.0F;
  float az = 0.0F;
  float length = 0.0F;
  float radius = 0.0F;
  float cells = 0.0F;
};

/// Cells of masks: how many, and the sums of their i, j, k.
struct RowMoments {
  std::int64_t count = 0;
  std::int64_t i = 0;
  std::int64_t j = 0;
  std::int64_t k = 0;
};

/// The lowest and highest i, j, k of masks that are not all empty.
struct RowExtent {
  std::uint32_t i = 0;  ///< union of all masks
  int lowJ = 0;
  int highJ = 0;
  int lowK = 0;
  int highK = 0;
};

/// What rows lie in: one half-space, both, or either of two.
enum class WedgeKind { Plane, Both, Either };

/// The kernels for one instruction set. `rows` is a multiple of RowStep everywhere.
struct RowKernels {
  std::string_view name;
  /// out = in & wedge; returns the number of cells. `in` and `out` may be the same.
  int (*select)(const RowPlaces& places, std::size_t rows, WedgeKind wedge, const RowPlane& p,
                const RowPlane& q, const RowMasks& in, RowMasks& out);
  /// Number of cells of in & wedge.
  int (*count)(const RowPlaces& places, std::size_t rows, WedgeKind wedge, const RowPlane& p,
               const RowPlane& q, const RowMasks& in);
  /// masks &= ~capsule, for the rows from `begin` to `end`.
  void (*drop)(const RowPlaces& places, std::size_t begin, std::size_t end,
               const RowCapsule& capsule, RowMasks& masks);
  /// Number of cells.
  int (*cells)(std::size_t rows, const RowMasks& masks);
  RowMoments (*moments)(const RowPlaces& places, std::size_t rows, const RowMasks& masks);
  /// Leaves out the rows without a cell, of the first `used`, and returns how many are left.
  std::size_t (*compact)(RowPlaces& places, std::size_t used, RowMasks& masks);
  RowExtent (*extent)(const RowPlaces& places, std::size_t rows, const RowMasks& masks);
};

enum class InstructionSet { Portable, Avx2, Avx512 };

/// Can this machine run it, and was it compiled in?
bool available(InstructionSet set);

/// The kernels of an instruction set. @pre available(set)
const RowKernels& rowKernels(InstructionSet set);

/// The kernels of the widest available set, unless a RowKernelChoice says otherwise.
const RowKernels& rowKernels();

/// While it lives, rowKernels() gives the kernels of `set`: for tests and benchmarks. Not to be
/// made while something grows.
class RowKernelChoice {
 public:
  explicit RowKernelChoice(InstructionSet set);
  ~RowKernelChoice();
  RowKernelChoice(const RowKernelChoice&) = delete;
  RowKernelChoice& operator=(const RowKernelChoice&) = delete;

 private:
  const RowKernels* before_;
};

}  // namespace pneuma
