#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"

/// What the headers of all volume formats have in common.
namespace pneuma {

/// What stands in a file as messages repeat it: in quotation marks, short and printable.
std::string excerpt(std::string_view text);

/// All words of `text` as numbers. @throws InvalidInput, naming `field`, unless there are `count`
std::vector<double> numbersOf(std::string_view text, std::size_t count, const std::string& field,
                              const std::string& name);

/// The one whole number that is all of `text`. @throws InvalidInput naming `field`
std::int64_t wholeNumberOf(std::string_view text, const std::string& field,
                           const std::string& name);

/// The voxels along each axis. @throws InvalidInput if there are none or absurdly many;
/// Unsupported for fewer than three axes and for axes with one voxel
std::array<int, 3> checkedSize(std::span<const std::int64_t> sizes, const std::string& name);

/// @throws InvalidInput unless all are positive numbers
void requirePositive(const Vec3& spacing, const std::string& name);

/// The geometry whose steps from voxel to voxel are the columns of `steps`, LPS, mm.
/// @throws InvalidInput for anything that is no number, for steps shorter than 0.01 mm or longer
/// than 100 mm, for an origin farther than 100 m, and for axes that lie in one plane
ImageGeometry checkedGeometry(const std::array<int, 3>& size, const Mat3& steps, const Vec3& origin,
                              const std::string& name);

/// Millimetres in one unit of length as files name it. @throws Unsupported for other units
double mmPer(std::string_view unit, const std::string& name);

/// The data file beside a detached header. @throws InvalidInput for a name that leads elsewhere;
/// Unsupported for a list or a pattern of names; InputMissing if there is none
std::filesystem::path detachedFile(const std::filesystem::path& header, std::string_view named);

/// x and y of the columns turned round: from RAS to LPS or back.
inline Mat3 turnedRound(const Mat3& m) { return Vec3(-1.0, -1.0, 1.0).asDiagonal() * m; }

inline Vec3 turnedRound(const Vec3& p) { return {-p.x(), -p.y(), p.z()}; }

}  // namespace pneuma
