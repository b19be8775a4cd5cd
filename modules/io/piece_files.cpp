#include "io/piece_files.h"

#include <span>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/detail/text_fields.h"
#include "io/detail/tree_formats.h"
#include "io/surface_file.h"
#include "io/tree_file.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t BytesBefore = 16'384;  ///< of a file: names, sizes and field data
constexpr std::uint64_t BytesOfPoint = 24;
constexpr std::uint64_t BytesOfTriangle = 32;  ///< its points, and where it ends in their list
constexpr std::uint64_t BytesOfTreePoint = BytesOfPoint + 16;  ///< a radius, its place in a line
constexpr std::uint64_t BytesOfBranch = 8 + 66;                ///< where it ends, and its columns

/// @param write gets a file, the first one in it and the end
/// @pre there are several
template <class Write>
void writePieces(const fs::path& file, const std::vector<std::size_t>& ends, Write&& write) {
  const std::vector<fs::path> files = pieceFiles(file, ends.size());
  makeFolder(files.front().parent_path());
  for (std::size_t i = 0; i < files.size(); ++i) write(files[i], i == 0 ? 0 : ends[i - 1], ends[i]);
}

template <class Value>
void take(std::vector<Value>& part, const std::vector<Value>& all,
          const std::vector<std::uint32_t>& taken) {
  part.reserve(taken.size());
  for (const std::uint32_t point : taken) part.push_back(all[point]);
}

/// The values of some points, and of the triangles from the first one to before the end.
SurfaceArrays partOf(const SurfaceArrays& arrays, const std::vector<std::uint32_t>& taken,
                     std::size_t first, std::size_t end) {
  SurfaceArrays part;
  for (const auto& [name, values] : arrays.pointVectors) {
    take(part.pointVectors[name], values, taken);
  }
  for (const auto& [name, values] : arrays.pointValues) take(part.pointValues[name], values, taken);
  for (const auto& [name, marks] : arrays.triangleMarks) {
    const auto place = [&](std::size_t at) {
      return marks.begin() + static_cast<std::ptrdiff_t>(at);
    };
    part.triangleMarks[name].assign(place(first), place(end));
  }
  part.fieldValues = arrays.fieldValues;
  return part;
}

}  // namespace

std::vector<std::size_t> pieceEnds(const TriangleMesh& mesh, std::uint64_t largestBytes,
                                   const ArrayBytes& arrays) {
  const std::uint64_t room = largestBytes - BytesBefore;
  const std::uint64_t ofPoint = BytesOfPoint + arrays.ofPoint;
  const std::uint64_t ofTriangle = BytesOfTriangle + arrays.ofTriangle;
  const std::size_t count = mesh.triangles.size();
  if (ofPoint * mesh.points.size() + ofTriangle * count <= room) return {count};
  std::vector<std::size_t> ends;
  std::vector<std::size_t> pieceWith(mesh.points.size(), 0);  // the last one, from 1 on
  std::uint64_t bytes = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint64_t more = ofTriangle;
    for (const std::uint32_t corner : mesh.triangles[i]) {
      if (pieceWith[corner] != ends.size() + 1) more += ofPoint;
    }
    if (bytes + more > room) {
      ends.push_back(i);
      bytes = 0;
      more = ofTriangle + 3 * ofPoint;
    }
    bytes += more;
    for (const std::uint32_t corner : mesh.triangles[i]) pieceWith[corner] = ends.size() + 1;
  }
  ends.push_back(count);
  return ends;
}

std::vector<std::size_t> pieceEnds(const AirwayTree& tree, std::uint64_t largestBytes) {
  const std::uint64_t room = largestBytes - BytesBefore;
  std::vector<std::size_t> ends;
  std::uint64_t bytes = 0;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const std::uint64_t more = BytesOfBranch + BytesOfTreePoint * (2 + tree[i].via.size());
    if (bytes + more > room && bytes > 0) {
      ends.push_back(i);
      bytes = 0;
    }
    bytes += more;
  }
  ends.push_back(tree.size());
  return ends;
}

std::vector<fs::path> pieceFiles(const fs::path& file, std::size_t count) {
  if (count == 1) return {file};
  std::vector<fs::path> files;
  const std::string stem = file.stem().string();
  for (std::size_t i = 0; i < count; ++i) {
    files.push_back(file.parent_path() / stem / (stem + "_" + std::to_string(i) + ".vtp"));
  }
  return files;
}

void writeSurfacePieces(const fs::path& file, const TriangleMesh& mesh,
                        const std::vector<std::size_t>& ends, const SurfaceArrays& arrays) {
  if (ends.size() == 1) return writeVtpSurface(file, mesh, arrays);
  writePieces(file, ends, [&](const fs::path& piece, std::size_t first, std::size_t end) {
    std::vector<std::uint32_t> taken;
    const TriangleMesh part =
        partOf(mesh, std::span(mesh.triangles).subspan(first, end - first), &taken);
    writeVtpSurface(piece, part, partOf(arrays, taken, first, end));
  });
}

void writeTreePieces(const fs::path& file, const AirwayTree& tree,
                     const std::map<std::string, std::string>& metadata,
                     const std::vector<std::size_t>& ends) {
  if (ends.size() == 1) return writeTree(file, tree, metadata);
  requireWritable(tree, metadata);
  writePieces(file, ends, [&](const fs::path& piece, std::size_t first, std::size_t end) {
    writeFile(piece, vtpText(tree, metadata, first, end));
  });
}

fs::path firstPieceIn(const fs::path& folder) {
  for (const char* stem : {"central", "lll", "left", "lul", "right", "rll", "rml", "rul", "tree"}) {
    const fs::path whole = folder / (stem + std::string(".vtp"));
    const fs::path piece = pieceFiles(whole, 2).front();
    std::error_code error;
    if (fs::is_regular_file(piece, error) && !fs::exists(whole, error)) return piece;
  }
  return {};
}

void requireWhole(const fs::path& folder) {
  const fs::path piece = firstPieceIn(folder);
  if (piece.empty()) return;
  throw Unsupported("the folder " + quoted(folder) +
                    " holds surfaces or trees in pieces for ParaView, as " + quoted(piece) +
                    "; open the project that they are of, or export it again with a larger "
                    "--largest-file");
}

}  // namespace pneuma
