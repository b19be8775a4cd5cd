#pragma once

#include <array>
#include <string_view>

#include "anatomy/lobe.h"
#include "core/math.h"

namespace pneuma {

/// How a person lies, sits or hangs while breathing.
enum class Posture { Supine, Prone, Upright, LeftLateral, RightLateral, HeadDown };

constexpr auto choices(Posture) {
  return std::array<std::string_view, 6>{"supine",       "prone",         "upright",
                                         "left-lateral", "right-lateral", "head-down"};
}

/// Where gravity points to in the body's frame: X to the left, Y to the front, Z to the feet; of
/// length 1. On the left side it points to the left.
Vec3 gravityOf(Posture posture);

/// The constants c1 to c6 of Santhanam 2008, (15) to (17), two for each axis. The paper's Table I
/// is not in print; these are reasoned, not measured: up and down to front and back to sideways
/// about 10 : 4 : 2 at the base, and most of the motion near it.
struct DirectionConstants {
  std::array<double, 3> factor = {0.20, 0.40, 1.00};  ///< c1, c3, c5; only their ratios matter
  std::array<double, 3> power = {1.0, 1.0, 1.3};      ///< c2, c4, c6, at least 0.05
};

/// Where a point of a lung moves to while it fills (15)-(17): d_k = factor_k q_k^power_k, of length
/// 1; nothing at the corner where all three are 0. The axis along which gravity presses the lung
/// against the far wall begins there instead: d_k = -factor_k (1 - q_k)^power_k, and halfway there
/// both are blended: the Y axis in prone, the X axis of the lower lung on the side.
/// @param share of the lung's box at the point, see LungFrame; what is outside of it is taken for
/// its border
/// @param gravity of length 1, in the body's frame
/// @return in the lung's own frame (LungFrame::toLps)
Vec3 motionDirection(const Vec3& share, Side side, const Vec3& gravity,
                     const DirectionConstants& constants = {});

/// The constants of the force law (18) in any posture. Reasoned, not measured.
struct ForceConstants {
  double base = 0.05;       ///< everywhere, so that no wall is perfectly rigid
  double weight = 0.90;     ///< what gravity adds from the wall it presses against to the other
  double diaphragm = 0.05;  ///< what the base has before the apex
};

/// (18) as four coefficients of 1, q_X, q_Y and q_Z:
///   f = base + weight [(-g_Y)+ q_Y + (g_Y)+ (1 - q_Y) + (g_Z)+ q_Z + (-s g_X)+ q_X
///       + (s g_X)+ (1 - q_X)] + diaphragm q_Z,
/// s = 1 for the left lung and -1 for the right one. In supine the paper has one large constant,
/// the one of q_Y.
/// @param gravity of length 1, in the body's frame
std::array<double, 4> forceCoefficients(Side side, const Vec3& gravity,
                                        const ForceConstants& constants = {});

/// The sum that coefficients of 1, q_X, q_Y and q_Z stand for.
double forceAt(const std::array<double, 4>& coefficients, const Vec3& share);

/// What the paper keeps for each vertex to turn a lung live: the four real spherical harmonics Y00,
/// Y1-1 (along Y), Y10 (along Z) and Y11 (along X) of a force alpha + beta . g that is affine in
/// the direction of gravity. Bands beyond the second are 0 for such a force; the solution of a
/// linear operator for these four is the four of its solution.
std::array<double, 4> harmonicsOf(double alpha, const Vec3& beta);

/// The sum of spherical harmonics for a direction of gravity of length 1.
double harmonicSum(const std::array<double, 4>& harmonics, const Vec3& gravity);

}  // namespace pneuma
