#include "segmentation/distance_map.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/parallel.h"

namespace pneuma {
namespace {

constexpr float Infinite = std::numeric_limits<float>::infinity();

/// Columns that are handled together, so that every line of the cache is used whole.
constexpr int Block = 16;

/// The lower envelope of parabolas over one line.
class Envelope {
 public:
  Envelope(int n, float spacing, float limit2)
      : n_(n),
        spacing_(spacing),
        limit2_(limit2),
        vertex_(static_cast<std::size_t>(n)),
        height_(static_cast<std::size_t>(n)),
        value_(static_cast<std::size_t>(n)),
        from_(static_cast<std::size_t>(n) + 1) {}

  /// line[q] becomes the minimum over p of (spacing (q - p))^2 + line[p], infinite over the limit.
  void apply(float* line) {
    const float s2 = spacing_ * spacing_;
    int last = -1;
    for (int q = 0; q < n_; ++q) {
      if (line[q] == Infinite) continue;
      const float f = line[q] + s2 * static_cast<float>(q) * static_cast<float>(q);
      float start = -Infinite;
      while (last >= 0) {
        const auto top = static_cast<std::size_t>(last);
        start = (f - height_[top]) / (2.0F * s2 * static_cast<float>(q - vertex_[top]));
        if (start > from_[top]) break;
        --last;
        start = -Infinite;
      }
      ++last;
      const auto top = static_cast<std::size_t>(last);
      vertex_[top] = q;
      height_[top] = f;
      from_[top] = start;
      value_[top] = line[q];
    }
    if (last < 0) return;
    int current = 0;
    for (int q = 0; q < n_; ++q) {
      while (current < last &&
             from_[static_cast<std::size_t>(current) + 1] < static_cast<float>(q)) {
        ++current;
      }
      const auto c = static_cast<std::size_t>(current);
      const auto away = static_cast<float>(q - vertex_[c]);
      const float d = s2 * away * away + value_[c];
      line[q] = d > limit2_ ? Infinite : d;
    }
  }

 private:
  int n_;
  float spacing_;
  float limit2_;
  std::vector<int> vertex_;
  std::vector<float> height_;  ///< of the parabola's value at 0
  std::vector<float> value_;   ///< at the vertex
  std::vector<float> from_;    ///< where the parabola begins to be the lowest
};

void alongRows(std::span<const std::uint8_t> set, const std::array<int, 3>& size, float spacing,
               float limit, std::vector<float>& distances, const Progress& progress) {
  const int n = size[0];
  const auto rows = static_cast<std::size_t>(size[1]);
  parallelFor(static_cast<std::size_t>(size[2]), [&](std::size_t k) {
    progress.throwIfStopped();
    for (std::size_t j = 0; j < rows; ++j) {
      const std::size_t first = (k * rows + j) * static_cast<std::size_t>(n);
      const std::uint8_t* in = set.data() + first;
      float* out = distances.data() + first;
      float away = Infinite;
      for (int i = 0; i < n; ++i) {
        away = in[i] != 0 ? 0.0F : away + spacing;
        out[i] = away;
      }
      away = Infinite;
      for (int i = n - 1; i >= 0; --i) {
        away = in[i] != 0 ? 0.0F : away + spacing;
        const float nearest = std::min(away, out[i]);
        out[i] = nearest > limit ? Infinite : nearest * nearest;
      }
    }
  });
}

/// Envelopes along lines of `n` values `stride` apart, for all lines that start at
/// `first` .. `first + count - 1`.
void alongLines(float* first, int count, int n, std::size_t stride, Envelope& envelope,
                std::vector<float>& lines) {
  for (int from = 0; from < count; from += Block) {
    const int width = std::min(Block, count - from);
    std::array<bool, Block> finite{};
    for (int q = 0; q < n; ++q) {
      const float* source = first + from + static_cast<std::size_t>(q) * stride;
      for (int c = 0; c < width; ++c) {
        lines[static_cast<std::size_t>(c) * static_cast<std::size_t>(n) +
              static_cast<std::size_t>(q)] = source[c];
        finite[static_cast<std::size_t>(c)] |= source[c] != Infinite;
      }
    }
    bool any = false;
    for (int c = 0; c < width; ++c) {
      if (!finite[static_cast<std::size_t>(c)]) continue;
      any = true;
      envelope.apply(lines.data() + static_cast<std::size_t>(c) * static_cast<std::size_t>(n));
    }
    if (!any) continue;
    for (int q = 0; q < n; ++q) {
      float* target = first + from + static_cast<std::size_t>(q) * stride;
      for (int c = 0; c < width; ++c) {
        target[c] = lines[static_cast<std::size_t>(c) * static_cast<std::size_t>(n) +
                          static_cast<std::size_t>(q)];
      }
    }
  }
}

}  // namespace

std::vector<float> squaredDistances(std::span<const std::uint8_t> set,
                                    const std::array<int, 3>& size, const Vec3& spacing,
                                    double limitMm, const Progress& progress) {
  std::vector<float> distances(set.size());
  const auto limit = static_cast<float>(limitMm);
  const float limit2 = limit * limit;
  alongRows(set, size, static_cast<float>(spacing.x()), limit, distances, progress);
  const auto row = static_cast<std::size_t>(size[0]);
  const auto slice = row * static_cast<std::size_t>(size[1]);
  parallelFor(static_cast<std::size_t>(size[2]), [&](std::size_t k) {
    progress.throwIfStopped();
    Envelope envelope(size[1], static_cast<float>(spacing.y()), limit2);
    std::vector<float> lines(Block * static_cast<std::size_t>(size[1]));
    alongLines(distances.data() + k * slice, size[0], size[1], row, envelope, lines);
  });
  parallelFor(static_cast<std::size_t>(size[1]), [&](std::size_t j) {
    progress.throwIfStopped();
    Envelope envelope(size[2], static_cast<float>(spacing.z()), limit2);
    std::vector<float> lines(Block * static_cast<std::size_t>(size[2]));
    alongLines(distances.data() + j * row, size[0], size[2], slice, envelope, lines);
  });
  return distances;
}

}  // namespace pneuma
