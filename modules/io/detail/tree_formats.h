#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>

#include "anatomy/airway_tree.h"
#include "io/tree_file.h"

/// The single formats behind readTree() and writeTree().
namespace pneuma {

using Metadata = std::map<std::string, std::string>;

// `name` is the file's, in quotation marks, for messages.
TreeFile readVtkTree(const std::string& content, const std::string& name);
TreeFile readSwc(const std::string& content, const std::string& name);
TreeFile readTreeCsv(const std::string& content, const std::string& name);
TreeFile readTreeJson(const std::string& content, const std::string& name);

std::string vtpText(const AirwayTree& tree, const Metadata& metadata);

/// Branches from `first` to before `end`; "id", "parent" and orders are those of the whole tree,
/// and the field data PieceKey say which branches they are.
std::string vtpText(const AirwayTree& tree, const Metadata& metadata, std::size_t first,
                    std::size_t end);

std::string swcText(const AirwayTree& tree, const Metadata& metadata);
std::string treeCsvText(const AirwayTree& tree, const Metadata& metadata);
std::string treeJsonText(const AirwayTree& tree, const Metadata& metadata);

/// @throws InvalidInput for a tree without a branch or that is none, and for names of field data
/// that not every format holds
void requireWritable(const AirwayTree& tree, const Metadata& metadata);

/// x and y change their sign between RAS and LPS. Turns the whole tree about the z axis.
AirwayTree turnedFromRas(const AirwayTree& tree);

/// Reports what turnedFromRas() did.
std::string turnedFromRasNote(const std::string& name);

/// Keys of field data and comments that say how to read the file; the rest is metadata.
inline constexpr std::string_view SpaceKey = "SPACE";
inline constexpr std::string_view UnitsKey = "units";
/// Of a VTP that holds some branches of a tree, which is not read as a whole one.
inline constexpr std::string_view PieceKey = "piece";
inline constexpr std::string_view Units = "mm, ml, fraction";

inline constexpr std::string_view TreeJsonSchema = "pneuma/tree/1";

/// The first line of SWC and CSV files that Pneuma wrote.
inline constexpr std::string_view TreeTextTitle = "# Pneuma airway tree";

// Keys of comments in SWC and CSV files; they have blanks, which keys of metadata have not.
inline constexpr std::string_view PointCountKey = "number of points";
inline constexpr std::string_view BranchCountKey = "number of branches";
inline constexpr std::string_view BetweenKey = "points between branch ends";
inline constexpr std::array<std::string_view, 3> OriginKeys = {"measured points", "template points",
                                                               "grown points"};

/// Type of a point in an SWC file: this and the value of its lobe. Below are types with a meaning
/// of their own (soma, axon ...).
inline constexpr int FirstSwcType = 5;

}  // namespace pneuma
