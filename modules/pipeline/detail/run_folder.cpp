#include "pipeline/detail/run_folder.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/input_files.h"

namespace pneuma {
namespace {

constexpr std::string_view StateSchema = "pneuma/run/1";
/// In the place of a stage: what was on its way to its place when the run ended.
constexpr const char* Placing = "placing";

std::string name(Stage stage) {
  return std::string(choices(Stage{})[static_cast<std::size_t>(stage)]);
}

bool isText(const Json& json) { return json.is_string(); }

bool isStage(const Json& entry) {
  return entry.is_object() && entry.contains("key") && isText(entry["key"]) &&
         entry.contains("files") && entry["files"].is_object() && entry.contains("warnings") &&
         entry["warnings"].is_array() && std::ranges::all_of(entry["files"], isText) &&
         std::ranges::all_of(entry["warnings"], isText);
}

/// The stages in a run.json, or nothing.
Json stagesIn(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return Json::object();
  const Json state = Json::parse(readFile(path), nullptr, false);
  const bool sound = state.is_object() && state.contains("schema") &&
                     state["schema"] == StateSchema && state.contains("stages") &&
                     state["stages"].is_object() && std::ranges::all_of(state["stages"], isStage);
  return sound ? state["stages"] : Json::object();
}

bool isListed(const Json& stages, const std::string& file) {
  return std::ranges::any_of(stages,
                             [&](const Json& stage) { return stage["files"].contains(file); });
}

std::string stateText(const Json& stages) {
  return textOf(Json{{"schema", StateSchema}, {"stages", stages}});
}

/// A run.json for the time in which files move. Unless done() is called, the one before comes back.
class Announced {
 public:
  Announced(std::filesystem::path path, const std::string& text) : path_(std::move(path)) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path_, ignored)) before_ = readFile(path_);
    writeFile(path_, text);
  }

  ~Announced() {
    if (done_) return;
    try {
      if (before_) {
        writeFile(path_, *before_);
      } else {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
      }
    } catch (const Error&) {  // then it tells of files that are not there, which harms nobody
    }
  }

  Announced(const Announced&) = delete;
  Announced& operator=(const Announced&) = delete;

  void done() { done_ = true; }

 private:
  std::filesystem::path path_;
  std::optional<std::string> before_;
  bool done_ = false;
};

bool isThere(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(std::filesystem::symlink_status(path, ignored));
}

}  // namespace

RunFolder::RunFolder(std::filesystem::path path)
    : path_(std::move(path)), before_(stagesIn(path_ / run_files::State)), now_(Json::object()) {}

const std::string& RunFolder::hashOf(const std::string& file) {
  const auto known = hashes_.find(file);
  if (known != hashes_.end()) return known->second;
  std::error_code ignored;
  const bool there = std::filesystem::is_regular_file(path_ / file, ignored);
  return hashes_[file] = there ? sha256OfFile(path_ / file) : std::string();
}

bool RunFolder::isOwn(const std::string& file) {
  return std::ranges::any_of(before_, [&](const Json& stage) {
    return stage["files"].contains(file) && stage["files"][file] == Json(hashOf(file));
  });
}

void RunFolder::refuse(const std::string& file, const std::string& why) const {
  throw OutputFailed(std::string("'").append((path_ / file).string()).append("' ").append(why) +
                     "; use --force to replace it, or another folder");
}

void RunFolder::requireOwn(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    if (!isThere(path_ / file) || isOwn(file)) continue;
    refuse(file, isListed(before_, file) ? "was changed since a run left it there"
                                         : "is there already and was not left by a run");
  }
  if (before_.empty() && isThere(path_ / run_files::State)) {
    refuse(run_files::State, "was not left by a run");
  }
}

bool RunFolder::holds(Stage stage, const std::string& key) {
  if (!before_.contains(name(stage))) return false;
  const Json& entry = before_[name(stage)];
  if (entry["key"] != key) return false;
  for (const auto& [file, hash] : entry["files"].items()) {
    if (hash != Json(hashOf(file))) return false;
  }
  return true;
}

StageResult RunFolder::keep(Stage stage) {
  const Json& entry = before_.at(name(stage));
  now_[name(stage)] = entry;
  StageResult result{stage, StageState::Kept, 0.0, {}, {}};
  for (const auto& [file, hash] : entry["files"].items()) result.files.push_back(file);
  result.warnings = entry["warnings"].get<std::vector<std::string>>();
  return result;
}

std::vector<std::string> RunFolder::takeOutdated(Stage stage,
                                                 const std::vector<std::string>& anew) {
  std::vector<std::string> outdated;
  const auto take = [&](const std::string& of) {
    if (!before_.contains(of)) return;
    for (const auto& [file, hash] : before_[of]["files"].items()) {
      const bool stays = std::ranges::find(anew, file) != anew.end() || isListed(now_, file);
      if (!stays && hash == Json(hashOf(file))) outdated.push_back(file);
    }
    before_.erase(of);
  };
  for (std::size_t s = static_cast<std::size_t>(stage); s < choices(Stage{}).size(); ++s) {
    take(name(static_cast<Stage>(s)));
  }
  take(Placing);
  return outdated;
}

void RunFolder::place(StagedFolder& staged, const StageResult& result, const std::string& key) {
  Json entry = {{"key", key}, {"files", Json::object()}, {"warnings", result.warnings}};
  for (const std::string& file : result.files) {
    entry["files"][file] = sha256OfFile(staged.path() / file);
  }
  Json meanwhile = before_;
  meanwhile.update(now_);
  meanwhile[Placing] = entry;
  now_[name(result.stage)] = std::move(entry);
  Announced announced(path_ / run_files::State, stateText(meanwhile));
  const std::vector<std::string> outdated = takeOutdated(result.stage, result.files);
  staged.keep(Existing::Replace);
  announced.done();
  for (const std::string& file : outdated) {
    std::error_code ignored;
    const std::filesystem::path path = path_ / file;
    std::filesystem::remove(path, ignored);
    if (path.has_parent_path() && path.parent_path() != path_) {
      std::filesystem::remove(path.parent_path(), ignored);  // unless there is something in it
    }
  }
  // Last, so that whenever it ends before, run.json tells of all files that may be there.
  writeFile(path_ / run_files::State, stateText(now_));
}

bool RunFolder::left(Stage stage, const std::string& file) const {
  return now_.contains(name(stage)) && now_[name(stage)]["files"].contains(file);
}

std::string textOf(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace pneuma
