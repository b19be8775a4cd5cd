#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/files.h"
#include "cli/model_scene.h"
#include "cli/picture_arguments.h"
#include "cli/text.h"
#include "render/picture.h"

namespace pneuma::cli {
namespace {

struct RenderArguments : PictureArguments {
  std::vector<std::filesystem::path> inputs;
  std::vector<std::string> hidden;
  bool noAnnotations = false;
  std::filesystem::path reference;
  std::filesystem::path difference;
  double threshold = 0.03;  ///< a field

  static constexpr auto fields() {
    return std::tuple{Field{"threshold", &RenderArguments::threshold, "", Range{0.0, 1.0},
                            "How different from --reference the picture may look."}};
  }
};

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

void requireUsable(const RenderArguments& arguments, const CommonOptions& common) {
  if (!arguments.difference.empty() && arguments.reference.empty()) {
    throw InvalidOption("--diff needs --reference, the picture to compare with");
  }
  requirePngOutput(common.output, common.existing());
  if (!arguments.difference.empty()) requirePngOutput(arguments.difference, common.existing());
  if (!arguments.reference.empty()) (void)readPng(arguments.reference);
  requireDisplay();
}

ExitCode runRender(const RenderArguments& arguments, const CommonOptions& common,
                   const Progress& progress) {
  const ViewDirection view = viewDirection(arguments.view);
  const std::vector<Lobe> hidden = hiddenLobes(arguments.hidden);
  requireUsable(arguments, common);
  const LungModel model = openFiles(arguments.inputs, progress.part(0.0, 0.5, "reading"));

  Scene scene;
  SceneOptions options = sceneOptions(arguments);
  options.annotations = !arguments.noAnnotations;
  scene.setOptions(options);
  showModel(scene, model, hidden);
  scene.look(view);
  progress.part(0.5, 1.0, "rendering").report(0.0);
  const Picture picture = renderPicture(scene, arguments.size.width, arguments.size.height);
  progress.report(1.0);

  OutputSet outputs;
  outputs.add(common.output);
  writeFile(common.output, pngText(picture), common.existing());
  ExitCode code = ExitCode::Done;
  if (!arguments.reference.empty()) {
    const PictureDifference found = compare(picture, readPng(arguments.reference));
    if (!arguments.difference.empty()) {
      outputs.add(arguments.difference);
      writeFile(arguments.difference, pngText(found.difference), common.existing());
    }
    const bool same = found.error <= arguments.threshold;
    if (!same) code = ExitCode::ComparisonOverLimit;
    std::cout << "difference from " << arguments.reference.string() << ": " << fixed(found.error, 4)
              << ", " << (same ? "within" : "over") << " the limit of "
              << fixed(arguments.threshold, 4) << "\n";
  }
  outputs.keep();
  if (!common.quiet) {
    printWarnings(model.warnings);
    std::cout << common.output.string() << ": " << picture.width << " x " << picture.height
              << " pixels\n";
  }
  return code;
}

}  // namespace

Run declareRender(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<RenderArguments>();
  addFiles(app, "INPUTS", arguments->inputs, "Surfaces, trees and folders of them, mixed.")
      ->required();
  addOutput(app, common, "FILE", "Where the picture goes: .png.")->required();
  addPictureArguments(app, *arguments, "Width and height in pixels.");
  addRepeatable(app, "--hide", arguments->hidden, "{RUL|RML|RLL|LUL|LLL}",
                "Leave out this lobe's surface. May be repeated.");
  app.add_flag("--no-annotations", arguments->noAnnotations,
               "Leave out scale bar, orientation letters and legend.");
  app.add_option("--reference", arguments->reference, "Compare with this picture; exit 8 if over.")
      ->type_name("FILE");
  app.add_option("--diff", arguments->difference, "Write the difference from --reference here.")
      ->type_name("FILE");
  addFields(app, *arguments);
  return [arguments, &common](const Progress& progress) {
    return runRender(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
