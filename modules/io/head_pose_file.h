#pragma once

#include <filesystem>
#include <vector>

#include "core/math.h"

namespace pneuma {

/// Where a head was, and which way it looked, at a moment: six degrees of freedom.
struct HeadPose {
  double seconds = 0.0;
  Vec3 position = Vec3::Zero();  ///< midway between the eyes, LPS, mm
  /// Of unit length; turns the head's axes (x to its right, y up, z backwards, so that it looks
  /// along -z, as in OpenXR and OpenGL) into LPS.
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/// A longer record is refused, as replaying takes as long as the record; with times in
/// milliseconds most are longer.
inline constexpr double LongestPoseRecordSeconds = 3600.0;
inline constexpr std::size_t MostHeadPoses = 1'000'000;
inline constexpr double FarthestHeadMm = 100'000.0;  ///< from the origin, along each axis

/// Recorded head poses out of a table (CSV) with columns time_s; x_mm, y_mm, z_mm; qw, qx, qy, qz.
/// Times rise from row to row and may start anywhere. A quaternion off unit length by up to 1 %, as
/// rounding leaves it, is taken as one of unit length.
/// @returns at least one
/// @throws InputMissing; InvalidInput naming the line for what readNumberTable() refuses, times
/// that do not rise, no unit quaternion, a place too far away, too many or too long, none
std::vector<HeadPose> readHeadPoses(const std::filesystem::path& path);

}  // namespace pneuma
