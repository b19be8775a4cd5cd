#pragma once

#include <cstdint>
#include <span>

#include "core/math.h"

namespace pneuma {

/// How an aggregate's number of particles N grows with its radius of gyration Rg while it grows:
/// the slope of ln N against ln Rg by least squares, over numbers from a twentieth of all up. For
/// clusters in free space; inside walls it means nothing.
/// @param points in order of arrival
/// @throws InvalidInput for fewer than 100 points
double gyrationDimension(std::span<const Vec3> points);

/// Slope of the correlation integral C(r), the share of pairs nearer than r, between two radii
/// (Grassberger and Procaccia 1983), in steps of an eighth of an octave. Pairs of a thousand points
/// drawn at random with at most a hundred thousand others.
/// @throws InvalidInput for fewer than 100 points, or radii between which there are no pairs
double correlationDimension(std::span<const Vec3> points, double fromMm, double toMm,
                            std::uint64_t seed);

}  // namespace pneuma
