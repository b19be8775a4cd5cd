#pragma once

#include <functional>
#include <vector>

#include "cli/picture_arguments.h"
#include "cli/slice_arguments.h"
#include "pipeline/lung_model.h"
#include "render/picture.h"

namespace pneuma::cli {

/// Draws the 3-D view in this size.
using ScenePicture = std::function<Picture(const PictureSize& size)>;

/// Slices of the model's CT with its labels over them, side by side.
/// @param wanted one or more
/// @param size of the whole, give or take the pixels that cannot be shared out evenly
/// @param scene stands at the second place, as in the window; none if empty
/// @throws InvalidOption if there is no such slice, or no room for so many
Picture sliceSheet(const LungModel& model, const std::vector<WantedSlice>& wanted,
                   const std::vector<Vec3>& markers, const SliceLook& look, const PictureSize& size,
                   const ScenePicture& scene = {});

}  // namespace pneuma::cli
