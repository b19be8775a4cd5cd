#include "cli/drawn_picture.h"

#include "cli/series_picture.h"
#include "cli/slice_sheet.h"
#include "views/model_scene.h"

namespace pneuma::cli {
namespace {

Picture scenePicture(const DrawingArguments& arguments, const LungModel& model,
                     const PictureSize& size) {
  Scene scene;
  dress(scene, arguments);
  showModel(scene, model, hiddenLobes(arguments.hidden));
  scene.look(viewDirection(arguments.view));
  return drawnScene(scene, arguments, size);
}

Picture slicesPicture(const DrawingArguments& arguments, const LungModel& model) {
  const SliceArguments& slices = arguments.slices;
  SliceLook look;
  look.window = greyWindow(slices.window);
  if (slices.outline) look.labels = LabelStyle::Outlined;
  if (arguments.opacityOption->count() > 0) look.opacity = arguments.opacity;
  look.annotations = !arguments.noAnnotations;
  std::vector<Vec3> markers;
  for (const std::string& marker : slices.markers) markers.push_back(markerPoint(marker));
  ScenePicture scene;
  if (wantsScene(slices.slices) && (model.surfaces || treeOf(model))) {
    requireDisplay();
    scene = [&](const PictureSize& size) { return scenePicture(arguments, model, size); };
  }
  return sliceSheet(model, wantedSlices(slices.slices), markers, look, arguments.size, scene);
}

}  // namespace

void dress(Scene& scene, const DrawingArguments& arguments) {
  SceneOptions options = sceneOptions(arguments);
  options.annotations = !arguments.noAnnotations;
  scene.setOptions(options);
}

Picture drawnScene(Scene& scene, const DrawingArguments& arguments, const PictureSize& size) {
  return renderStereo(scene, size.width, size.height, {arguments.stereo, arguments.eyeDistanceMm});
}

LungModel PictureDrawer::modelOf(const DrawingArguments& arguments, const Progress& progress) {
  if (drawsSeries(arguments)) {
    const Series series = readSeries(arguments.inputs.front());
    return openMoment(series.moments[series.nearestTo(arguments.time)]);
  }
  if (read_.empty() || read_ != arguments.inputs) {
    read_.clear();  // what follows may throw
    model_ = openFiles(arguments.inputs, progress.part(0.0, 0.7, "reading"));
    read_ = arguments.inputs;
  }
  const LungModel model = model_;
  if (!model.ct && arguments.slices.any()) {
    throw InvalidInput("slices, labels and marks need a CT, and none of the inputs is one");
  }
  if (arguments.slices.labels.empty()) return model;
  return withLabels(model, arguments.slices.labels, progress.part(0.7, 1.0, "reading labels"));
}

DrawnPicture PictureDrawer::draw(const DrawingArguments& arguments, const Progress& progress) {
  const LungModel model = modelOf(arguments, progress.part(0.0, 0.7, "reading"));
  progress.part(0.7, 1.0, "rendering").report(0.0);
  DrawnPicture drawn;
  drawn.picture =
      model.ct ? slicesPicture(arguments, model) : scenePicture(arguments, model, arguments.size);
  drawn.warnings = model.warnings;
  progress.report(1.0);
  return drawn;
}

}  // namespace pneuma::cli
