#include <algorithm>
#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/command_line.h"
#include "cli/drawn_picture.h"
#include "cli/files.h"
#include "cli/text.h"
#include "io/atomic_file.h"
#include "io/staged_folder.h"
#include "pipeline/regress_report.h"
#include "render/picture.h"

namespace pneuma::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* PageName = "index.html";

struct RegressArguments {
  fs::path list;
  std::vector<std::string> only;
  bool update = false;
};

/// A picture of the list, its options read. On the heap: the parser refers to the arguments.
struct ReadyPicture {
  ListedPicture listed;
  fs::path reference;
  DrawingArguments drawing;
  CLI::App parser;
};

using ReadyPictures = std::vector<std::unique_ptr<ReadyPicture>>;

void requireThere(const PictureList& list, const std::string& picture, const fs::path& path) {
  std::error_code error;
  if (fs::exists(path, error)) return;
  throw InputMissing("'" + list.file.string() + "' cannot be used: \"" + picture + "\" needs '" +
                     path.string() + "', which is not there");
}

void readOptions(const PictureList& list, ReadyPicture& picture) {
  addDrawingArguments(picture.parser, picture.drawing);
  picture.parser.set_help_flag("");
  std::vector<std::string> words = picture.listed.options;
  const auto saysSize = [](const std::string& word) { return word.starts_with("--size"); };
  if (!list.size.empty() && std::ranges::none_of(words, saysSize)) {
    words.insert(words.end(), {"--size", list.size});
  }
  for (const fs::path& input : picture.listed.inputs) words.push_back(input.string());
  try {
    (void)parseWords(picture.parser, "a picture", "render", std::move(words));
    requireSpelled(picture.drawing);
  } catch (const InvalidOption& error) {
    throw InvalidInput("'" + list.file.string() + "' cannot be used: \"" + picture.listed.name +
                       "\": " + error.what());
  }
  const auto place = [&](fs::path& path) {
    path = pathInFolder(list, picture.listed.name, path);
    requireThere(list, picture.listed.name, path);
  };
  for (fs::path& input : picture.drawing.inputs) place(input);
  if (!picture.drawing.slices.labels.empty()) place(picture.drawing.slices.labels);
}

ReadyPictures readyPictures(const PictureList& list, const std::vector<std::string>& only) {
  ReadyPictures ready;
  for (const ListedPicture& listed : list.pictures) {
    auto picture = std::make_unique<ReadyPicture>();
    picture->listed = listed;
    picture->reference = pathInFolder(list, listed.name, listed.reference);
    if (listed.ready.empty()) {
      readOptions(list, *picture);
    } else {
      requireThere(list, listed.name, pathInFolder(list, listed.name, listed.ready));
    }
    const auto isPart = [&](const std::string& part) {
      return listed.name.find(part) != std::string::npos;
    };
    if (only.empty() || std::ranges::any_of(only, isPart)) ready.push_back(std::move(picture));
  }
  if (ready.empty()) {
    throw InvalidOption("--only leaves no picture of '" + list.file.string() +
                        "'; it is a part of a picture's name");
  }
  return ready;
}

bool isWithin(const fs::path& path, const fs::path& folder) {
  const fs::path from = fs::weakly_canonical(folder);
  const fs::path inside = fs::weakly_canonical(fs::absolute(path)).lexically_relative(from);
  return !inside.empty() && *inside.begin() != fs::path("..");
}

/// Throws now what would be thrown after the work.
void requireUsable(const PictureList& list, const ReadyPictures& pictures,
                   const RegressArguments& arguments, const CommonOptions& common) {
  if (isWithin(common.output, list.folder)) {
    throw InvalidOption("the page would go to '" + common.output.string() +
                        "', which is in the folder of the pictures; choose another by --output");
  }
  requireFolderOutput(common.output);
  std::error_code error;
  if (!common.force && fs::exists(common.output / PageName, error)) {
    throw OutputFailed("'" + (common.output / PageName).string() +
                       "' exists already; add --force to replace it, or choose another folder");
  }
  for (const auto& picture : pictures) {
    if (!arguments.update) continue;
    if (!isWithin(picture->reference, list.folder)) {
      throw InvalidInput("the reference '" + picture->reference.string() +
                         "' is a link that leaves its folder; it is not written to");
    }
  }
  const auto needsDisplay = [](const std::unique_ptr<ReadyPicture>& picture) {
    return picture->listed.ready.empty() && !drawsSlices(picture->drawing);
  };
  if (std::ranges::any_of(pictures, needsDisplay)) requireDisplay();
}

std::string sizeText(const Picture& picture) {
  return std::to_string(picture.width) + " x " + std::to_string(picture.height) + " pixels";
}

/// Compares a picture with its reference and puts what the page shows into its folder.
ComparedPicture compared(const ReadyPicture& ready, const Picture& picture, const fs::path& page) {
  ComparedPicture result;
  result.listed = ready.listed;
  const auto keep = [&](PagePart part, const std::string& png) {
    writeFile(page / pageFile(ready.listed.name, part), png);
  };
  keep(PagePart::New, pngText(picture));
  std::error_code error;
  if (!fs::exists(ready.reference, error)) {
    result.note = "there is no reference '" + ready.listed.reference.string() + "' yet";
    return result;
  }
  const Picture reference = readPng(ready.reference);
  keep(PagePart::Reference, readFile(ready.reference));
  if (picture.width != reference.width || picture.height != reference.height) {
    result.outcome = PictureOutcome::Differs;
    result.note = "it has " + sizeText(picture) + ", its reference " + sizeText(reference);
    return result;
  }
  const PictureDifference found = compare(picture, reference);
  keep(PagePart::Difference, pngText(found.difference));
  result.score = found.error;
  result.outcome =
      found.error <= ready.listed.limit ? PictureOutcome::Same : PictureOutcome::Differs;
  return result;
}

/// Draws a picture, or reads the one that is there. Complaints name it.
Picture pictureOf(const PictureList& list, const ReadyPicture& ready, PictureDrawer& drawer,
                  const Progress& progress) {
  const ListedPicture& listed = ready.listed;
  try {
    if (!listed.ready.empty()) return readPng(pathInFolder(list, listed.name, listed.ready));
    return drawer.draw(ready.drawing, progress).picture;
  } catch (const Error& error) {
    throw Error(error.code(), "\"" + listed.name + "\" of '" + list.file.string() +
                                  "' cannot be drawn: " + error.what());
  }
}

std::vector<ComparedPicture> drawnAgain(const PictureList& list, const ReadyPictures& pictures,
                                        const fs::path& page, const Progress& progress) {
  std::vector<ComparedPicture> results;
  PictureDrawer drawer;
  for (const auto& ready : pictures) {
    const double count = static_cast<double>(pictures.size());
    const double done = static_cast<double>(results.size()) / count;
    const Progress part = progress.part(done, done + 1.0 / count, ready->listed.name);
    part.report(0.0);
    results.push_back(compared(*ready, pictureOf(list, *ready, drawer, part), page));
  }
  return results;
}

/// Makes the new pictures of those that differ, or had none, their references.
void update(const ReadyPictures& pictures, std::vector<ComparedPicture>& results,
            const fs::path& page) {
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (results[i].outcome == PictureOutcome::Same) continue;
    const fs::path& reference = pictures[i]->reference;
    makeFolder(reference.parent_path());
    writeFile(reference, readFile(page / pageFile(results[i].listed.name, PagePart::New)));
    results[i].updated = true;
  }
}

std::string textOfResults(const std::vector<ComparedPicture>& results) {
  std::vector<std::vector<std::string>> rows = {{"picture", "difference", "limit", ""}};
  for (const ComparedPicture& result : results) {
    rows.push_back({result.listed.name, result.compared() ? fixed(result.score, 4) : "",
                    fixed(result.listed.limit, 4),
                    textOf(result.outcome) + (result.updated ? ", updated" : "")});
  }
  return table(rows);
}

/// Whatever does not look as it did, one line each on standard error.
ExitCode verdict(const std::vector<ComparedPicture>& results, const PictureList& list) {
  for (const ComparedPicture& result : results) {
    if (result.outcome != PictureOutcome::Differs || result.updated) continue;
    std::cerr << "pneuma: over its limit: " << result.listed.name << ": "
              << (result.compared()
                      ? fixed(result.score, 4) + ", the limit is " + textOf(result.listed.limit)
                      : result.note)
              << "\n";
  }
  const auto isMissing = [](const ComparedPicture& result) {
    return result.outcome == PictureOutcome::Missing && !result.updated;
  };
  const auto differs = [](const ComparedPicture& result) {
    return result.outcome == PictureOutcome::Differs && !result.updated;
  };
  const auto missing = std::ranges::count_if(results, isMissing);
  if (missing > 0) {
    const ComparedPicture& first = *std::ranges::find_if(results, isMissing);
    std::cerr << "pneuma: " << missing << (missing == 1 ? " reference is" : " references are")
              << " missing, first '" << (list.folder / first.listed.reference).string()
              << "'; look at the page, then write them with --update\n";
  }
  if (std::ranges::any_of(results, differs)) return ExitCode::ComparisonOverLimit;
  return missing > 0 ? ExitCode::InputMissing : ExitCode::Done;
}

ExitCode runRegress(const RegressArguments& arguments, const CommonOptions& common,
                    const Progress& progress) {
  const PictureList list = readPictureList(arguments.list);
  const ReadyPictures pictures = readyPictures(list, arguments.only);
  requireUsable(list, pictures, arguments, common);
  StagedFolder staged(common.output);
  std::vector<ComparedPicture> results = drawnAgain(list, pictures, staged.path(), progress);
  if (arguments.update) update(pictures, results, staged.path());
  writeFile(staged.path() / PageName, regressPage(list, results));
  staged.keep(common.existing());
  progress.report(1.0);
  if (common.json) {
    std::cout << jsonText(
        regressReport(list, results, {{"only", arguments.only}, {"update", arguments.update}}));
  } else {
    std::cout << textOfResults(results);
    if (!common.quiet) {
      std::cout << countOf(results, PictureOutcome::Same) << " of " << results.size()
                << " look as their references do; see " << (common.output / PageName).string()
                << "\n";
    }
  }
  return verdict(results, list);
}

}  // namespace

Run declareRegress(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<RegressArguments>();
  app.add_option("LIST", arguments->list,
                 "A folder with pictures.json, or such a list of another name: what is drawn, how, "
                 "and what it is compared with.")
      ->type_name("FILE")
      ->required();
  common.output = "regress";
  addOutput(app, common, "FOLDER",
            "Where the page goes that shows reference, new picture and difference: index.html.")
      ->default_str(common.output.string());
  app.add_flag("--update", arguments->update,
               "Make the new pictures of those that differ, or have none, their references.");
  addRepeatable(app, "--only", arguments->only, "TEXT",
                "Only pictures whose names hold this. May be repeated.");
  addJson(app, common);
  return [arguments, &common](const Progress& progress) {
    return runRegress(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
