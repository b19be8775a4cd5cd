#include "judge.h"

#include <algorithm>
#include <set>
#include <sstream>

#include "bytes.h"

namespace pneuma::damaged {
namespace fs = std::filesystem;

namespace {

std::vector<std::string> wordsOf(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// As messages show a name: they have one line.
std::string onOneLine(std::string name) {
  std::replace(name.begin(), name.end(), '\n', ' ');
  return name;
}

std::set<std::string> below(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    names.insert(entry.path().lexically_relative(folder).string());
  }
  return names;
}

/// A folder of surfaces that the file belongs to, under the name of one of them.
void makeSet(const Bench& bench, const DamagedFile& file, const fs::path& folder,
             const std::string& sound, const std::string& replaced) {
  fs::create_directory(folder);
  for (const auto& entry : fs::directory_iterator(bench.seeds / sound)) {
    const fs::path& path = entry.path();
    if (path.extension() != ".vtp" || path.stem() == replaced) continue;
    fs::create_symlink(fs::absolute(path), folder / path.filename());
  }
  file.write(folder / (replaced + file.name.substr(file.name.rfind('.'))));
}

/// False where the file is one of many in a folder, and the others may be enough.
bool aloneDecides(const DamagedFile& file, const Command& command) {
  const auto has = [&](const char* word) {
    return command.arguments.find(word) != std::string::npos;
  };
  if (has("FOLDER")) return false;
  const bool inSet = has("LOBES") || has("LUNGS");
  return !inSet || file.name.find("no-file-folder") == std::string::npos;
}

/// What is wrong with a refusal; `names`: one of them must be told.
std::string faultOfRefusal(const Ending& ending, const std::vector<std::string>& names) {
  std::vector<std::string> lines;
  std::istringstream in(ending.err);
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("pneuma: warning: ", 0) != 0) lines.push_back(line);
  }
  if (lines.size() != 1) return std::to_string(lines.size()) + " lines on standard error, not one";
  if (lines[0].rfind("pneuma: ", 0) != 0) return "the sentence does not begin with 'pneuma: '";
  if (lines[0].size() > 2000)
    return "a sentence of " + std::to_string(lines[0].size()) + " letters";
  if (!ending.out.empty()) return "it was refused, but there is a result on standard output";
  const bool isNamed = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return lines[0].find(name) != std::string::npos;
  });
  return isNamed ? "" : "the sentence does not name the file";
}

std::string faultOfResult(const Ending& ending, const Command& command, const fs::path& folder) {
  for (const std::string& output : wordsOf(command.outputs)) {
    if (output == "-") {
      if (ending.out.empty()) return "it ended well, but nothing is on standard output";
      continue;
    }
    std::error_code error;
    const auto size = fs::file_size(folder / output, error);
    if (error) return "it ended well, but there is no " + output;
    if (size == 0) return "it ended well, but " + output + " is empty";
  }
  return "";
}

std::string faultOf(const Bench& bench, const DamagedFile& file, const Command& command,
                    const Ending& ending, const fs::path& folder,
                    const std::set<std::string>& before, const std::vector<std::string>& names) {
  if (ending.signal != 0) return "ended by signal " + std::to_string(ending.signal);
  if (ending.late) return "took longer than " + std::to_string(bench.limits.seconds) + " s";
  if (ending.megabytes > bench.limits.megabytes) {
    return "took " + std::to_string(ending.megabytes) + " MB";
  }
  const bool well = ending.code == 0 || ending.code == 7;
  // A recipe holds options, and those out of range are wrong usage wherever they stand.
  const bool usage = ending.code == 2 && file.role == "recipe";
  static const std::set<int> refusals = {3, 4, 5};
  if (!well && !usage && refusals.count(ending.code) == 0) {
    return "exit code " + std::to_string(ending.code);
  }
  std::vector<std::string> come;
  const std::set<std::string> after = below(folder);
  std::set_difference(after.begin(), after.end(), before.begin(), before.end(),
                      std::back_inserter(come));
  for (const std::string& name : come) {
    if (name.rfind("temporary", 0) == 0) return "left " + name;
    if (name.rfind("in/", 0) == 0) return "wrote beside the input: " + name;
  }
  if (well) {
    if (file.wanted == Wanted::Refused && aloneDecides(file, command) && ending.code == 0) {
      return "read what cannot be read";
    }
    if (come.empty() && command.outputs != "-") return "it ended well, but wrote nothing";
    return faultOfResult(ending, command, folder);
  }
  if (file.wanted == Wanted::Read) return "refused a sound file";
  // A run keeps the stages that it has done, whole, to go on from there.
  const bool keepsStages =
      command.arguments.find("run ") == 0 && command.outputs == "result/tree.vtp";
  if (!come.empty() && !keepsStages) return "it was refused, but left " + come.front();
  return faultOfRefusal(ending, names);
}

}  // namespace

Verdict judge(const Bench& bench, const DamagedFile& file, const Command& command,
              std::size_t number) {
  const fs::path folder = bench.work / std::to_string(number);
  fs::create_directories(folder / "in");
  fs::create_directory(folder / "temporary");
  file.write(folder / "in" / file.name);
  std::vector<std::string> words = {bench.program};
  std::vector<std::string> names = {file.name, onOneLine(file.name)};
  if (command.arguments.find("--landmarks") != std::string::npos)
    names.insert(names.end(), {"landmark ", "landmarks "});
  if (command.arguments.find("--central") != std::string::npos)
    names.push_back("central airways");  // their place speaks of both, airways and lobes
  if (command.arguments.find("--voxels-of") != std::string::npos)
    names.push_back("outside of the scan");  // its landmarks are named
  if (file.format.rfind("dicom", 0) == 0) names.push_back("series 1 ");
  if (file.format == "nrrd-header" || file.format == "mhd") names.push_back("ct.raw");
  if (file.role == "recipe") names.push_back("ct.nii");  // which it names
  if (file.role == "breath-table") names.push_back("the lung cannot be brought to");
  if (file.role == "fissures" || file.role == "planes") {
    names.insert(names.end(),
                 {"right oblique fissure", "right horizontal fissure", "left oblique fissure"});
  }
  for (std::string word : wordsOf(command.arguments)) {
    if (word == "FILE") {
      word = "in/" + file.name;
    } else if (word == "FOLDER") {
      word = "in";
      names.insert(names.end(), {"\"in\"", "in/", "series 1"});
    } else if (word == "LOBES") {
      makeSet(bench, file, folder / "lobes", "split", "rml");
      word = "lobes";
      names.insert(names.end(), {"lobes", "rml", "RML", "right middle"});
    } else if (word == "LUNGS") {
      makeSet(bench, file, folder / "lungs", "lungs", "right");
      word = "lungs";
      names.insert(names.end(), {"lungs", "right"});
    } else if (word.rfind("SEEDS/", 0) == 0) {
      word.replace(0, 5, bench.seeds.string());
    }
    words.push_back(word);
  }
  Verdict verdict;
  for (std::size_t i = 1; i < words.size(); ++i) verdict.line += (i > 1 ? " " : "") + words[i];
  const std::set<std::string> before = below(folder);
  verdict.ending = runProgram(words, folder, folder / "temporary", bench.limits.seconds);
  verdict.fault = faultOf(bench, file, command, verdict.ending, folder, before, names);
  if (verdict.fault.empty() || !bench.keep) fs::remove_all(folder);
  return verdict;
}

}  // namespace pneuma::damaged
