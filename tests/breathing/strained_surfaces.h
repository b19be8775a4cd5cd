#pragma once

#include <span>
#include <vector>

#include "core/triangle_mesh.h"

/// Surfaces that force is shared on.
namespace pneuma::testing {

/// An ellipsoid of about the size of a lung, 1.6 l. @param subdivisions 3: 258 points, 4: 1026
TriangleMesh regularLung(int subdivisions = 4);

/// The same points with a third of the edges flipped: points of 4 to 9 neighbours.
TriangleMesh irregularLung(int subdivisions = 4);

/// S of the published curve, from the diaphragm.
std::vector<double> publishedStrainOf(const TriangleMesh& surface);

/// Pearson's correlation.
double correlation(std::span<const double> a, std::span<const double> b);

}  // namespace pneuma::testing
