#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/render_arguments.h"
#include "core/progress.h"
#include "pipeline/lung_model.h"
#include "render/picture.h"

namespace pneuma::cli {

/// Puts the options of a picture into a scene.
void dress(Scene& scene, const DrawingArguments& arguments);

/// What the scene's camera sees, for one eye or for two. @throws NoRendering
Picture drawnScene(Scene& scene, const DrawingArguments& arguments, const PictureSize& size);

struct DrawnPicture {
  Picture picture;
  std::vector<std::string> warnings;  ///< of reading
};

/// Draws pictures one after the other as `pneuma render` does. The files read last are kept for the
/// next picture of the same.
class PictureDrawer {
 public:
  /// @throws InvalidInput, InputMissing, InvalidOption, NoRendering, Cancelled
  DrawnPicture draw(const DrawingArguments& arguments, const Progress& progress = {});

 private:
  LungModel modelOf(const DrawingArguments& arguments, const Progress& progress);

  std::vector<std::filesystem::path> read_;  ///< what `model_` was read from; empty: nothing yet
  LungModel model_;
};

}  // namespace pneuma::cli
