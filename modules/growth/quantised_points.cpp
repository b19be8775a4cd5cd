#include "growth/quantised_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace pneuma {
namespace {

// Normals are kept in 1/32767; a plane is then off by 3e-5 rad at most. With unit normals the dot
// product stays below 32767^2 * sqrt(3) < 2^31.
constexpr double NormalScale = 32767.0;

bool inFront(const QuantisedPoint& q, const QuantisedPlane& plane) {
  // Unsigned, because partial sums may wrap round; the whole sum never does.
  const auto product = [](std::int16_t a, std::int16_t b) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(a) * static_cast<std::int32_t>(b));
  };
  const std::uint32_t dot = product(q.x, plane.x) + product(q.y, plane.y) + product(q.z, plane.z);
  return static_cast<std::int32_t>(dot) < plane.limit;
}

std::int16_t scaled(double component) {
  // A cast after a shift to positive numbers rounds as std::lround does, several times faster.
  return static_cast<std::int16_t>(static_cast<std::int32_t>(NormalScale * component + 32768.5) -
                                   32768);
}

}  // namespace

QuantisedPlane::QuantisedPlane(const Vec3& normal, const Vec3& through)
    : x(scaled(normal.x())), y(scaled(normal.y())), z(scaled(normal.z())) {
  const double dot = x * through.x() + y * through.y() + z * through.z();
  limit = static_cast<std::int32_t>(std::clamp(std::ceil(dot), -2147483647.0, 2147483647.0));
}

QuantisedSum sumOf(const QuantisedPoint* points, std::size_t count) {
  QuantisedSum sum;
  std::size_t i = 0;
#if defined(__SSE2__)
  constexpr std::size_t Block = 65536;  // 32-bit sums cannot overflow within it
  while (i + 2 <= count) {
    __m128i sums = _mm_setzero_si128();
    const std::size_t end = std::min(count & ~std::size_t{1}, i + Block);
    for (; i < end; i += 2) {
      const __m128i pair = _mm_loadu_si128(reinterpret_cast<const __m128i*>(points + i));
      const __m128i sign = _mm_srai_epi16(pair, 15);
      sums = _mm_add_epi32(sums, _mm_unpacklo_epi16(pair, sign));
      sums = _mm_add_epi32(sums, _mm_unpackhi_epi16(pair, sign));
    }
    std::array<std::int32_t, 4> lanes{};
    _mm_storeu_si128(reinterpret_cast<__m128i*>(lanes.data()), sums);
    sum.x += lanes[0];
    sum.y += lanes[1];
    sum.z += lanes[2];
  }
#endif
  for (; i < count; ++i) {
    sum.x += points[i].x;
    sum.y += points[i].y;
    sum.z += points[i].z;
  }
  return sum;
}

std::size_t partition(QuantisedPoint* points, std::size_t count, const QuantisedPlane& plane,
                      QuantisedPoint* scratch) {
  // Every point is written to both places and only one of the two ends moves on: no branch that
  // depends on the data, because half of those would be guessed wrongly.
  std::size_t low = 0;
  std::size_t high = 0;
  std::size_t i = 0;
#if defined(__SSE2__)
  const __m128i normal = _mm_set_epi16(0, plane.z, plane.y, plane.x, 0, plane.z, plane.y, plane.x);
  const __m128i limit = _mm_set1_epi32(plane.limit);
  for (; i + 2 <= count; i += 2) {
    const __m128i pair = _mm_loadu_si128(reinterpret_cast<const __m128i*>(points + i));
    const __m128i products = _mm_madd_epi16(pair, normal);  // x x' + y y', z z', twice
    const __m128i dots =
        _mm_add_epi32(products, _mm_shuffle_epi32(products, _MM_SHUFFLE(2, 3, 0, 1)));
    const auto front =
        static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(_mm_cmpgt_epi32(limit, dots))));
    const unsigned first = front & 1U;
    const unsigned second = (front >> 2U) & 1U;
    const __m128i next = _mm_unpackhi_epi64(pair, pair);
    _mm_storel_epi64(reinterpret_cast<__m128i*>(points + low), pair);
    _mm_storel_epi64(reinterpret_cast<__m128i*>(scratch + high), pair);
    low += first;
    high += 1U - first;
    _mm_storel_epi64(reinterpret_cast<__m128i*>(points + low), next);
    _mm_storel_epi64(reinterpret_cast<__m128i*>(scratch + high), next);
    low += second;
    high += 1U - second;
  }
#endif
  for (; i < count; ++i) {
    const QuantisedPoint q = points[i];
    const bool front = inFront(q, plane);
    points[low] = q;
    scratch[high] = q;
    low += front ? 1U : 0U;
    high += front ? 0U : 1U;
  }
  std::memcpy(static_cast<void*>(points + low), scratch, high * sizeof(QuantisedPoint));
  return low;
}

}  // namespace pneuma
