#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/triangle_mesh.h"

namespace pneuma {

/// What a closed surface encloses while its points move to x + s u: exactly
///   V(s) = a[0] + a[1] s + a[2] s^2 + a[3] s^3, mm^3.
struct VolumePolynomial {
  std::array<double, 4> a{};

  double at(double s) const { return a[0] + s * (a[1] + s * (a[2] + s * a[3])); }

  double slope(double s) const { return a[1] + s * (2.0 * a[2] + s * 3.0 * a[3]); }
};

/// @param displacement u of every point, mm
/// @pre the surface is closed and oriented outwards, and has as many points as displacements
VolumePolynomial volumePolynomial(const TriangleMesh& surface, std::span<const Vec3> displacement);

/// What the surface encloses at s, summed over its moved triangles and not by the polynomial; the
/// same bits as the volume of a moved copy. mm^3.
double movedVolumeMm3(const TriangleMesh& surface, std::span<const Vec3> displacement, double s);

/// The s nearest to 0 with V(s) as wanted, by Newton's method to the last bits.
/// @return nothing if V does not rise all the way from 0 to there, or the volume is not above 0
std::optional<double> scaleForVolume(const VolumePolynomial& volume, double wantedMm3);

/// The smallest s of the same sign as `towards` at which a triangle turns over, that is, has an
/// area vector without a part along its first one; nothing if none ever does. Triangles lower than
/// 0.01 mm are passed over: which side they show is rounding.
std::optional<double> foldLimit(const TriangleMesh& surface, std::span<const Vec3> displacement,
                                double towards = 1.0);

}  // namespace pneuma
