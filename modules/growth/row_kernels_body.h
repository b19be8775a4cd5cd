// The kernels of row_kernels.h; included once for every instruction set, with PNEUMA_ROW_KERNELS
// the name of the function that returns them. Plain loops over arrays, which the compiler turns
// into vector instructions. Nothing here may be shared with other translation units (hence no
// standard algorithms): the linker could keep the copy with instructions that a machine lacks.

#include "growth/row_kernels.h"

#ifdef __AVX512F__
#include <immintrin.h>
#endif

namespace pneuma::detail {
namespace {

inline std::uint32_t bitsOf(std::uint32_t v) {
#ifdef __AVX512VPOPCNTDQ__
  return static_cast<std::uint32_t>(__builtin_popcount(v));
#else
  v = v - ((v >> 1) & 0x55555555U);
  v = (v & 0x33333333U) + ((v >> 2) & 0x33333333U);
  v = (v + (v >> 4)) & 0x0F0F0F0FU;
  v = v + (v >> 8);
  return (v + (v >> 16)) & 0x3FU;
#endif
}

/// A mask of the first `count` bits, 0 <= count <= 30, from the exponent of 2^count: SSE2 has no
/// shifts by a different count in every lane.
inline std::uint32_t firstBits(float count) {
  const std::int32_t exponent = (static_cast<std::int32_t>(count) + 127) << 23;
  return static_cast<std::uint32_t>(
             static_cast<std::int32_t>(__builtin_bit_cast(float, exponent))) -
         1U;
}

inline float clamped(float value, float high) {
  const float atLeast = value > 0.0F ? value : 0.0F;
  return atLeast < high ? atLeast : high;
}

inline std::uint32_t inPlane(const RowPlane& plane, float j, float k) {
  return firstBits(clamped(plane.a + plane.b * j + plane.c * k, plane.cells)) ^ plane.flip;
}

template <WedgeKind wedge>
inline std::uint32_t inWedge(const RowPlane& p, const RowPlane& q, float j, float k) {
  if constexpr (wedge == WedgeKind::Plane) {
    return inPlane(p, j, k);
  } else if constexpr (wedge == WedgeKind::Both) {
    return inPlane(p, j, k) & inPlane(q, j, k);
  } else {
    return inPlane(p, j, k) | inPlane(q, j, k);
  }
}

template <WedgeKind wedge>
int selectIn(const RowPlaces& places, std::size_t rows, const RowPlane p, const RowPlane q,
             const RowMasks& in, RowMasks& out) {
  std::uint32_t cells = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    const std::uint32_t mask = in.bits[row] & inWedge<wedge>(p, q, places.j[row], places.k[row]);
    out.bits[row] = mask;
    cells += bitsOf(mask);
  }
  return static_cast<int>(cells);
}

template <WedgeKind wedge>
int countIn(const RowPlaces& places, std::size_t rows, const RowPlane p, const RowPlane q,
            const RowMasks& in) {
  std::uint32_t cells = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    cells += bitsOf(in.bits[row] & inWedge<wedge>(p, q, places.j[row], places.k[row]));
  }
  return static_cast<int>(cells);
}

int select(const RowPlaces& places, std::size_t rows, WedgeKind wedge, const RowPlane& p,
           const RowPlane& q, const RowMasks& in, RowMasks& out) {
  switch (wedge) {
    case WedgeKind::Plane:
      return selectIn<WedgeKind::Plane>(places, rows, p, q, in, out);
    case WedgeKind::Both:
      return selectIn<WedgeKind::Both>(places, rows, p, q, in, out);
    case WedgeKind::Either:
      return selectIn<WedgeKind::Either>(places, rows, p, q, in, out);
  }
  return 0;
}

int count(const RowPlaces& places, std::size_t rows, WedgeKind wedge, const RowPlane& p,
          const RowPlane& q, const RowMasks& in) {
  switch (wedge) {
    case WedgeKind::Plane:
      return countIn<WedgeKind::Plane>(places, rows, p, q, in);
    case WedgeKind::Both:
      return countIn<WedgeKind::Both>(places, rows, p, q, in);
    case WedgeKind::Either:
      return countIn<WedgeKind::Either>(places, rows, p, q, in);
  }
  return 0;
}

inline float lesser(float a, float b) { return a < b ? a : b; }

inline float greater(float a, float b) { return a > b ? a : b; }

void drop(const RowPlaces& places, std::size_t begin, std::size_t end, const RowCapsule& given,
          RowMasks& masks) {
  const RowCapsule c = given;
  constexpr float Far = 1e15F;
  const float r2 = c.radius * c.radius;
  const float across = greater(1.0F - c.ax * c.ax, 1e-7F);
  const float perAcross = 1.0F / across;
  const float alongX = c.ax < 0.0F ? lesser(c.ax, -1e-7F) : greater(c.ax, 1e-7F);
  const float perX = 1.0F / alongX;
  const float perStep = 1.0F / c.stepX;
  const float endX = c.length * c.ax;
  const float endY = c.length * c.ay;
  const float endZ = c.length * c.az;
  for (std::size_t row = begin; row < end; ++row) {
    const float y = c.y0 + c.stepY * places.j[row];
    const float z = c.z0 + c.stepZ * places.k[row];
    const float yz = y * y + z * z;
    const float along = y * c.ay + z * c.az;
    // The cylinder: x^2 (1 - ax^2) - 2 x ax along + yz - along^2 - r^2 <= 0, between its ends.
    const float middle = c.ax * along;
    const float inside = middle * middle - across * (yz - along * along - r2);
    const float half = __builtin_sqrtf(greater(inside, 0.0F));
    const float from = -along * perX;
    const float to = (c.length - along) * perX;
    float low = greater((middle - half) * perAcross, lesser(from, to));
    float high = lesser((middle + half) * perAcross, greater(from, to));
    const bool onCylinder = inside > 0.0F && low <= high;
    low = onCylinder ? low : Far;
    high = onCylinder ? high : -Far;
    // The balls at its ends.
    const float first = r2 - yz;
    const float firstHalf = __builtin_sqrtf(greater(first, 0.0F));
    low = lesser(low, first > 0.0F ? -firstHalf : Far);
    high = greater(high, first > 0.0F ? firstHalf : -Far);
    const float dy = y - endY;
    const float dz = z - endZ;
    const float last = r2 - (dy * dy + dz * dz);
    const float lastHalf = __builtin_sqrtf(greater(last, 0.0F));
    low = lesser(low, last > 0.0F ? endX - lastHalf : Far);
    high = greater(high, last > 0.0F ? endX + lastHalf : -Far);
    const std::uint32_t before = firstBits(clamped((low - c.x0) * perStep + 1.0F, c.cells));
    const std::uint32_t until = firstBits(clamped((high - c.x0) * perStep + 1.0F, c.cells));
    masks.bits[row] &= ~(until & ~before);
  }
}

int cells(std::size_t rows, const RowMasks& masks) {
  std::uint32_t sum = 0;
  for (std::size_t row = 0; row < rows; ++row) sum += bitsOf(masks.bits[row]);
  return static_cast<int>(sum);
}

RowMoments moments(const RowPlaces& places, std::size_t rows, const RowMasks& masks) {
  std::uint32_t cells = 0;
  std::uint32_t i = 0;
  std::uint32_t j = 0;
  std::uint32_t k = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    const std::uint32_t mask = masks.bits[row];
    const std::uint32_t bits = bitsOf(mask);
    cells += bits;
    i += bitsOf(mask & 0xAAAAAAAAU) + 2 * bitsOf(mask & 0xCCCCCCCCU) +
         4 * bitsOf(mask & 0xF0F0F0F0U) + 8 * bitsOf(mask & 0xFF00FF00U) +
         16 * bitsOf(mask & 0xFFFF0000U);
    j += bits * static_cast<std::uint32_t>(static_cast<std::int32_t>(places.j[row]));
    k += bits * static_cast<std::uint32_t>(static_cast<std::int32_t>(places.k[row]));
  }
  return {cells, i, j, k};
}

std::size_t compact(RowPlaces& places, std::size_t used, RowMasks& masks) {
  std::size_t kept = 0;
#ifdef __AVX512F__
  // Whole vectors are written: what lies behind the rows kept so far has been read.
  for (std::size_t row = 0; row < used; row += 16) {
    const auto inUse =
        static_cast<__mmask16>(used - row >= 16 ? 0xFFFFU : (1U << (used - row)) - 1U);
    const __m512i bits = _mm512_maskz_loadu_epi32(inUse, masks.bits + row);
    const __m512 j = _mm512_loadu_ps(places.j + row);
    const __m512 k = _mm512_loadu_ps(places.k + row);
    const __mmask16 held = _mm512_test_epi32_mask(bits, bits);
    _mm512_storeu_si512(masks.bits + kept, _mm512_maskz_compress_epi32(held, bits));
    _mm512_storeu_ps(places.j + kept, _mm512_maskz_compress_ps(held, j));
    _mm512_storeu_ps(places.k + kept, _mm512_maskz_compress_ps(held, k));
    kept += static_cast<std::size_t>(__builtin_popcount(held));
  }
#else
  for (std::size_t row = 0; row < used; ++row) {
    const std::uint32_t mask = masks.bits[row];
    masks.bits[kept] = mask;
    places.j[kept] = places.j[row];
    places.k[kept] = places.k[row];
    kept += mask != 0 ? 1 : 0;
  }
#endif
  return kept;
}

RowExtent extent(const RowPlaces& places, std::size_t rows, const RowMasks& masks) {
  constexpr float Far = 1e6F;
  std::uint32_t i = 0;
  float lowJ = Far;
  float highJ = -Far;
  float lowK = Far;
  float highK = -Far;
  for (std::size_t row = 0; row < rows; ++row) {
    const std::uint32_t mask = masks.bits[row];
    const float j = places.j[row];
    const float k = places.k[row];
    i |= mask;
    lowJ = lesser(lowJ, mask != 0 ? j : Far);
    highJ = greater(highJ, mask != 0 ? j : -Far);
    lowK = lesser(lowK, mask != 0 ? k : Far);
    highK = greater(highK, mask != 0 ? k : -Far);
  }
  return {i, static_cast<int>(lowJ), static_cast<int>(highJ), static_cast<int>(lowK),
          static_cast<int>(highK)};
}

}  // namespace

const RowKernels& PNEUMA_ROW_KERNELS() {
  static constexpr RowKernels Kernels = {
      PNEUMA_ROW_KERNELS_NAME, select, count, drop, cells, moments, compact, extent};
  return Kernels;
}

}  // namespace pneuma::detail
