#include "io/surface_file.h"

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/parallel.h"
#include "io/atomic_file.h"
#include "io/tree_file.h"
#include "io_samples.h"
#include "temp_folder.h"

namespace pneuma {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::sampleSurface;
using testing::sampleTree;
using testing::TempFolder;

SurfaceFile readSurfaceFrom(const std::string& name, const std::string& content) {
  const TempFolder folder;
  return readSurface(folder.put(name, content));
}

void expectSurfaceRefused(const std::string& name, const std::string& content,
                          const std::string& reason) {
  try {
    readSurfaceFrom(name, content);
    ADD_FAILURE() << name << " accepted, though: " << reason;
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr(reason));
    EXPECT_THAT(error.what(), HasSubstr(name));
  }
}

std::string bytesOf(const TriangleMesh& mesh, const std::string& extension,
                    const SurfaceTags& tags = {}) {
  const TempFolder folder;
  writeSurface(folder / ("s" + extension), mesh, tags);
  return readFile(folder / ("s" + extension));
}

class SurfaceFormat : public ::testing::TestWithParam<const char*> {};

TEST_P(SurfaceFormat, ReadsBackEqual) {
  const std::string extension = GetParam();
  const TriangleMesh mesh = sampleSurface();
  const SurfaceFile file = readSurfaceFrom("s" + extension, bytesOf(mesh, extension));
  EXPECT_EQ(file.space, "LPS");
  EXPECT_THAT(file.notes, IsEmpty());
  ASSERT_EQ(file.mesh.triangles.size(), mesh.triangles.size());
  EXPECT_EQ(file.mesh.points.size(), mesh.points.size());
  // VTP keeps all digits; the readers of the others work with floats.
  const double tolerance = extension == ".vtp" ? 0.0 : 1e-5;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3& p = file.mesh.points[file.mesh.triangles[i][corner]];
      EXPECT_LE((p - mesh.points[mesh.triangles[i][corner]]).norm(), tolerance);
    }
  }
  EXPECT_NEAR(signedVolumeMm3(file.mesh), signedVolumeMm3(mesh), 1e-2);
}

TEST_P(SurfaceFormat, IsTurnedToLpsIfItSaysRas) {
  const std::string extension = GetParam();
  const std::string content = bytesOf(sampleSurface(), extension, {.space = "RAS"});
  const SurfaceFile file = readSurfaceFrom("s" + extension, content);
  EXPECT_EQ(file.space, "RAS");
  EXPECT_THAT(file.notes, ::testing::ElementsAre(HasSubstr("RAS")));
  EXPECT_NEAR(bounds(file.mesh).min().x(), -30.2, 1e-5);
  EXPECT_NEAR(bounds(file.mesh).min().y(), -40.3, 1e-5);
  EXPECT_NEAR(bounds(file.mesh).max().z(), 50.4, 1e-5);
  EXPECT_NEAR(signedVolumeMm3(file.mesh), signedVolumeMm3(sampleSurface()), 1e-2);
}

TEST_P(SurfaceFormat, IsKnownByItsContent) {
  const std::string extension = GetParam();
  const TempFolder folder;
  const auto path = folder.put("s.dat", bytesOf(sampleSurface(), extension));
  const SurfaceFile file = readSurface(path);
  EXPECT_EQ(file.mesh.triangles.size(), 4U);
  EXPECT_THAT(file.notes, ::testing::ElementsAre(HasSubstr("s.dat")));
  EXPECT_FALSE(isTreeFile(path));
}

/// A fan of triangles about its first point.
TriangleMesh fan(std::uint32_t triangles) {
  TriangleMesh mesh;
  mesh.points.emplace_back(0.0, 0.0, 1.0);
  for (std::uint32_t i = 0; i <= triangles; ++i) {
    mesh.points.emplace_back(std::cos(0.001 * i), std::sin(0.001 * i), 0.0);
    if (i > 0) mesh.triangles.push_back({0, i, i + 1});
  }
  return mesh;
}

// As the lobes of a folder are.
TEST_P(SurfaceFormat, IsReadByManyThreadsAtOnce) {
  constexpr std::size_t Files = 12;
  constexpr int Rounds = 8;
  const std::string extension = GetParam();
  const TempFolder folder;
  std::vector<TriangleMesh> alone;
  for (std::uint32_t i = 0; i < Files; ++i) {
    writeSurface(folder / (std::to_string(i) + extension), fan(1000 + 211 * i));
    alone.push_back(readSurface(folder / (std::to_string(i) + extension)).mesh);
  }
  std::atomic<int> different = 0;
  for (int round = 0; round < Rounds; ++round) {
    parallelFor(Files, [&](std::size_t i) {
      const TriangleMesh mesh = readSurface(folder / (std::to_string(i) + extension)).mesh;
      different += mesh.points != alone[i].points || mesh.triangles != alone[i].triangles;
    });
  }
  EXPECT_EQ(different, 0);
}

INSTANTIATE_TEST_SUITE_P(Formats, SurfaceFormat, ::testing::Values(".stl", ".obj", ".ply", ".vtp"),
                         [](const auto& parameter) { return std::string(parameter.param + 1); });

constexpr const char* AsciiStl =
    "solid t\nfacet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n"
    "  vertex 0 1e1 0\n endloop\nendfacet\nendsolid t\n";

TEST(ReadStl, TakesAscii) {
  const SurfaceFile file = readSurfaceFrom("a.stl", AsciiStl);
  EXPECT_EQ(file.format, "STL");
  ASSERT_EQ(file.mesh.points.size(), 3U);
  EXPECT_EQ(file.mesh.points[2], Vec3(0, 10, 0));
}

TEST(ReadStl, TakesBinaryWhoseHeadBeginsLikeAscii) {
  std::string content = bytesOf(sampleSurface(), ".stl");
  content.replace(0, 12, "solid facet ");
  EXPECT_EQ(readSurfaceFrom("a.stl", content).mesh.triangles.size(), 4U);
}

TEST(ReadStl, TakesBinaryOfASingleTriangle) {
  TriangleMesh mesh = sampleSurface();
  mesh.triangles.resize(1);
  EXPECT_EQ(readSurfaceFrom("a.stl", bytesOf(mesh, ".stl")).mesh.triangles.size(), 1U);
}

TEST(ReadStl, NamesWhatIsWrong) {
  const std::string ascii = AsciiStl;
  expectSurfaceRefused("a.stl", "", "empty");
  expectSurfaceRefused("a.stl", "solid", "only 5 bytes");
  expectSurfaceRefused("a.stl", ascii.substr(0, 80), "cut off");
  expectSurfaceRefused("a.stl", ascii.substr(0, ascii.find("endsolid")), "no \"endsolid\"");
  expectSurfaceRefused("a.stl", "solid t\nfacet\nvertex 0 zero 0\n",
                       "line 3: a vertex needs three numbers");
  expectSurfaceRefused("a.stl", "solid t\n facet\nendsolid t\n", "no triangle");
  std::string binary = bytesOf(sampleSurface(), ".stl");
  expectSurfaceRefused("a.stl", binary.substr(0, 200),
                       "4 triangles, which take 284 bytes, but has 200");
  expectSurfaceRefused("a.stl", binary + "more", "284 bytes, but has 288");
  const float nan = std::nanf("");
  std::memcpy(binary.data() + 84 + 12, &nan, sizeof(nan));
  expectSurfaceRefused("a.stl", binary, "not a number");
  std::string none = binary.substr(0, 84);
  none.replace(80, 4, std::string(4, '\0'));
  expectSurfaceRefused("a.stl", none, "no triangle");
}

TEST(ReadObj, CutsPolygonsAndTakesAllKindsOfIndices) {
  const SurfaceFile file =
      readSurfaceFrom("a.obj",
                      "# by hand\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nvn 0 0 1\n"
                      "f 1//1 2//1 3//1 4//1\nv 5 5 5\nf 5//1 4//1 3//1\n");
  EXPECT_EQ(file.mesh.triangles.size(), 3U);
  EXPECT_EQ(file.mesh.points.size(), 5U);
  EXPECT_THAT(file.notes, ::testing::ElementsAre(HasSubstr("cut into 3 triangles")));
  // A square of 2 and a triangle on one of its sides with a height of sqrt(34).
  EXPECT_NEAR(areaMm2(file.mesh), 4.0 + std::sqrt(34.0), 1e-5);
}

TEST(ReadObj, NamesWhatIsWrong) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  expectSurfaceRefused("a.obj", points + "f 1 2 4\n", "point 4 of 3");
  expectSurfaceRefused("a.obj", points + "f 0 1 2\n", "line 4 names a point that is none: \"0\"");
  expectSurfaceRefused("a.obj", points + "f -1 1 2\n", "line 4 counts points backwards");
  expectSurfaceRefused("a.obj", points + "f 1 2\n", "fewer than three");
  expectSurfaceRefused("a.obj", points + "f 1 2 x\n", "line 4 names a point");
  expectSurfaceRefused("a.obj", "v 0 nan 0\n", "line 1 has no three coordinates");
  expectSurfaceRefused("a.obj", "v 0 0\n", "line 1 has no three coordinates");
  expectSurfaceRefused("a.obj", points, "no triangle");
  expectSurfaceRefused("a.obj", points + "f " + std::string(5000, ' ') + "1 2 3\n", "longer than");
}

std::string ply(const std::string& vertices, const std::string& faces, int vertexCount = 3,
                int faceCount = 1) {
  return "ply\nformat ascii 1.0\ncomment SPACE=LPS\nelement vertex " + std::to_string(vertexCount) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
         std::to_string(faceCount) + "\nproperty list uchar int vertex_indices\nend_header\n" +
         vertices + faces;
}

TEST(ReadPly, TakesAscii) {
  const SurfaceFile file = readSurfaceFrom("a.ply", ply("0 0 0\n1 0 0\n0 1 0\n", "3 0 1 2\n"));
  EXPECT_EQ(file.mesh.triangles.size(), 1U);
  EXPECT_EQ(file.space, "LPS");
}

TEST(ReadPly, TakesTextWhoseLastLineHasNoEnd) {
  // VTK frees memory twice at it.
  const SurfaceFile file = readSurfaceFrom("a.ply", ply("0 0 0\n1 0 0\n0 1 0\n", "3 0 1 2"));
  EXPECT_EQ(file.mesh.triangles.size(), 1U);
}

TEST(ReadPly, NamesWhatIsWrong) {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  expectSurfaceRefused("a.ply", ply(points, "3 0 1 3\n"), "point 3 of 3");
  expectSurfaceRefused("a.ply", ply(points, "3 0 1 -1\n"), "point -1 of 3");
  expectSurfaceRefused("a.ply", ply(points, "3 0 1\n"), "incomplete");
  expectSurfaceRefused("a.ply", ply(points, "", 3, 1), "ends too early");
  expectSurfaceRefused("a.ply", ply(points, "", 3, 0), "no triangle");
  expectSurfaceRefused("a.ply", ply(points, "3 0 1 2\n", 2000000000), "cannot be");
  expectSurfaceRefused("a.ply", ply("0 0 0\nnan 0 0\n0 1 0\n", "3 0 1 2\n"), "not a number");
  expectSurfaceRefused("a.ply", ply(points, std::string(5000, ' ') + "3 0 1 2\n"),
                       "4000 characters");
  expectSurfaceRefused("a.ply", "ply\nformat ascii 1.0\nend_header\n", "no element \"vertex\"");
  // VTK writes past its memory at some of them.
  std::string bare = ply(points, "3 0 1 2\n");
  for (int i = 0; i < 20; ++i) bare.insert(bare.find("element face"), "element bare 0\n");
  expectSurfaceRefused("a.ply", bare, "element \"bare\" has no property");
}

TEST(ReadSurface, RefusesWhatIsNoSurface) {
  const std::string tree = treeText(sampleTree(), "vtp");
  expectSurfaceRefused("tree.vtp", tree, "airway tree?");
  expectSurfaceRefused("a.vtp", "no xml\n", "VTP");
  expectSurfaceRefused("a.ply", std::string(100, '\1'), "PLY");
  EXPECT_THROW(readSurfaceFrom("a.txt", "words\n"), Unsupported);
  EXPECT_THROW(readSurface("none.stl"), InputMissing);
  EXPECT_THROW(readSurface("/"), InputMissing);
}

TEST(WriteSurface, RefusesWhatCouldNotBeReadBack) {
  const TempFolder folder;
  TriangleMesh mesh;
  EXPECT_THROW(writeSurface(folder / "a.stl", mesh), InvalidInput);
  mesh = sampleSurface();
  EXPECT_THROW(writeSurface(folder / "a.vtu", mesh), Unsupported);
  mesh.points[0].x() = std::nan("");
  EXPECT_THROW(writeSurface(folder / "a.stl", mesh), InvalidInput);
  EXPECT_EQ(folder.fileCount(), 0U);
}

TEST(ReadRealLobes, AreClosedAndHaveThePublishedVolume) {
  const char* data = std::getenv("PNEUMA_TEST_DATA");
  if (data == nullptr || *data == '\0') GTEST_SKIP() << "PNEUMA_TEST_DATA is not set";
  double volume = 0.0;
  std::size_t triangles = 0;
  for (const char* lobe : {"rul", "rml", "rll", "lul", "lll"}) {
    const SurfaceFile file =
        readSurface(std::string(data) + "/lobes_airways_chaste/" + lobe + ".stl");
    // Euler: a closed surface like a ball has F = 2 V - 4 once equal points are joined.
    EXPECT_EQ(file.mesh.triangles.size(), 2 * file.mesh.points.size() - 4) << lobe;
    triangles += file.mesh.triangles.size();
    volume += signedVolumeMm3(file.mesh);
  }
  EXPECT_EQ(triangles, 183964U);
  EXPECT_NEAR(volume, 7.568e6, 0.002e6);
}

TEST(SurfaceFile, SaysWhichLobeATriangleIsOf) {
  const TriangleMesh mesh = sampleSurface();
  std::vector<std::uint8_t> lobes(mesh.triangles.size(), 2);
  lobes.back() = 5;
  const TempFolder folder;
  writeSurface(folder / "lobes.vtp", mesh, {}, {{"lobe", lobes}});
  EXPECT_EQ(readSurface(folder / "lobes.vtp").lobes, lobes);
  writeSurface(folder / "other.vtp", mesh, {}, {{"on_fissure", lobes}});
  EXPECT_THAT(readSurface(folder / "other.vtp").lobes, IsEmpty());
}

}  // namespace
}  // namespace pneuma
