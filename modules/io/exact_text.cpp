#include "io/exact_text.h"

#include <cstring>
#include <string_view>

#include "core/error.h"
#include "io/detail/text_fields.h"
#include "io/detail/tree_formats.h"
#include "io/detail/volume_fields.h"
#include "io/detail/volume_formats.h"

namespace pneuma {
namespace {

constexpr std::size_t PointBytes = 3 * sizeof(double);
constexpr std::size_t TriangleBytes = 1 + 3 * sizeof(std::uint32_t);

[[noreturn]] void throwNotOurs(const std::string& name, const std::string& what) {
  throw InvalidInput(name + " " + what + "; it is damaged");
}

std::string markLines(const ByteMarks& marks) {
  std::string lines;
  for (const auto& [mark, values] : marks) lines += "property uchar " + mark + "\n";
  return lines;
}

/// The lines of a PLY's header one after the other, as exactPly() writes them.
class PlyHead {
 public:
  PlyHead(const std::string& content, const std::string& name) : rest_(content), name_(name) {}

  /// The rest of a line that begins so; nothing if it begins otherwise.
  std::optional<std::string_view> line(std::string_view start) {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos || !rest_.substr(0, end).starts_with(start)) return {};
    const std::string_view found = rest_.substr(start.size(), end - start.size());
    rest_.remove_prefix(end + 1);
    return found;
  }

  std::string_view require(std::string_view start) {
    const auto found = line(start);
    if (!found) throwNotOurs(name_, "has not the header of a surface of ours");
    return *found;
  }

  std::size_t requireCount(std::string_view start) {
    const auto count = parseInteger(require(start));
    if (!count || *count < 0) throwNotOurs(name_, "has no sound number of points or triangles");
    return static_cast<std::size_t>(*count);
  }

  ByteMarks marks() {
    ByteMarks marks;
    while (const auto mark = line("property uchar ")) marks[std::string(*mark)];
    return marks;
  }

  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  const std::string& name_;
};

template <class T>
std::string headOf(const ImageGeometry& geometry) {
  const StoredVoxels stored =
      sizeof(T) == 1 ? StoredVoxels{Scalar::Uint8, true} : StoredVoxels{Scalar::Int16, false};
  return nrrdHead(geometry, stored, "raw");
}

template <class T>
std::string nrrdOf(const Image<T>& image) {
  std::string text = headOf<T>(image.geometry);
  if (image.voxels.empty()) return text;
  const std::size_t head = text.size();
  text.resize(head + image.voxels.size() * sizeof(T));
  std::memcpy(text.data() + head, image.voxels.data(), image.voxels.size() * sizeof(T));
  return text;
}

template <class T>
Image<T> imageOf(const std::string& content, const ImageGeometry& geometry,
                 const std::string& name) {
  // Where the header says something else, these are not the voxels of this geometry.
  const std::string head = headOf<T>(geometry);
  checkedGeometry(geometry.size, geometry.steps(), geometry.origin, name);
  std::size_t voxels = 1;
  for (const int along : geometry.size) {
    if (along < 1 || voxels > content.size()) throwNotOurs(name, "has another size than it should");
    voxels *= static_cast<std::size_t>(along);
  }
  if (!content.starts_with(head) || content.size() - head.size() != voxels * sizeof(T)) {
    throwNotOurs(name, "has another size than it should");
  }
  Image<T> image{geometry, std::vector<T>(voxels)};
  std::memcpy(image.voxels.data(), content.data() + head.size(), voxels * sizeof(T));
  return image;
}

}  // namespace

std::string exactPly(const MarkedMesh& marked) {
  const TriangleMesh& mesh = marked.mesh;
  std::string text =
      "ply\nformat binary_little_endian 1.0\ncomment SPACE=LPS, mm\nelement vertex " +
      std::to_string(mesh.points.size()) +
      "\nproperty double x\nproperty double y\nproperty double z\n" + markLines(marked.ofPoints) +
      "element face " + std::to_string(mesh.triangles.size()) +
      "\nproperty list uchar uint vertex_indices\n" + markLines(marked.ofTriangles) +
      "end_header\n";
  text.reserve(text.size() + (PointBytes + marked.ofPoints.size()) * mesh.points.size() +
               (TriangleBytes + marked.ofTriangles.size()) * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    text.append(reinterpret_cast<const char*>(mesh.points[i].data()), PointBytes);
    for (const auto& [mark, values] : marked.ofPoints) text += static_cast<char>(values[i]);
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    text += '\3';
    text.append(reinterpret_cast<const char*>(mesh.triangles[i].data()), TriangleBytes - 1);
    for (const auto& [mark, values] : marked.ofTriangles) text += static_cast<char>(values[i]);
  }
  return text;
}

MarkedMesh meshOfExactPly(const std::string& content, const std::string& name) {
  PlyHead head(content, name);
  head.require("ply");
  head.require("format binary_little_endian 1.0");
  head.require("comment ");
  const std::size_t points = head.requireCount("element vertex ");
  for (const char* axis : {"x", "y", "z"}) head.require(std::string("property double ") + axis);
  MarkedMesh marked;
  marked.ofPoints = head.marks();
  const std::size_t triangles = head.requireCount("element face ");
  head.require("property list uchar uint vertex_indices");
  marked.ofTriangles = head.marks();
  head.require("end_header");

  const char* byte = head.rest().data();
  const std::size_t bytes = head.rest().size();
  const std::size_t ofPoint = PointBytes + marked.ofPoints.size();
  const std::size_t ofTriangle = TriangleBytes + marked.ofTriangles.size();
  if (points > bytes || triangles > bytes || points * ofPoint + triangles * ofTriangle != bytes) {
    throwNotOurs(name, "has another length than its header says");
  }
  marked.mesh.points.resize(points);
  marked.mesh.triangles.resize(triangles);
  for (auto& [mark, values] : marked.ofPoints) values.resize(points);
  for (auto& [mark, values] : marked.ofTriangles) values.resize(triangles);
  for (std::size_t i = 0; i < points; ++i) {
    std::memcpy(marked.mesh.points[i].data(), byte, PointBytes);
    if (!marked.mesh.points[i].allFinite()) throwNotOurs(name, "has a point that is no number");
    byte += PointBytes;
    for (auto& [mark, values] : marked.ofPoints) values[i] = static_cast<std::uint8_t>(*byte++);
  }
  for (std::size_t i = 0; i < triangles; ++i) {
    auto& corners = marked.mesh.triangles[i];
    if (*byte != '\3') throwNotOurs(name, "has a face that is no triangle");
    std::memcpy(corners.data(), byte + 1, TriangleBytes - 1);
    for (const std::uint32_t corner : corners) {
      if (corner >= points) throwNotOurs(name, "has a triangle of points that there are not");
    }
    byte += TriangleBytes;
    for (auto& [mark, values] : marked.ofTriangles) values[i] = static_cast<std::uint8_t>(*byte++);
  }
  return marked;
}

std::string exactNrrd(const CtImage& image) { return nrrdOf(image); }

std::string exactNrrd(const LabelImage& image) { return nrrdOf(image); }

CtImage ctOfExactNrrd(const std::string& content, const ImageGeometry& geometry,
                      const std::string& name) {
  return imageOf<std::int16_t>(content, geometry, name);
}

LabelImage labelsOfExactNrrd(const std::string& content, const ImageGeometry& geometry,
                             const std::string& name) {
  return imageOf<std::uint8_t>(content, geometry, name);
}

AirwayTree treeOfVtpText(const std::string& content, const std::string& name) {
  return readVtkTree(content, name).tree;
}

}  // namespace pneuma
