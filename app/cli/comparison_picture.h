#pragma once

#include "cli/picture_arguments.h"
#include "pipeline/compare_trees.h"
#include "render/picture.h"

namespace pneuma::cli {

/// The trees beside each other, up to four a row, all from the same place and with one scale of
/// colours; the surfaces of `organ` round each. Captions tell name, method and terminals.
/// @throws NoRendering, Cancelled
Picture comparisonPicture(const TreeComparison& comparison, const LungModel& organ,
                          const PictureArguments& arguments, const Progress& progress);

}  // namespace pneuma::cli
