#pragma once

#include "core/domain.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// A closed surface of a region that is known only by "inside?", for pictures: samples it on a
/// lattice of `cellMm`, smooths that over two cells and contours it. Edges come out rounded.
TriangleMesh surfaceOf(const Domain& domain, double cellMm);

}  // namespace pneuma
