#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "render/slice_picture.h"

namespace pneuma::cli {

/// One slice as it is asked for: in the middle unless a number or a position is given.
struct WantedSlice {
  SlicePlane plane = SlicePlane::Axial;
  std::optional<int> number;  ///< from 1: up from the feet, from front to back, right to left
  std::optional<double> positionMm;  ///< LPS
};

/// How slices of a CT are drawn.
struct SliceArguments {
  std::vector<std::string> slices;  ///< as typed
  std::filesystem::path labels;
  std::string window = "lung";
  std::vector<std::string> markers;
  bool outline = false;

  /// True if the user asks for something that only a CT has.
  bool any() const { return !slices.empty() || !labels.empty() || !markers.empty() || outline; }
};

void addSliceArguments(CLI::App& app, SliceArguments& arguments);

/// "coronal", "axial:120", "sagittal:-55.5mm", "sagittal:R55.5mm"; "all", and no text at all, are
/// one of each plane. @throws InvalidOption
std::vector<WantedSlice> wantedSlices(const std::vector<std::string>& texts);

/// True if a sheet of these shows the 3-D view too, where there is something in it.
bool wantsScene(const std::vector<std::string>& texts);

/// Where the slice lies along its normal. @throws InvalidOption if the CT has no such slice
double positionMm(const WantedSlice& wanted, const ImageGeometry& geometry);

/// "X,Y,Z" in mm, LPS. @throws InvalidOption
Vec3 markerPoint(const std::string& text);

}  // namespace pneuma::cli
