#include <iostream>
#include <memory>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/files.h"
#include "pipeline/project_thumbnail.h"
#include "render/small_picture.h"

namespace pneuma::cli {
namespace {

struct ThumbnailArguments {
  std::filesystem::path project;
  int edgePixels = 256;

  static constexpr auto fields() {
    return std::tuple{Field{"size", &ThumbnailArguments::edgePixels, "pixels", Range{16, 4096},
                            "The longer side at most; a smaller picture stays as it is."}};
  }
};

ExitCode runThumbnail(const ThumbnailArguments& arguments, const CommonOptions& common,
                      const Progress& progress) {
  const std::string name = "'" + arguments.project.string() + "'";
  requirePngOutput(common.output, common.existing());
  requireOtherThanInputs(common.output, {&arguments.project, 1});
  const std::string png = projectThumbnail(arguments.project);
  if (png.empty()) {
    throw Unsupported("the project " + name +
                      " holds no picture: none was saved by the window, which puts one in it");
  }
  const Picture picture = fitted(pngPicture(png, "the picture in " + name), arguments.edgePixels);
  writeFile(common.output, pngText(picture), common.existing());
  progress.report(1.0);
  if (!common.quiet) {
    std::cout << common.output.string() << ": " << picture.width << " x " << picture.height
              << " pixels\n";
  }
  return ExitCode::Done;
}

}  // namespace

Run declareThumbnail(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<ThumbnailArguments>();
  app.add_option("PROJECT", arguments->project, "A project (.pneuma).")
      ->type_name("FILE")
      ->required();
  addOutput(app, common, "FILE", "Where the picture goes: .png.")->required();
  addFields(app, *arguments);
  return [arguments, &common](const Progress& progress) {
    return runThumbnail(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
