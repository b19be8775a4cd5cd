#include "render/tube_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pneuma {
namespace {

constexpr double WideMm = 0.9;           // from here on round ends and more sides
constexpr double VeryWideMm = 2.5;       // trachea, main and lobar bronchi
constexpr double MaxProlongation = 0.6;  // of the radius

int sidesFor(double radiusMm) { return radiusMm >= VeryWideMm ? 20 : radiusMm >= WideMm ? 12 : 6; }

/// A circle of a tube's surface. Normals lean by the taper's slope.
struct Ring {
  Vec3 centre;
  Vec3 axis;
  double radiusMm = 0.0;
  double normalAlongAxis = 0.0;  ///< of the unit normal, e.g. 1 at the pole of a rounded end
};

/// The centreline with radii that a branch is drawn along.
std::vector<CentrelinePoint> centreline(const Branch& branch, double scale) {
  const bool measured = !branch.via.empty();
  const double first = measured ? branch.via.front().radiusMm : branch.radiusMm;
  const double last = measured ? branch.via.back().radiusMm : branch.radiusMm;
  std::vector<CentrelinePoint> line = {{branch.proximal, first * scale}};
  for (const CentrelinePoint& point : branch.via) {
    const double radius = point.radiusMm * scale;
    // Rings nearer than this would cut into each other at bends.
    const double spacing = 0.4 * radius;
    if ((point.position - line.back().position).norm() < spacing ||
        (point.position - branch.distal).norm() < spacing) {
      continue;
    }
    line.push_back({point.position, radius});
  }
  line.push_back({branch.distal, last * scale});
  return line;
}

/// Directions at the points of a centreline: the bisector of the bends inside.
std::vector<Vec3> tangents(const std::vector<CentrelinePoint>& line) {
  std::vector<Vec3> steps;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec3 step = line[i + 1].position - line[i].position;
    const double length = step.norm();
    steps.push_back(length > 0.0 ? Vec3(step / length)
                                 : (steps.empty() ? Vec3(Vec3::UnitZ()) : steps.back()));
  }
  std::vector<Vec3> result = {steps.front()};
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    const Vec3 sum = steps[i] + steps[i + 1];
    result.push_back(sum.norm() > 1e-6 ? Vec3(sum.normalized()) : steps[i]);
  }
  result.push_back(steps.back());
  return result;
}

Vec3 startDirection(const Branch& branch) {
  const Vec3& next = branch.via.empty() ? branch.distal : branch.via.front().position;
  const Vec3 step = next - branch.proximal;
  return step.norm() > 0.0 ? Vec3(step.normalized()) : direction(branch);
}

Vec3 endDirection(const Branch& branch) {
  const Vec3& last = branch.via.empty() ? branch.proximal : branch.via.back().position;
  const Vec3 step = branch.distal - last;
  return step.norm() > 0.0 ? Vec3(step.normalized()) : direction(branch);
}

/// What a mitre between two tubes that meet at an angle takes away from each, as a multiple of the
/// radius: tan(angle / 2).
double mitre(const Vec3& from, const Vec3& to) {
  return std::min(MaxProlongation, std::tan(0.5 * std::min(angleBetween(from, to), 2.0)));
}

class Builder {
 public:
  Builder(const AirwayTree& tree, const TubeOptions& options)
      : tree_(tree), children_(tree), options_(options) {}

  void reserve(std::size_t branches) {
    mesh_.points.reserve(branches * 36);
    mesh_.normals.reserve(branches * 36);
    mesh_.colours.reserve(branches * 36);
    mesh_.branches.reserve(branches * 12);
    mesh_.triangles.reserve(branches * 42);
  }

  void add(std::size_t index, const Rgb& colour) {
    const std::vector<Ring> rings = ringsOf(index);
    const int sides = options_.sides > 0 ? options_.sides
                                         : sidesFor(tree_[index].radiusMm * options_.radiusScale);
    const std::array<std::uint8_t, 3> bytes = bytesOf(colour);
    const std::int32_t first = static_cast<std::int32_t>(mesh_.points.size() / 3);
    Vec3 across = anyPerpendicular(rings.front().axis);
    for (const Ring& ring : rings) {
      // Parallel transport keeps the sides from twisting along bends.
      across = (across - across.dot(ring.axis) * ring.axis);
      across = across.norm() > 1e-6 ? Vec3(across.normalized()) : anyPerpendicular(ring.axis);
      addRing(ring, across, sides, bytes);
    }
    const std::int32_t n = sides;
    for (std::int32_t r = 0; r + 1 < static_cast<std::int32_t>(rings.size()); ++r) {
      const std::int32_t base = first + r * n;
      for (std::int32_t k = 0; k < n; ++k) {
        const std::int32_t next = (k + 1) % n;
        addTriangle(base + k, base + next, base + n + next);
        addTriangle(base + k, base + n + next, base + n + k);
      }
    }
    const std::int32_t last = first + static_cast<std::int32_t>(rings.size() - 1) * n;
    for (std::int32_t k = 1; k + 1 < n; ++k) addTriangle(last, last + k, last + k + 1);
    mesh_.branches.resize(mesh_.points.size() / 3, static_cast<std::uint32_t>(index));
    if (tree_[index].parent < 0) {
      for (std::int32_t k = 1; k + 1 < n; ++k) addTriangle(first, first + k + 1, first + k);
    }
  }

  TubeMesh take() { return std::move(mesh_); }

 private:
  std::vector<Ring> ringsOf(std::size_t index) const {
    const Branch& branch = tree_[index];
    const std::vector<CentrelinePoint> line = centreline(branch, options_.radiusScale);
    const std::vector<Vec3> axes = tangents(line);
    std::vector<Ring> rings;
    for (std::size_t i = 0; i < line.size(); ++i) {
      rings.push_back({line[i].position, axes[i], line[i].radiusMm, 0.0});
    }
    if (branch.parent >= 0) {
      const Vec3 from = endDirection(tree_[static_cast<std::size_t>(branch.parent)]);
      Ring& first = rings.front();
      first.centre -= first.axis * first.radiusMm * mitre(from, startDirection(branch));
    }
    if (branch.parent < 0 && rings.front().radiusMm >= WideMm) {
      Ring mouth = rings.front();  // once more, shaded as the flat face it is
      mouth.normalAlongAxis = -1.0;
      rings.insert(rings.begin(), mouth);
    }
    Ring& last = rings.back();
    double prolongation = 0.0;
    for (const int child : children_.of(index)) {
      const Branch& daughter = tree_[static_cast<std::size_t>(child)];
      const double radius = std::min(last.radiusMm, daughter.radiusMm * options_.radiusScale);
      prolongation = std::max(prolongation, radius * mitre(last.axis, startDirection(daughter)));
    }
    last.centre += last.axis * prolongation;
    if (last.radiusMm >= WideMm && options_.sides == 0) roundEnd(rings);
    return rings;
  }

  /// A flat dome, as high as 0.4 of the radius.
  static void roundEnd(std::vector<Ring>& rings) {
    const Ring end = rings.back();
    for (const double angle : {0.2 * std::numbers::pi, 0.38 * std::numbers::pi}) {
      rings.push_back({end.centre + end.axis * (0.4 * end.radiusMm * std::sin(angle)), end.axis,
                       end.radiusMm * std::cos(angle), std::sin(angle)});
    }
  }

  void addRing(const Ring& ring, const Vec3& across, int sides,
               const std::array<std::uint8_t, 3>& colour) {
    const Vec3 up = ring.axis.cross(across);
    const double radial = std::sqrt(1.0 - ring.normalAlongAxis * ring.normalAlongAxis);
    for (int k = 0; k < sides; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / sides;
      const Vec3 out = std::cos(angle) * across + std::sin(angle) * up;
      const Vec3 p = ring.centre + ring.radiusMm * out;
      const Vec3 normal = radial * out + ring.normalAlongAxis * ring.axis;
      for (int axis = 0; axis < 3; ++axis) {
        mesh_.points.push_back(static_cast<float>(p[axis]));
        mesh_.normals.push_back(static_cast<float>(normal[axis]));
      }
      mesh_.colours.insert(mesh_.colours.end(), colour.begin(), colour.end());
    }
  }

  void addTriangle(std::int32_t a, std::int32_t b, std::int32_t c) {
    mesh_.triangles.push_back(a);
    mesh_.triangles.push_back(b);
    mesh_.triangles.push_back(c);
  }

  const AirwayTree& tree_;
  Children children_;
  TubeOptions options_;
  TubeMesh mesh_;
};

}  // namespace

std::array<std::uint8_t, 3> bytesOf(const Rgb& colour) {
  const auto byte = [](double value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255.0));
  };
  return {byte(colour.r), byte(colour.g), byte(colour.b)};
}

TubeMesh tubeMesh(const AirwayTree& tree, const std::vector<bool>& visible,
                  const std::vector<Rgb>& colours, const TubeOptions& options) {
  Builder builder(tree, options);
  builder.reserve(static_cast<std::size_t>(std::ranges::count(visible, true)));
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (visible[i]) builder.add(i, colours[i]);
  }
  return builder.take();
}

LineMesh lineMesh(const AirwayTree& tree, const std::vector<bool>& visible,
                  const std::vector<Rgb>& colours) {
  LineMesh mesh;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (!visible[i]) continue;
    const std::array<std::uint8_t, 3> bytes = bytesOf(colours[i]);
    const std::vector<CentrelinePoint> line = centreline(tree[i], 1.0);
    for (std::size_t k = 0; k < line.size(); ++k) {
      const std::int32_t id = static_cast<std::int32_t>(mesh.points.size() / 3);
      if (k > 0) {
        mesh.segments.push_back(id - 1);
        mesh.segments.push_back(id);
      }
      for (int axis = 0; axis < 3; ++axis) {
        mesh.points.push_back(static_cast<float>(line[k].position[axis]));
      }
      mesh.colours.insert(mesh.colours.end(), bytes.begin(), bytes.end());
      mesh.branches.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return mesh;
}

}  // namespace pneuma
