#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/files.h"
#include "cli/paper_pictures.h"
#include "cli/picture_arguments.h"
#include "cli/text.h"
#include "pipeline/reproduce.h"
#include "render/picture.h"

namespace pneuma::cli {
namespace {

struct ReproduceArguments {
  std::string paper;
  std::string table;
  std::filesystem::path pictures;
  std::filesystem::path data;
};

/// The tables of all papers, each once.
std::vector<std::string_view> tableNames() {
  std::vector<std::string_view> names;
  for (const std::string_view paper : reproduciblePapers()) {
    for (const std::string_view table : reproducibleTables(paper)) {
      if (std::ranges::find(names, table) == names.end()) names.push_back(table);
    }
  }
  return names;
}

/// Where people's data are, if the paper needs them.
std::filesystem::path dataOf(const ReproduceArguments& arguments) {
  if (!needsData(arguments.paper)) {
    if (arguments.data.empty()) return {};
    throw InvalidOption("'" + arguments.paper + "' needs no data; leave out --data");
  }
  if (!arguments.data.empty()) return arguments.data;
  const char* named = std::getenv("PNEUMA_TEST_DATA");
  return named != nullptr ? named : "";
}

void requireUsable(const ReproduceArguments& arguments, const CommonOptions& common) {
  requireReproducible(arguments.paper, arguments.table);
  if (arguments.pictures.empty()) return;
  if (paperPictureNames(arguments.paper).empty()) {
    throw InvalidOption("'" + arguments.paper + "' has no figures to draw; leave out --pictures");
  }
  std::error_code error;
  if (std::filesystem::exists(arguments.pictures, error)) {
    for (const std::string_view name : paperPictureNames(arguments.paper)) {
      requirePngOutput(arguments.pictures / name, common.existing());
    }
  } else {
    requireOutput(arguments.pictures, common.existing());  // the folder itself can be made
  }
  requireDisplay();
}

ExitCode runReproduce(const ReproduceArguments& arguments, const CommonOptions& common,
                      const Progress& progress) {
  requireUsable(arguments, common);
  const bool draw = !arguments.pictures.empty();
  const Reproduction reproduction = reproduce(
      arguments.paper, {.table = arguments.table, .figures = draw, .data = dataOf(arguments)},
      progress.part(0.0, draw ? 0.7 : 1.0, "repeating the experiment"));
  OutputSet outputs;
  if (draw) {
    outputs.addFolder(arguments.pictures);
    for (const PaperPicture& picture :
         paperPictures(reproduction, progress.part(0.7, 1.0, "drawing the figures"))) {
      outputs.add(arguments.pictures / picture.name);
      writeFile(arguments.pictures / picture.name, pngText(picture.picture), common.existing());
    }
  }
  progress.report(1.0);
  outputs.keep();
  std::cout << (common.json ? jsonText(toJson(reproduction)) : textOf(reproduction));
  return reproduction.ok() ? ExitCode::Done : ExitCode::CheckFailed;
}

}  // namespace

Run declareReproduce(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<ReproduceArguments>();
  app.add_option("PAPER", arguments->paper, "The paper.")
      ->type_name(choiceType(reproduciblePapers()))
      ->required();
  app.add_option("--table", arguments->table, "Only this table of the paper.")
      ->type_name(choiceType(tableNames()));
  app.add_option("--pictures", arguments->pictures,
                 "Draw the paper's figures into this folder; made if it is not there.")
      ->type_name("FOLDER");
  app.add_option("--data", arguments->data,
                 "Folder of real data, for motion; else PNEUMA_TEST_DATA.")
      ->type_name("FOLDER");
  addForce(app, common);
  addJson(app, common);
  return [arguments, &common](const Progress& progress) {
    return runReproduce(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
