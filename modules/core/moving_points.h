#pragma once

#include <span>

namespace pneuma {

/// Motion played back: what moves along straight lines, x + s u (Santhanam 2008, section V). On all
/// threads, as fast as memory is.

/// moved = rest + s * slope, number by number. The spans have one length.
void moveAlong(std::span<const float> rest, std::span<const float> slope, float s,
               std::span<float> moved);
void moveAlong(std::span<const double> rest, std::span<const double> slope, double s,
               std::span<double> moved);

/// Vectors of three numbers, normal + s * slope, made as long as 1; what has no length stays 0.
/// The spans have one length, three times as many as vectors.
void turnAlong(std::span<const float> normals, std::span<const float> slope, float s,
               std::span<float> turned);

}  // namespace pneuma
