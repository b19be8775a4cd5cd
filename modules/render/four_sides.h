#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/progress.h"
#include "render/picture.h"
#include "render/scene.h"

namespace pneuma {

/// A picture and what it shows, for people.
struct SideView {
  std::string caption;
  Picture picture;
};

/// Pixels of the pictures of a report, each way.
inline constexpr int ReportPictureSide = 480;

/// Lungs and airways from the front, the left, behind and the right, on white as paper is. Empty if
/// there is nothing to show.
/// @throws NoRendering, Cancelled
std::vector<SideView> fourSides(const std::vector<SceneSurface>& surfaces,
                                const std::shared_ptr<const AirwayTree>& tree,
                                const Progress& progress = {}, int side = ReportPictureSide);

}  // namespace pneuma
