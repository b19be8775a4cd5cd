#include "io/head_pose_file.h"

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <system_error>

#include "core/error.h"
#include "io/detail/text_fields.h"
#include "io/number_table.h"

namespace pneuma {
namespace {

constexpr double UnitTolerance = 0.01;
constexpr std::uintmax_t LargestPoseFile = 512ULL << 20;  // bytes; MostHeadPoses fit twice

/// Of a row, in the order of the columns asked for.
HeadPose poseOf(const NumberTable& table, std::size_t row) {
  const std::string where = table.name + ", line " + std::to_string(table.lines[row]);
  const auto number = [&](std::size_t column) { return table.values[column][row]; };
  HeadPose pose;
  pose.seconds = number(0);
  if (row > 0 && !(pose.seconds > table.values[0][row - 1])) {
    throw InvalidInput(where + ": the time " + numberText(pose.seconds) +
                       " s does not come after that of the row before; sort the poses by time and "
                       "delete doubles");
  }
  if (pose.seconds - table.values[0][0] > LongestPoseRecordSeconds) {
    throw InvalidInput(where + ": this is " +
                       numberText(std::round(pose.seconds - table.values[0][0])) +
                       " s after the first pose, and records of up to an hour are replayed; are "
                       "the times in seconds?");
  }
  pose.position = Vec3(number(1), number(2), number(3));
  if (pose.position.cwiseAbs().maxCoeff() > FarthestHeadMm) {
    throw InvalidInput(where + ": the head is at " + pointText(pose.position) +
                       ", more than 100 m away; are the places in mm?");
  }
  const Eigen::Quaterniond q(number(4), number(5), number(6), number(7));
  const double norm = q.norm();
  if (!(std::abs(norm - 1.0) <= UnitTolerance)) {
    throw InvalidInput(where + ": the quaternion (qw, qx, qy, qz) has length " +
                       (std::isfinite(norm) ? numberText(norm) : std::string("infinity")) +
                       ", and an orientation has length 1");
  }
  pose.orientation = q.normalized();
  return pose;
}

}  // namespace

std::vector<HeadPose> readHeadPoses(const std::filesystem::path& path) {
  std::error_code error;
  if (const auto bytes = std::filesystem::file_size(path, error);
      !error && bytes > LargestPoseFile) {
    throw InvalidInput(quoted(path) +
                       " is larger than 512 MB, too large for a table of head "
                       "poses; give a part of it");
  }
  using ColumnNames = std::vector<std::string_view>;
  const std::array<ColumnNames, 8> wanted = {
      ColumnNames{"time_s"}, {"x_mm"}, {"y_mm"}, {"z_mm"}, {"qw"}, {"qx"}, {"qy"}, {"qz"}};
  const NumberTable table = readNumberTable(path, wanted);
  if (table.lines.empty()) {
    throw InvalidInput(table.name + " holds no pose, only the names of columns");
  }
  if (table.lines.size() > MostHeadPoses) {
    throw InvalidInput(table.name + " has " + std::to_string(table.lines.size()) +
                       " poses, and up to a million are replayed; give a part of it");
  }
  std::vector<HeadPose> poses;
  poses.reserve(table.lines.size());
  for (std::size_t row = 0; row < table.lines.size(); ++row) poses.push_back(poseOf(table, row));
  return poses;
}

}  // namespace pneuma
