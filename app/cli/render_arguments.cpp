#include "cli/render_arguments.h"

#include <algorithm>

#include "cli/series_picture.h"
#include "io/ct_file.h"
#include "render/grey_window.h"

namespace pneuma::cli {

void addDrawingArguments(CLI::App& app, DrawingArguments& arguments) {
  addFiles(app, "INPUTS", arguments.inputs,
           "Surfaces, trees and folders of them, mixed; or a CT, of which slices are drawn; or a "
           "breath (.pvd).")
      ->required();
  addPictureArguments(app, arguments, "Width and height in pixels.");
  arguments.opacityOption = app.get_option("--opacity");
  arguments.viewOption = app.get_option("--view");
  addSliceArguments(app, arguments.slices);
  addRepeatable(app, "--hide", arguments.hidden, "{RUL|RML|RLL|LUL|LLL}",
                "Leave out this lobe's surface. May be repeated.");
  app.add_flag("--no-annotations", arguments.noAnnotations,
               "Leave out scale bar, orientation letters and legend.");
  addFields(app, arguments);
}

std::vector<Lobe> hiddenLobes(const std::vector<std::string>& names) {
  std::vector<Lobe> lobes;
  for (const std::string& name : names) {
    const std::optional<Lobe> lobe = lobeOfShortName(name);
    if (!lobe) {
      throw InvalidOption("--hide knows RUL, RML, RLL, LUL, LLL, but '" + name + "' was given");
    }
    lobes.push_back(*lobe);
  }
  return lobes;
}

bool drawsSeries(const DrawingArguments& arguments) {
  return std::ranges::any_of(arguments.inputs, isSeries);
}

bool drawsSlices(const DrawingArguments& arguments) {
  return arguments.slices.any() || std::ranges::any_of(arguments.inputs, isCtPath);
}

void requireSpelled(const DrawingArguments& arguments) {
  (void)viewDirection(arguments.view);
  (void)hiddenLobes(arguments.hidden);
  (void)greyWindow(arguments.slices.window);
  (void)wantedSlices(arguments.slices.slices);
  for (const std::string& marker : arguments.slices.markers) (void)markerPoint(marker);
  if (drawsSlices(arguments) && arguments.stereo != Stereo::None) {
    throw InvalidOption("slices have no depth; leave --stereo out or give surfaces and trees only");
  }
  if (drawsSeries(arguments) && arguments.inputs.size() > 1) {
    throw InvalidOption("a breath (.pvd) is drawn alone; its airways are in it");
  }
}

}  // namespace pneuma::cli
