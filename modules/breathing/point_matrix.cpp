#include "breathing/point_matrix.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "core/parallel.h"

namespace pneuma {
namespace {

constexpr std::size_t BlockRows = 8192;

/// Calls body(begin, end) for blocks of rows on all threads and sums what it returns in the order
/// of the blocks.
template <class Body>
double blockSum(std::size_t rows, const Body& body) {
  std::vector<double> sums((rows + BlockRows - 1) / BlockRows);
  parallelFor(sums.size(), [&](std::size_t block) {
    sums[block] = body(block * BlockRows, std::min(rows, (block + 1) * BlockRows));
  });
  double sum = 0.0;
  for (const double part : sums) sum += part;
  return sum;
}

}  // namespace

std::size_t PointMatrix::entry(std::uint32_t a, std::uint32_t b) const {
  std::size_t at = first[a];
  while (column[at] != b) ++at;
  return at;
}

std::vector<double> PointMatrix::times(std::span<const double> x) const {
  std::vector<double> product(size());
  blockSum(size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      double sum = diagonal[row] * x[row];
      for (std::size_t at = first[row]; at < first[row + 1]; ++at) sum += value[at] * x[column[at]];
      product[row] = sum;
    }
    return 0.0;
  });
  return product;
}

PointMatrix edgeMatrix(const TriangleMesh& surface) {
  const std::size_t rows = surface.points.size();
  // Both ends of a triangle's edges at each corner, then each once.
  std::vector<std::size_t> begin(rows + 1, 0);
  const auto isFlat = [](const std::array<std::uint32_t, 3>& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  };
  for (const auto& triangle : surface.triangles) {
    if (isFlat(triangle)) continue;
    for (const std::uint32_t corner : triangle) begin[corner + 1] += 2;
  }
  for (std::size_t row = 0; row < rows; ++row) begin[row + 1] += begin[row];
  std::vector<std::uint32_t> ends(begin[rows]);
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (const auto& triangle : surface.triangles) {
    if (isFlat(triangle)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      ends[next[triangle[k]]++] = triangle[(k + 1) % 3];
      ends[next[triangle[k]]++] = triangle[(k + 2) % 3];
    }
  }
  PointMatrix matrix;
  matrix.first.assign(rows + 1, 0);
  parallelFor((rows + BlockRows - 1) / BlockRows, [&](std::size_t block) {
    for (std::size_t row = block * BlockRows; row < std::min(rows, (block + 1) * BlockRows);
         ++row) {
      const auto from = ends.begin() + static_cast<std::ptrdiff_t>(begin[row]);
      const auto to = ends.begin() + static_cast<std::ptrdiff_t>(begin[row + 1]);
      std::sort(from, to);
      matrix.first[row + 1] = static_cast<std::size_t>(std::unique(from, to) - from);
    }
  });
  for (std::size_t row = 0; row < rows; ++row) matrix.first[row + 1] += matrix.first[row];
  matrix.column.resize(matrix.first[rows]);
  for (std::size_t row = 0; row < rows; ++row) {
    std::copy_n(ends.begin() + static_cast<std::ptrdiff_t>(begin[row]),
                matrix.first[row + 1] - matrix.first[row],
                matrix.column.begin() + static_cast<std::ptrdiff_t>(matrix.first[row]));
  }
  matrix.value.assign(matrix.column.size(), 0.0);
  matrix.diagonal.assign(rows, 0.0);
  return matrix;
}

std::vector<double> solve(const PointMatrix& matrix, std::span<const double> rightSide,
                          const SolveOptions& options, const Progress& progress) {
  const std::size_t rows = matrix.size();
  const std::vector<double>& diagonal = matrix.diagonal;
  // r, z = r / diagonal and p of the preconditioned method; z is not kept but formed twice.
  std::vector<double> x(rows, 0.0);
  std::vector<double> residual(rightSide.begin(), rightSide.end());
  std::vector<double> direction(rows);
  std::vector<double> product(rows);
  double left = blockSum(rows, [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t row = begin; row < end; ++row) {
      direction[row] = residual[row] / diagonal[row];
      sum += residual[row] * direction[row];
    }
    return sum;
  });
  const double enough = options.tolerance * options.tolerance * left;
  if (left == 0.0) return x;
  for (int step = 0; step < options.mostSteps && std::isfinite(left); ++step) {
    const double curvature = blockSum(rows, [&](std::size_t begin, std::size_t end) {
      double sum = 0.0;
      for (std::size_t row = begin; row < end; ++row) {
        double of = diagonal[row] * direction[row];
        for (std::size_t at = matrix.first[row]; at < matrix.first[row + 1]; ++at) {
          of += matrix.value[at] * direction[matrix.column[at]];
        }
        product[row] = of;
        sum += of * direction[row];
      }
      return sum;
    });
    const double along = left / curvature;
    const double now = blockSum(rows, [&](std::size_t begin, std::size_t end) {
      double sum = 0.0;
      for (std::size_t row = begin; row < end; ++row) {
        x[row] += along * direction[row];
        residual[row] -= along * product[row];
        sum += residual[row] * residual[row] / diagonal[row];
      }
      return sum;
    });
    if (now <= enough) return x;
    const double keep = now / left;
    left = now;
    blockSum(rows, [&](std::size_t begin, std::size_t end) {
      for (std::size_t row = begin; row < end; ++row) {
        direction[row] = residual[row] / diagonal[row] + keep * direction[row];
      }
      return 0.0;
    });
    progress.report(static_cast<double>(step) / (step + 50.0));
  }
  throw InvalidInput("the forces of the surface do not settle after " +
                     std::to_string(options.mostSteps) +
                     " steps; examine the surface with 'pneuma info'");
}

}  // namespace pneuma
