#include "views/case_pictures.h"

#include "render/four_sides.h"
#include "views/model_scene.h"

namespace pneuma {

std::vector<PagePicture> casePictures(const LungModel& model, const Progress& progress) {
  std::vector<PagePicture> pictures;
  for (const SideView& view : fourSides(sceneSurfaces(model.surfaces), treeOf(model), progress)) {
    pictures.push_back({view.caption, pngText(view.picture)});
  }
  return pictures;
}

}  // namespace pneuma
