#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "anatomy/airway_tree.h"

namespace pneuma {

/// An airway tree as it stands in a file.
struct TreeFile {
  AirwayTree tree;
  std::string format;                           ///< "VTP", "VTU", "SWC", "CSV", "JSON"
  std::map<std::string, std::string> metadata;  ///< field data: method, options, seed, version, ...
  std::vector<std::string> notes;               ///< whole sentences: what was converted or left out
};

/// Reads a tree: VTP or VTU poly-lines or line cells with a point array `radius` (chains of points
/// become branches from bifurcation to bifurcation), SWC, CSV, JSON. Files that Pneuma wrote come
/// back equal; branches of others are marked Origin::Measured. The root is the wider end if the
/// file does not say (a VTU of line cells has no direction).
/// @throws InputMissing, InvalidInput (damaged, a cycle, two roots, no radius, NaN), Unsupported
TreeFile readTree(const std::filesystem::path& path);

/// True if the file at `path` looks like a tree rather than a surface (content first).
bool isTreeFile(const std::filesystem::path& path);

/// Writes VTP, SWC, CSV or JSON by the extension; arrays and columns as in docs/vtp-format.md.
/// VTP and JSON read back equal; SWC keeps points, radii, topology and lobes; CSV everything but
/// `via`.
/// @throws OutputFailed; Unsupported for another extension
void writeTree(const std::filesystem::path& path, const AirwayTree& tree,
               const std::map<std::string, std::string>& metadata = {});

/// The same as writeTree() without a file, `format` being "vtp", "swc", "csv" or "json".
std::string treeText(const AirwayTree& tree, const std::string& format,
                     const std::map<std::string, std::string>& metadata = {});

}  // namespace pneuma
