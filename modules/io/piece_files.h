#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "anatomy/airway_tree.h"
#include "core/triangle_mesh.h"
#include "io/surface_file.h"

/// Surfaces and trees as several VTP files: what does not fit into one file of a size. A .vtm that
/// names them (writeMultiblock()) opens all, and ParaView shares them among the processes that
/// draw. Nothing here is read again by Pneuma as the whole that it was.
namespace pneuma {

/// What a file for ParaView has at most unless somebody says otherwise: 2G.
constexpr std::uint64_t LargestFileBytes = std::uint64_t{2} << 30;

/// The least that may be asked for: arrays have names and sizes in front of them.
constexpr std::uint64_t LeastFileBytes = std::uint64_t{64} << 10;

/// What the arrays of a surface add to its file, bytes.
struct ArrayBytes {
  std::uint64_t ofPoint = 0;
  std::uint64_t ofTriangle = 0;
};

/// Where pieces end, the last one with the last triangle, so that no file has more bytes than that;
/// one end if all of it fits into one.
/// @pre largestBytes >= LeastFileBytes
std::vector<std::size_t> pieceEnds(const TriangleMesh& mesh, std::uint64_t largestBytes,
                                   const ArrayBytes& arrays = {});

/// Likewise of branches; a single branch that is larger has a file of its own.
std::vector<std::size_t> pieceEnds(const AirwayTree& tree, std::uint64_t largestBytes);

/// The files of so many pieces: of one "rul.vtp" itself; of two "rul/rul_0.vtp" and
/// "rul/rul_1.vtp".
std::vector<std::filesystem::path> pieceFiles(const std::filesystem::path& file, std::size_t count);

/// Writes the files pieceFiles(); the folder of several is made. Triangles keep their order from
/// piece to piece; points that pieces share are in each of them.
/// @param ends of pieceEnds()
/// @throws as writeSurface()
void writeSurfacePieces(const std::filesystem::path& file, const TriangleMesh& mesh,
                        const std::vector<std::size_t>& ends, const SurfaceArrays& arrays = {});

/// Likewise of a tree: branches keep their order, and their columns are those of all of it.
/// @throws OutputFailed
void writeTreePieces(const std::filesystem::path& file, const AirwayTree& tree,
                     const std::map<std::string, std::string>& metadata,
                     const std::vector<std::size_t>& ends);

/// The first piece of a lobe, a lung or a tree that a folder holds in pieces alone, as a case is
/// exported: "rul/rul_0.vtp" without "rul.vtp"; empty if there is none.
std::filesystem::path firstPieceIn(const std::filesystem::path& folder);

/// @throws Unsupported if a folder that is to be read holds something in pieces
void requireWhole(const std::filesystem::path& folder);

}  // namespace pneuma
