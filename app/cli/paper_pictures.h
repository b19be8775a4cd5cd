#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "pipeline/reproduce.h"
#include "render/picture.h"

namespace pneuma::cli {

struct PaperPicture {
  std::string name;  ///< file name
  Picture picture;
};

/// File names of the figures that can be drawn of a paper; none for some.
/// @pre the paper can be reproduced
std::vector<std::string_view> paperPictureNames(std::string_view paper);

/// The figures of a paper made again from our own trees.
/// @pre the reproduction kept its figures
/// @throws NoRendering, Cancelled
std::vector<PaperPicture> paperPictures(const Reproduction& reproduction, const Progress& progress);

}  // namespace pneuma::cli
