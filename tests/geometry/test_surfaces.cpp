#include "geometry/test_surfaces.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <utility>

namespace pneuma::testing {
namespace {

using Index = std::uint32_t;

/// Binary STL with equal points joined; the tests of this module know no reader.
TriangleMesh readStl(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  in.ignore(80);
  std::uint32_t count = 0;
  in.read(reinterpret_cast<char*>(&count), sizeof(count));
  TriangleMesh mesh;
  std::map<std::array<float, 3>, Index> indices;
  for (std::uint32_t t = 0; t < count && in; ++t) {
    std::array<std::array<float, 3>, 4> normalAndCorners;
    in.read(reinterpret_cast<char*>(&normalAndCorners), sizeof(normalAndCorners));
    in.ignore(2);
    std::array<Index, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& corner = normalAndCorners[k + 1];
      const auto [found, isNew] = indices.try_emplace(corner, static_cast<Index>(indices.size()));
      if (isNew) mesh.points.emplace_back(corner[0], corner[1], corner[2]);
      triangle[k] = found->second;
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace

TriangleMesh cube(double sideMm, const Vec3& low) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.points.push_back(low + sideMm * Vec3(i & 1, (i >> 1) & 1, (i >> 2) & 1));
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TriangleMesh subdivided(const TriangleMesh& mesh) {
  TriangleMesh fine;
  fine.points = mesh.points;
  std::map<std::pair<Index, Index>, Index> middles;
  const auto middle = [&](Index a, Index b) {
    const auto [found, isNew] =
        middles.try_emplace(std::minmax(a, b), static_cast<Index>(fine.points.size()));
    if (isNew) fine.points.emplace_back((mesh.points[a] + mesh.points[b]) / 2.0);
    return found->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const Index ab = middle(a, b);
    const Index bc = middle(b, c);
    const Index ca = middle(c, a);
    fine.triangles.push_back({a, ab, ca});
    fine.triangles.push_back({ab, b, bc});
    fine.triangles.push_back({ca, bc, c});
    fine.triangles.push_back({ab, bc, ca});
  }
  return fine;
}

TriangleMesh sphere(double radiusMm, const Vec3& centre, int subdivisions) {
  TriangleMesh mesh;
  mesh.points = {Vec3::UnitX(),  -Vec3::UnitX(), Vec3::UnitY(),
                 -Vec3::UnitY(), Vec3::UnitZ(),  -Vec3::UnitZ()};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int i = 0; i < subdivisions; ++i) {
    mesh = subdivided(mesh);
    for (Vec3& p : mesh.points) p.normalize();
  }
  for (Vec3& p : mesh.points) p = centre + radiusMm * p;
  return mesh;
}

TriangleMesh torus(double radiusMm, double tubeMm) {
  constexpr Index Around = 48;
  constexpr Index Across = 20;
  constexpr double Turn = 2.0 * std::numbers::pi;
  TriangleMesh mesh;
  for (Index i = 0; i < Around; ++i) {
    for (Index j = 0; j < Across; ++j) {
      const double u = Turn * i / Around;
      const double v = Turn * j / Across;
      const double r = radiusMm + tubeMm * std::cos(v);
      mesh.points.emplace_back(r * std::cos(u), r * std::sin(u), tubeMm * std::sin(v));
      const auto at = [](Index a, Index b) { return a % Around * Across + b % Across; };
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

TriangleMesh dentedBall(double radiusMm) {
  TriangleMesh mesh = sphere(1.0, Vec3::Zero(), 5);
  for (Vec3& p : mesh.points) {
    p *= radiusMm * (1.0 + 0.35 * std::sin(4.0 * p.x()) * std::cos(5.0 * p.y() + p.z()));
  }
  return mesh;
}

TriangleMesh insideOut(TriangleMesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

TriangleMesh together(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh both = a;
  const auto offset = static_cast<Index>(a.points.size());
  both.points.insert(both.points.end(), b.points.begin(), b.points.end());
  for (const auto& [i, j, k] : b.triangles) {
    both.triangles.push_back({i + offset, j + offset, k + offset});
  }
  return both;
}

TriangleMesh scaled(TriangleMesh mesh, double factor) {
  for (Vec3& p : mesh.points) p *= factor;
  return mesh;
}

std::vector<NamedSurface> manySurfaces() {
  std::vector<NamedSurface> surfaces = {
      {"sphere", sphere(50.0)},
      {"cube", cube(80.0)},
      {"torus", torus(50.0, 20.0)},
      {"dented ball", dentedBall(60.0)},
      {"two balls, one with a cavity",
       together(together(sphere(40.0), insideOut(sphere(15.0))), sphere(20.0, {90.0, 0.0, 0.0}))}};
  const char* data = std::getenv("PNEUMA_TEST_DATA");
  if (data == nullptr || *data == '\0') return surfaces;
  for (const std::string name : {"rul", "rml", "rll", "lul", "lll"}) {
    const auto path = std::filesystem::path(data) / "lobes_airways_chaste" / (name + ".stl");
    if (std::filesystem::exists(path)) surfaces.push_back({name, readStl(path)});
  }
  return surfaces;
}

}  // namespace pneuma::testing
