#include "io/piece_files.h"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkMultiPieceDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLMultiBlockDataReader.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/multiblock_file.h"
#include "io/surface_file.h"
#include "io/tree_file.h"
#include "io_samples.h"
#include "temp_folder.h"

namespace pneuma {
namespace {

using testing::TempFolder;

/// A sheet of 2 n^2 triangles.
TriangleMesh sheet(std::uint32_t n) {
  TriangleMesh mesh;
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x) mesh.points.emplace_back(x / 3.0, y / 7.0, x * y / 11.0);
  }
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t at = y * (n + 1) + x;
      mesh.triangles.push_back({at, at + 1, at + n + 2});
      mesh.triangles.push_back({at, at + n + 2, at + n + 1});
    }
  }
  return mesh;
}

/// A chain of n branches, the first ones with many points between their ends.
AirwayTree chain(int n) {
  AirwayTree tree;
  for (int i = 0; i < n; ++i) {
    Branch branch;
    branch.parent = i - 1;
    branch.proximal = Vec3(0.1 * i, 0, 0);
    branch.distal = Vec3(0.1 * (i + 1), 0, 0);
    branch.radiusMm = 1.0 / (i + 1);
    for (int k = 0; k < (i < 100 ? 20 : i % 3); ++k) {
      branch.via.push_back({Vec3(0.1 * i + 0.001 * k, 0.01, 0), 0.5});
    }
    tree.add(branch);
  }
  return tree;
}

/// What a collection of one thing in pieces holds, as ParaView opens it.
std::vector<vtkSmartPointer<vtkPolyData>> opened(const TempFolder& folder, const std::string& stem,
                                                 std::size_t count) {
  writeMultiblock(folder / "all.vtm", {{stem, pieceFiles(stem + ".vtp", count)}});
  vtkNew<vtkXMLMultiBlockDataReader> reader;
  reader->SetFileName((folder / "all.vtm").c_str());
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), 0UL);
  auto* all = vtkMultiBlockDataSet::SafeDownCast(reader->GetOutput());
  auto* pieces = vtkMultiPieceDataSet::SafeDownCast(all->GetBlock(0));
  std::vector<vtkSmartPointer<vtkPolyData>> found;
  if (pieces == nullptr) return found;
  for (unsigned int i = 0; i < pieces->GetNumberOfPieces(); ++i) {
    found.emplace_back(vtkPolyData::SafeDownCast(pieces->GetPieceAsDataObject(i)));
  }
  return found;
}

void expectWithin(const std::filesystem::path& file, std::size_t count, std::uint64_t largest) {
  for (const auto& piece : pieceFiles(file, count)) {
    ASSERT_TRUE(std::filesystem::exists(piece)) << piece;
    EXPECT_LE(std::filesystem::file_size(piece), largest) << piece;
  }
}

/// The same once they were found to be several, each within the size.
std::vector<vtkSmartPointer<vtkPolyData>> severalOpened(const TempFolder& folder,
                                                        const std::string& stem, std::size_t count,
                                                        std::uint64_t largest) {
  EXPECT_GT(count, 3U);
  expectWithin(folder / (stem + ".vtp"), count, largest);
  const auto pieces = opened(folder, stem, count);
  EXPECT_EQ(pieces.size(), count);
  return pieces;
}

TEST(PieceFiles, OneIsTheFileItself) {
  const TempFolder folder;
  const TriangleMesh mesh = sheet(10);
  ASSERT_EQ(pieceEnds(mesh, LargestFileBytes), std::vector<std::size_t>{200});
  ASSERT_EQ(pieceFiles("a/rul.vtp", 1), std::vector<std::filesystem::path>{"a/rul.vtp"});
  writeSurfacePieces(folder / "pieces.vtp", mesh, {200});
  writeSurface(folder / "whole.vtp", mesh);
  EXPECT_EQ(readFile(folder / "pieces.vtp"), readFile(folder / "whole.vtp"));
  writeTreePieces(folder / "pieces.vtp", chain(10), {{"method", "none"}}, {10});
  writeTree(folder / "whole.vtp", chain(10), {{"method", "none"}});
  EXPECT_EQ(readFile(folder / "pieces.vtp"), readFile(folder / "whole.vtp"));
  EXPECT_TRUE(firstPieceIn(folder.path()).empty());
}

TEST(PieceFiles, OfASurfaceMakeItUpAgain) {
  const TempFolder folder;
  const TriangleMesh mesh = sheet(60);
  constexpr std::uint64_t Largest = 100'000;
  const std::vector<std::size_t> ends = pieceEnds(mesh, Largest);
  writeSurfacePieces(folder / "a b.vtp", mesh, ends);
  EXPECT_FALSE(std::filesystem::exists(folder / "a b.vtp"));
  const auto pieces = severalOpened(folder, "a b", ends.size(), Largest);
  std::size_t i = 0;
  vtkIdType points = 0;
  vtkNew<vtkIdList> corners;
  for (const auto& piece : pieces) {
    ASSERT_NE(piece, nullptr);
    points += piece->GetNumberOfPoints();
    for (vtkIdType cell = 0; cell < piece->GetNumberOfPolys(); ++cell, ++i) {
      piece->GetCellPoints(cell, corners);
      ASSERT_EQ(corners->GetNumberOfIds(), 3);
      for (int k = 0; k < 3; ++k) {
        const Vec3 there(piece->GetPoint(corners->GetId(k)));
        ASSERT_EQ(there, mesh.points[mesh.triangles.at(i)[static_cast<std::size_t>(k)]]) << i;
      }
    }
  }
  EXPECT_EQ(i, mesh.triangles.size());
  EXPECT_LT(points, static_cast<vtkIdType>(2 * mesh.points.size())) << "they are joined in a piece";
  EXPECT_EQ(readSurface(pieceFiles(folder / "a b.vtp", ends.size())[1]).space, "LPS");
}

TEST(PieceFiles, OfASurfaceKeepItsArrays) {
  const TempFolder folder;
  const TriangleMesh mesh = sheet(60);
  SurfaceArrays arrays;
  for (const Vec3& point : mesh.points) {
    arrays.pointVectors["displacement"].emplace_back(2.0 * point);
    arrays.pointValues["height"].push_back(point.z());
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    arrays.triangleMarks["lobe"].push_back(static_cast<std::uint8_t>(i % 5));
  }
  arrays.fieldValues["phase"] = 0.25;
  constexpr std::uint64_t Largest = 100'000;
  const std::vector<std::size_t> ends = pieceEnds(mesh, Largest, {32, 1});
  EXPECT_GT(ends.size(), pieceEnds(mesh, Largest).size()) << "arrays take room";
  writeSurfacePieces(folder / "lung.vtp", mesh, ends, arrays);
  std::size_t i = 0;
  for (const auto& piece : severalOpened(folder, "lung", ends.size(), Largest)) {
    ASSERT_NE(piece, nullptr);
    vtkDataArray* displacement = piece->GetPointData()->GetArray("displacement");
    vtkDataArray* height = piece->GetPointData()->GetArray("height");
    vtkDataArray* lobe = piece->GetCellData()->GetArray("lobe");
    ASSERT_TRUE(displacement != nullptr && height != nullptr && lobe != nullptr);
    for (vtkIdType n = 0; n < piece->GetNumberOfPoints(); ++n) {
      const Vec3 point(piece->GetPoint(n));
      ASSERT_EQ(Vec3(displacement->GetTuple(n)), 2.0 * point);
      ASSERT_EQ(height->GetTuple1(n), point.z());
    }
    for (vtkIdType cell = 0; cell < piece->GetNumberOfPolys(); ++cell, ++i) {
      ASSERT_EQ(lobe->GetTuple1(cell), static_cast<double>(i % 5));
    }
    ASSERT_NE(piece->GetFieldData()->GetArray("phase"), nullptr);
    EXPECT_EQ(piece->GetFieldData()->GetArray("phase")->GetTuple1(0), 0.25);
  }
  EXPECT_EQ(i, mesh.triangles.size());
}

TEST(PieceFiles, OfATreeKeepItsBranchesAndColumns) {
  const TempFolder folder;
  const AirwayTree tree = chain(2000);
  constexpr std::uint64_t Largest = 80'000;
  const std::vector<std::size_t> ends = pieceEnds(tree, Largest);
  writeTreePieces(folder / "tree.vtp", tree, {{"method", "none"}}, ends);
  const auto pieces = severalOpened(folder, "tree", ends.size(), Largest);
  std::size_t i = 0;
  vtkNew<vtkIdList> points;
  for (const auto& piece : pieces) {
    ASSERT_NE(piece, nullptr);
    const auto cells = [&](const char* name) { return piece->GetCellData()->GetArray(name); };
    for (const char* name : {"lobe", "side", "segment", "horsfield_order", "strahler_order",
                             "length_mm", "diameter_mm", "flow_fraction", "region_ml", "terminal",
                             "origin", "ending", "supplied_ml"}) {
      EXPECT_NE(cells(name), nullptr) << name;
    }
    EXPECT_NE(piece->GetFieldData()->GetAbstractArray("method"), nullptr);
    for (vtkIdType cell = 0; cell < piece->GetNumberOfLines(); ++cell, ++i) {
      const Branch& branch = tree[i];
      ASSERT_EQ(cells("id")->GetTuple1(cell), static_cast<double>(i));
      ASSERT_EQ(cells("parent")->GetTuple1(cell), static_cast<double>(branch.parent));
      ASSERT_EQ(cells("generation")->GetTuple1(cell), static_cast<double>(i));
      piece->GetCellPoints(cell, points);
      ASSERT_EQ(points->GetNumberOfIds(), static_cast<vtkIdType>(branch.via.size() + 2));
      ASSERT_EQ(Vec3(piece->GetPoint(points->GetId(0))), branch.proximal);
      ASSERT_EQ(piece->GetPointData()->GetArray("radius")->GetTuple1(points->GetId(0)),
                branch.radiusMm);
    }
  }
  EXPECT_EQ(i, tree.size());
}

TEST(PieceFiles, OfTrianglesThatShareNoPointStayWithinTheSize) {
  const TempFolder folder;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 9000; ++i) {
    const std::uint32_t at = 3 * ((i * 4001) % 9000);
    mesh.triangles.push_back({at, at + 1, at + 2});
  }
  for (std::uint32_t i = 0; i < 27000; ++i) mesh.points.emplace_back(i, i % 7, i % 3);
  for (const std::uint64_t largest : {LeastFileBytes, std::uint64_t{123'456}}) {
    const std::vector<std::size_t> ends = pieceEnds(mesh, largest);
    writeSurfacePieces(folder / "apart.vtp", mesh, ends);
    expectWithin(folder / "apart.vtp", ends.size(), largest);
  }
}

TEST(PieceFiles, OfALongBranchIsOne) {
  AirwayTree tree = chain(3);
  Branch branch = tree[2];
  branch.parent = 2;
  branch.via.assign(5000, {Vec3::Zero(), 1.0});
  tree.add(branch);
  branch.parent = 3;
  branch.via.clear();
  tree.add(branch);
  EXPECT_EQ(pieceEnds(tree, LeastFileBytes), (std::vector<std::size_t>{3, 4, 5}));
}

TEST(PieceFiles, AreNotReadAsTheWhole) {
  const TempFolder folder;
  const TriangleMesh mesh = sheet(60);
  requireWhole(folder.path());
  requireWhole(folder / "absent");
  writeSurfacePieces(folder / "rul.vtp", mesh, pieceEnds(mesh, 100'000));
  EXPECT_EQ(firstPieceIn(folder.path()), folder / "rul" / "rul_0.vtp");
  EXPECT_THROW(requireWhole(folder.path()), Unsupported);
  writeSurface(folder / "rul.vtp", mesh);
  EXPECT_NO_THROW(requireWhole(folder.path())) << "something of somebody else stands beside it";
  std::filesystem::remove(folder / "rul.vtp");
  std::filesystem::rename(folder / "rul", folder / "view");
  std::filesystem::rename(folder / "view" / "rul_0.vtp", folder / "view" / "view_0.vtp");
  EXPECT_NO_THROW(requireWhole(folder.path())) << "as ParaView saves view.vtm";
  const AirwayTree tree = chain(2000);
  const std::vector<std::size_t> ends = pieceEnds(tree, 80'000);
  writeTreePieces(folder / "tree.vtp", tree, {}, ends);
  for (const auto& piece : pieceFiles(folder / "tree.vtp", ends.size())) {
    EXPECT_THROW(readTree(piece), Unsupported) << piece;
  }
}

TEST(PieceFiles, OfATreeThatIsNoneAreNotWritten) {
  const TempFolder folder;
  AirwayTree tree = chain(2000);
  tree.setRadiusMm(7, 0.0);
  EXPECT_THROW(writeTreePieces(folder / "tree.vtp", tree, {}, pieceEnds(tree, 80'000)),
               InvalidInput);
  EXPECT_THROW(writeTreePieces(folder / "tree.vtp", tree, {}, {2000}), InvalidInput);
  EXPECT_EQ(folder.fileCount(), 0U);
}

}  // namespace
}  // namespace pneuma
