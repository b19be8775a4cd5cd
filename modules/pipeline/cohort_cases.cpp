#include "pipeline/cohort_cases.h"

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <map>
#include <optional>
#include <set>

#include "core/error.h"
#include "io/ct_file.h"
#include "io/fissure_file.h"
#include "io/text_table.h"
#include "io/volume_file.h"
#include "pipeline/lung_edits_file.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t MostCases = 1'000'000;
constexpr std::size_t MostNameBytes = 100;
constexpr std::size_t MostProblemsTold = 5;
constexpr std::size_t MostTold = 300;

/// "a/b/" is "a/b".
fs::path withoutSlash(const fs::path& path) {
  return path.has_filename() ? path : path.parent_path();
}

/// As much of it as a sentence holds.
std::string quotedText(const std::string& text) {
  if (text.size() > MostTold) return "a text of " + std::to_string(text.size()) + " bytes";
  return "'" + text + "'";
}

/// Blanks and marks of Unicode that look like others, or like nothing: bytes of UTF-8.
bool hasUnseen(std::string_view text) {
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    const auto byte = [&](std::size_t at) {
      return at < text.size() ? static_cast<unsigned char>(text[at]) : 0U;
    };
    if (byte(i) == 0xC2U && (byte(i + 1) <= 0xA0U || byte(i + 1) == 0xADU)) return true;
    if (byte(i) == 0xE2U && byte(i + 1) == 0x80U &&
        (byte(i + 2) <= 0x8FU || (byte(i + 2) >= 0xA8U && byte(i + 2) <= 0xAFU))) {
      return true;
    }
    if (byte(i) == 0xE2U && byte(i + 1) == 0x81U && byte(i + 2) >= 0x9FU) return true;
    if (byte(i) == 0xE3U && byte(i + 1) == 0x80U && byte(i + 2) == 0x80U) return true;
    if (byte(i) == 0xEFU && byte(i + 1) == 0xBBU && byte(i + 2) == 0xBFU) return true;
  }
  return false;
}

/// What keeps a name from being that of a folder; empty: nothing.
std::string wrongWithName(const std::string& name) {
  if (name.empty()) return "has no name under \"case\"";
  if (name.size() > MostNameBytes) return "has a name of more than 100 bytes under \"case\"";
  const bool control = std::ranges::any_of(
      name, [](char c) { return static_cast<unsigned char>(c) < 0x20U || c == 0x7F; });
  // Snakemake and shells read these on the nodes of a cluster.
  if (control || hasUnseen(name) || name.find_first_of("/\\{},'\"$`") != std::string::npos ||
      name.front() == '.' || name.front() == '-') {
    return "names its case " + quotedText(name) +
           ", which is to become a folder: leave out / \\ { } , ' \" $ ` and what cannot be seen, "
           "and do not begin with . or -";
  }
  return {};
}

/// Problems of single lines, told together.
class Problems {
 public:
  explicit Problems(std::string where) : where_(std::move(where)) {}

  void add(std::size_t line, ExitCode code, const std::string& what) {
    if (count_ == 0) code_ = code;
    if (++count_ <= MostProblemsTold) {
      text_ += (text_.empty() ? "line " : "; line ") + std::to_string(line) + " " + what;
    }
  }

  /// @throws Error unless there was none
  void tell() const {
    if (count_ == 0) return;
    const std::size_t untold = count_ - std::min(count_, MostProblemsTold);
    throw Error(code_, where_ + ": " + text_ +
                           (untold == 0 ? "" : "; and " + std::to_string(untold) + " more"));
  }

 private:
  std::string where_;
  std::string text_;
  std::size_t count_ = 0;
  ExitCode code_ = ExitCode::InputInvalid;
};

/// Recipes by their files, each read once.
class Recipes {
 public:
  explicit Recipes(const fs::path& ofAll) {
    if (ofAll.empty()) return;
    ofAll_ = readRecipe(ofAll);
    check(ofAll_);
  }

  /// The one for all cases, for one of them.
  const Recipe& ofAll() {
    use(ofAll_);
    return ofAll_;
  }

  const Recipe& of(const fs::path& path) {
    auto recipe = byPath_.find(path);
    if (recipe == byPath_.end()) {
      recipe = byPath_.emplace(path, readRecipe(path)).first;
      check(recipe->second);
    }
    use(recipe->second);
    return recipe->second;
  }

  const std::vector<std::string>& methods() const { return methods_; }

  /// Does one ask for what a cohort does not do?
  bool ignored() const { return ignores_; }

 private:
  /// Reads the files that it names, too.
  void check(const Recipe& recipe) {
    if (!recipe.lobes.fissures.empty()) readFissureFile(recipe.lobes.fissures);
    if (!recipe.lungEdits.empty()) readLungEdits(recipe.lungEdits);
    ignores_ = ignores_ || !recipe.formats.empty() || !recipe.ct.empty();
  }

  void use(const Recipe& recipe) {
    const std::string method(growthMethod(recipe.growth).name);
    if (std::ranges::find(methods_, method) == methods_.end()) methods_.push_back(method);
  }

  Recipe ofAll_;
  std::map<fs::path, Recipe> byPath_;
  std::vector<std::string> methods_;
  bool ignores_ = false;
};

/// Which column is which.
struct Columns {
  std::optional<std::size_t> ct;
  std::optional<std::size_t> name;
  std::optional<std::size_t> series;
  std::optional<std::size_t> fissures;
  std::optional<std::size_t> recipe;
  std::vector<std::size_t> others;
};

Columns columnsOf(const TextTable& table) {
  Columns columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::string& column = table.columns[i];
    if (column == "ct" || column == "path") {
      if (columns.ct) {
        throw InvalidInput(table.name + " has both a column \"ct\" and one \"path\"; leave one");
      }
      columns.ct = i;
    } else if (column == "case") {
      columns.name = i;
    } else if (column == "series") {
      columns.series = i;
    } else if (column == "fissures") {
      columns.fissures = i;
    } else if (column == "recipe") {
      columns.recipe = i;
    } else {
      columns.others.push_back(i);
    }
  }
  if (!columns.ct) {
    throw InvalidInput(table.name +
                       " has no column \"ct\" in its first line, for the path of each CT; add or "
                       "rename it");
  }
  return columns;
}

std::string numbered(std::size_t number, std::size_t count) {
  std::string digits = std::to_string(number);
  const std::size_t width = std::max<std::size_t>(3, std::to_string(count).size());
  return "case-" + std::string(width - std::min(width, digits.size()), '0') + digits;
}

class TableReader {
 public:
  TableReader(const CohortSource& source, Recipes& recipes)
      : table_(readTextTable(source.cases)),
        columns_(columnsOf(table_)),
        recipes_(recipes),
        folder_(fs::absolute(source.cases).parent_path()),
        problems_(table_.name) {}

  std::vector<CohortCase> read(const Progress& progress) {
    std::vector<CohortCase> cases;
    for (std::size_t row = 0; row < table_.rows.size(); ++row) {
      cases.push_back(readCase(row));
      progress.report(static_cast<double>(row + 1) / static_cast<double>(table_.rows.size()));
    }
    problems_.tell();
    if (cases.empty()) throw InvalidInput(table_.name + " lists no case");
    return cases;
  }

 private:
  CohortCase readCase(std::size_t row) {
    const std::size_t line = table_.lines[row];
    const std::vector<std::string>& fields = table_.rows[row];
    const auto text = [&](const std::optional<std::size_t>& column) {
      return column ? fields[*column] : std::string();
    };
    CohortCase one;
    one.name = columns_.name ? text(columns_.name) : numbered(row + 1, table_.rows.size());
    if (const std::string wrong = wrongWithName(one.name); !wrong.empty()) {
      problems_.add(line, ExitCode::InputInvalid, wrong);
    } else if (const auto [first, added] = lineOf_.emplace(one.name, line); !added) {
      problems_.add(line, ExitCode::InputInvalid,
                    "names its case " + quotedText(one.name) + ", as line " +
                        std::to_string(first->second) + " does");
    }
    one.ct = existing(line, "ct", text(columns_.ct));
    const std::string recipe = text(columns_.recipe);
    guarded(line, [&] {
      one.recipe = recipe.empty() ? recipes_.ofAll() : recipes_.of(folder_ / recipe);
      if (const std::string series = text(columns_.series); !series.empty()) {
        one.recipe.series.wanted = series;
      }
      if (const std::string fissures = text(columns_.fissures); !fissures.empty()) {
        one.recipe.lobes.fissures = existing(line, "fissures", fissures);
        std::error_code error;
        if (fs::exists(one.recipe.lobes.fissures, error)) {
          requireFissures(one.recipe.lobes.fissures);
        }
      }
    });
    for (const std::size_t column : columns_.others) {
      one.columns.emplace_back(table_.columns[column], fields[column]);
    }
    return one;
  }

  void requireFissures(const fs::path& path) {
    if (fissuresRead_.contains(path)) return;
    readFissureFile(path);
    fissuresRead_.insert(path);
  }

  /// What is wrong with something that a line names belongs to that line.
  template <class Work>
  void guarded(std::size_t line, const Work& work) {
    try {
      work();
    } catch (const Error& error) {
      problems_.add(line, error.code(),
                    std::string("names a file that is no good: ") + error.what());
    }
  }

  fs::path existing(std::size_t line, const std::string& column, const std::string& text) {
    if (text.empty()) {
      problems_.add(line, ExitCode::InputInvalid, "has nothing under \"" + column + "\"");
      return {};
    }
    const fs::path path = withoutSlash((folder_ / text).lexically_normal());
    std::error_code error;
    if (!fs::exists(path, error)) {
      problems_.add(line, ExitCode::InputMissing,
                    "names " + quotedText(text) + " under \"" + column +
                        "\", which does not exist or cannot be looked at");
    }
    return path;
  }

  TextTable table_;
  Columns columns_;
  Recipes& recipes_;
  fs::path folder_;
  Problems problems_;
  std::map<std::string, std::size_t> lineOf_;
  std::set<fs::path> fissuresRead_;
};

/// A file of DICOM that is no archive: one slice of a CT, not a case.
bool isLooseSlice(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error) || isVolumeFile(path) || !isDicomPath(path)) return false;
  std::string start;
  std::ifstream(path, std::ios::binary) >> std::setw(2) >> start;
  return start != "PK";
}

/// A volume of so few values that none of them is air in Hounsfield units: labels of a CT.
bool isLabelVolume(const fs::path& path) {
  if (!isVolumeFile(path)) return false;
  try {
    const VolumeHeader header = readVolumeHeader(path);
    return header.slope == 1.0 && header.intercept == 0.0 &&
           (header.scalarType == "uint8" || header.scalarType == "int8");
  } catch (const Error&) {
    return false;  // a case that fails alone, and says why
  }
}

/// The entries of a folder that hold a CT, in the order of their names.
std::vector<CohortCase> casesInFolder(const CohortSource& source, Recipes& recipes,
                                      std::vector<std::string>& notes, const Progress& progress) {
  std::error_code error;
  std::vector<fs::path> entries;
  for (fs::directory_iterator entry(source.cases, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().filename().string().front() != '.') entries.push_back(entry->path());
  }
  if (error) {
    throw InputMissing("'" + source.cases.string() + "' cannot be read: " + error.message());
  }
  std::ranges::sort(entries);
  std::vector<fs::path> cts;
  std::size_t others = 0;
  std::size_t slices = 0;
  std::size_t labels = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (isLooseSlice(entries[i])) {
      ++slices;
    } else if (isLabelVolume(entries[i])) {
      ++labels;
    } else if (isCtPath(entries[i])) {
      cts.push_back(entries[i]);
    } else {
      ++others;
    }
    progress.report(static_cast<double>(i + 1) / static_cast<double>(entries.size()));
  }
  if (slices > 0 && cts.empty()) {
    throw InvalidInput("'" + source.cases.string() +
                       "' holds the slices of CTs themselves; name the folder that holds a folder "
                       "for each case");
  }
  if (cts.empty()) {
    throw InputMissing("'" + source.cases.string() +
                       "' holds no CTs: neither folders of DICOM slices nor volume files" +
                       (labels > 0 ? " of more than 8 bits" : ""));
  }
  if (const std::size_t passed = others + slices + labels; passed > 0) {
    notes.push_back(std::to_string(passed) + " of " + std::to_string(entries.size()) +
                    " entries of the folder hold no CT" +
                    (labels > 0 ? ", volumes of 8 bits (labels) among them," : "") +
                    " and were passed over");
  }
  std::vector<CohortCase> cases;
  for (std::size_t i = 0; i < cts.size(); ++i) {
    CohortCase one;
    one.name = numbered(i + 1, cts.size());
    if (source.namesOfFolders) {
      one.name = cts[i].filename().string();
      if (const std::string wrong = wrongWithName(one.name); !wrong.empty()) {
        throw InvalidInput("'" + cts[i].string() + "' " + wrong +
                           "; rename it, or let cases have numbers");
      }
    }
    one.ct = fs::absolute(cts[i]).lexically_normal();
    one.recipe = recipes.ofAll();
    cases.push_back(std::move(one));
  }
  return cases;
}

}  // namespace

Cohort readCohort(const CohortSource& source, const Progress& progress) {
  Cohort cohort;
  Recipes recipes(source.recipe);
  std::error_code error;
  if (fs::is_directory(source.cases, error)) {
    cohort.cases = casesInFolder(source, recipes, cohort.notes, progress);
  } else {
    if (source.namesOfFolders) {
      throw InvalidOption("--names is for a folder of CTs; a table names cases under \"case\"");
    }
    cohort.cases = TableReader(source, recipes).read(progress);
  }
  if (cohort.cases.size() > MostCases) {
    throw Unsupported("a cohort has 1,000,000 cases at most; make several");
  }
  cohort.methods = recipes.methods();
  if (recipes.ignored()) {
    cohort.notes.emplace_back(
        "a recipe names a CT or asks for further formats (\"export\"); a cohort takes its CTs from "
        "the list, and leaves that out");
  }
  return cohort;
}

}  // namespace pneuma
