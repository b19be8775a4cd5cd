#include <algorithm>
#include <array>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <random>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/files.h"
#include "cli/text.h"
#include "io/dicom_anonymizer.h"
#include "io/dicom_series.h"
#include "io/input_files.h"
#include "pipeline/report.h"

namespace pneuma::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t LongestKeyFile = std::size_t{1} << 16;
constexpr std::size_t LongestDicom = std::size_t{4} << 30;
constexpr std::size_t ShortestKey = 8;

struct AnonymizeArguments {
  fs::path input;
  std::optional<std::string> key;
  std::optional<fs::path> keyFile;

  bool keyGiven() const { return key || keyFile; }
};

/// What was done to all files.
struct Summary {
  std::size_t files = 0;
  std::size_t uidsReplaced = 0;
  std::size_t privateRemoved = 0;
  std::map<std::string, std::size_t> removed;
  std::map<std::string, int> series;  ///< by new UID, in the order met, from 1
  std::size_t withoutPicture = 0;     ///< DICOM files left out
  std::size_t others = 0;             ///< files left out that are no DICOM
  std::vector<std::string> warnings;
};

/// The text, or the content of the file; a random one if none is given.
std::string keyOf(const AnonymizeArguments& arguments) {
  if (!arguments.keyGiven()) {
    std::random_device device;
    std::string key;
    for (int i = 0; i < 8; ++i) key += std::to_string(device());
    return key;
  }
  const std::string tooShort =
      " is shorter than " + std::to_string(ShortestKey) + " characters; take one nobody can guess";
  if (arguments.key) {
    std::error_code error;
    if (fs::is_regular_file(*arguments.key, error)) {
      throw InvalidOption("--key takes the key itself, but '" + *arguments.key +
                          "' is a file; give it by --key-file");
    }
    if (arguments.key->size() < ShortestKey) throw InvalidOption("the --key" + tooShort);
    return *arguments.key;
  }
  std::string key = readFile(*arguments.keyFile, LongestKeyFile);
  while (!key.empty() && (key.back() == '\n' || key.back() == '\r')) key.pop_back();
  if (key.size() < ShortestKey) {
    throw InvalidInput("the key in '" + arguments.keyFile->string() + "'" + tooShort);
  }
  return key;
}

/// The DICOM files; those beside them are counted.
std::vector<fs::path> dicomFiles(const fs::path& input, std::size_t& others) {
  std::error_code error;
  if (!fs::exists(input, error)) {
    throw InputMissing("'" + input.string() + "' is not there; check the path");
  }
  std::vector<fs::path> files = {input};
  if (fs::is_directory(input, error)) {
    files = filesBelow(input);
    others = std::erase_if(files, [](const fs::path& file) { return !isDicomFile(file); });
  }
  if (files.empty()) throw InputMissing("there is no DICOM file in '" + input.string() + "'");
  return files;
}

void requireEmptyFolder(const fs::path& folder) {
  std::error_code error;
  requireFolderOutput(folder);
  if (fs::exists(folder, error) && !fs::is_empty(folder, error)) {
    throw OutputFailed("'" + folder.string() +
                       "' is not an empty folder; choose a new one, so that nothing there is "
                       "mistaken for anonymized");
  }
}

std::string numbered(int number, int digits) {
  std::string text = std::to_string(number);
  text.insert(0, static_cast<std::size_t>(std::max(0, digits - static_cast<int>(text.size()))),
              '0');
  return text;
}

/// Names of files and folders may tell as much as what is in them: all are new.
void writeAnonymized(const AnonymizedDicom& file, const fs::path& folder, Summary& summary,
                     std::map<int, int>& counts, OutputSet& outputs) {
  const int next = static_cast<int>(summary.series.size()) + 1;
  const int series = summary.series.emplace(file.seriesUid, next).first->second;
  const fs::path target = folder / ("series" + numbered(series, 2));
  outputs.addFolder(target);
  const fs::path path = target / (numbered(++counts[series], 5) + ".dcm");
  outputs.add(path);
  writeFile(path, file.content);
}

Json anonymizeReport(const AnonymizeArguments& arguments, const fs::path& output,
                     const Summary& summary) {
  Json report = reportEnvelope("pneuma/anonymize/1", {}, {{"key_given", arguments.keyGiven()}}, 0);
  report["output"] = output.string();
  report["files"] = summary.files;
  report["series"] = summary.series.size();
  report["uids_replaced"] = summary.uidsReplaced;
  report["private_removed"] = summary.privateRemoved;
  report["removed"] = summary.removed;
  report["left_out"] = summary.withoutPicture + summary.others;
  report["warnings"] = summary.warnings;
  return report;
}

std::string reportText(const fs::path& output, const Summary& summary) {
  const auto count = [](std::size_t n) { return grouped(static_cast<double>(n)); };
  std::vector<std::vector<std::string>> rows = {{"removed or cleaned", "times"}};
  for (const auto& [name, times] : summary.removed) rows.push_back({"  " + name, count(times)});
  rows.push_back({"  private attributes", count(summary.privateRemoved)});
  rows.push_back({"UIDs replaced", count(summary.uidsReplaced)});
  return output.string() + ": " + count(summary.files) + " files of " +
         count(summary.series.size()) + " series, anonymized\n" + table(rows);
}

ExitCode runAnonymize(const AnonymizeArguments& arguments, const CommonOptions& common,
                      const Progress& progress) {
  requireEmptyFolder(common.output);
  const std::string key = keyOf(arguments);
  Summary summary;
  const std::vector<fs::path> files = dicomFiles(arguments.input, summary.others);
  std::map<int, int> counts;
  OutputSet outputs;
  outputs.addFolder(common.output);
  for (std::size_t i = 0; i < files.size(); ++i) {
    progress.part(0.0, 1.0, "anonymizing")
        .report(static_cast<double>(i) / static_cast<double>(files.size()));
    const AnonymizedDicom file =
        anonymizedDicom(readFile(files[i], LongestDicom), key, files[i].filename().string());
    if (!file.hasPixels) {
      ++summary.withoutPicture;
      continue;
    }
    if (!file.burnedIn.empty()) {
      summary.warnings.push_back("'" + files[i].filename().string() + "': " + file.burnedIn +
                                 "; look at it before you pass it on");
    }
    ++summary.files;
    summary.uidsReplaced += file.uidsReplaced;
    summary.privateRemoved += file.privateRemoved;
    for (const auto& [name, times] : file.removed) summary.removed[name] += times;
    writeAnonymized(file, common.output, summary, counts, outputs);
  }
  if (summary.files == 0) {
    throw Unsupported("none of the " + std::to_string(files.size()) + " DICOM files in '" +
                      arguments.input.string() + "' holds a picture; reports are not anonymized");
  }
  if (summary.withoutPicture > 0) {
    summary.warnings.push_back(
        std::to_string(summary.withoutPicture) +
        " DICOM files without a picture (reports and the like) were left out");
  }
  if (summary.others > 0) {
    summary.warnings.push_back(std::to_string(summary.others) +
                               " files that are no DICOM were left out");
  }
  if (!arguments.keyGiven()) {
    summary.warnings.emplace_back(
        "no key was given: the UIDs and names of this run cannot be made again");
  }
  outputs.keep();
  progress.report(1.0);
  if (!common.quiet) printWarnings(summary.warnings);
  if (common.json) {
    std::cout << jsonText(anonymizeReport(arguments, common.output, summary));
  } else if (!common.quiet) {
    std::cout << reportText(common.output, summary);
  }
  return ExitCode::Done;
}

}  // namespace

Run declareAnonymize(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<AnonymizeArguments>();
  app.add_option("DICOM", arguments->input, "A folder of DICOM files, or one of them.")
      ->type_name("PATH")
      ->required();
  app.add_option("-o,--output", common.output, "Where the anonymized files go; made, or empty.")
      ->type_name("FOLDER")
      ->required();
  CLI::Option* key =
      app.add_option("--key", arguments->key,
                     "A secret of 8 characters or more: the same key gives the same new UIDs.")
          ->type_name("TEXT");
  app.add_option("--key-file", arguments->keyFile, "The file that holds the key.")
      ->type_name("FILE")
      ->excludes(key);
  addJson(app, common);
  return [arguments, &common](const Progress& progress) {
    return runAnonymize(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
