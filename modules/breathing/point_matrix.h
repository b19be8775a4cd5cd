#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/progress.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// A symmetric matrix with a row for every point of a surface and entries where an edge joins two,
/// or where points otherwise act upon each other. Columns of a row rise; every entry off the
/// diagonal stands in the rows of both its points.
struct PointMatrix {
  std::vector<std::size_t> first;     ///< of each row in the two below; one more at the end
  std::vector<std::uint32_t> column;  ///< the points at the other ends of its edges
  std::vector<double> value;          ///< off the diagonal
  std::vector<double> diagonal;       ///< by point

  std::size_t size() const { return diagonal.size(); }

  /// Where the entry of row a and column b stands. @pre an edge joins them
  std::size_t entry(std::uint32_t a, std::uint32_t b) const;

  /// This times `x`.
  std::vector<double> times(std::span<const double> x) const;
};

/// The matrix of a surface's edges with nothing in it. Triangles that name a point twice add no
/// edge.
/// @pre indices lie within the points
PointMatrix edgeMatrix(const TriangleMesh& surface);

/// When to be content with a solution.
struct SolveOptions {
  double tolerance =
      1e-12;  ///< of the residual against the right side, both scaled by the diagonal
  int mostSteps = 20000;
};

/// x of A x = b by conjugate gradients on the matrix scaled to a diagonal of 1, which is Jacobi's
/// preconditioner. Sums run in a fixed order: the same bits for any number of threads.
/// @pre A is positive definite and has as many rows as b
/// @throws InvalidInput if it does not settle, as with numbers that are none; Cancelled
std::vector<double> solve(const PointMatrix& matrix, std::span<const double> rightSide,
                          const SolveOptions& options = {}, const Progress& progress = {});

}  // namespace pneuma
