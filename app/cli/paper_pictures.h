#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "pipeline/lung_model.h"
#include "render/picture.h"

namespace pneuma::cli {

struct PaperPicture {
  std::string name;  ///< file name
  Picture picture;
};

constexpr std::array<std::string_view, 3> paperPictureNames() {
  return {"fig1.png", "fig4.png", "fig5.png"};
}

/// The figures of Huang 2004 made again from our own tree: the lobes (Fig. 1), the tree up to
/// generation 2, 3, 6, 8, 12 and 14 on one sheet (Fig. 4), the whole tree from the front with the
/// upper lobe red, the middle one green and the lower one blue (Fig. 5).
/// @throws NoRendering, Cancelled
std::vector<PaperPicture> paperPictures(const LungModel& model, const Progress& progress);

/// @throws NoRendering saying how to get a display
void requireDisplay();

}  // namespace pneuma::cli
