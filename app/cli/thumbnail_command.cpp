#include <iostream>
#include <memory>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/files.h"
#include "pipeline/project_thumbnail.h"
#include "render/small_picture.h"

namespace pneuma::cli {
namespace {

constexpr int LargestSide = 4096;  ///< of a picture in a project, pixels

struct ThumbnailArguments {
  std::filesystem::path project;
  int edgePixels = 256;

  static constexpr auto fields() {
    return std::tuple{Field{"size", &ThumbnailArguments::edgePixels, "pixels",
                            Range{16, LargestSide},
                            "The longer side at most; a smaller picture stays as it is."}};
  }
};

ExitCode runThumbnail(const ThumbnailArguments& arguments, const CommonOptions& common,
                      const Progress& progress) {
  const std::string name = "'" + arguments.project.string() + "'";
  if (common.output.filename().native().starts_with('.')) {
    requireOutput(common.output, common.existing());  // a file manager's own, of any ending
  } else {
    requirePngOutput(common.output, common.existing());
  }
  requireOtherThanInputs(common.output, {&arguments.project, 1});
  const std::string png = projectThumbnail(arguments.project);
  if (png.empty()) {
    throw Unsupported("the project " + name +
                      " holds no picture: none was saved by the window, which puts one in it");
  }
  // File managers ask for it before anybody has decided to trust the file.
  const Picture picture =
      fitted(pngPicture(png, "the picture in " + name, LargestSide), arguments.edgePixels);
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
  addOutput(app, common, "FILE", "Where the picture goes: .png, or a hidden file of any ending.")
      ->required();
  addFields(app, *arguments);
  return [arguments, &common](const Progress& progress) {
    return runThumbnail(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
