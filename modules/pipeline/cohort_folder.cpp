#include "pipeline/cohort_folder.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>

#include "core/error.h"
#include "core/memory.h"
#include "io/atomic_file.h"
#include "io/staged_folder.h"
#include "pipeline/detail/cohort_files.h"
#include "pipeline/recipe_arguments.h"
#include "pipeline/report.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

struct WorkflowFile {
  std::string_view name;
  std::string_view text;
  bool forPeople = false;  ///< to be edited; never replaced
};

/// In the folders' order.
std::array<WorkflowFile, 12> workflowFiles() {
  return {{{"Snakefile", detail::CohortSnakefile},
           {"config.yaml", detail::CohortConfig, true},
           {"README.md", detail::CohortReadme},
           {"scripts/stage.py", detail::CohortStage},
           {"scripts/gather.py", detail::CohortGather},
           {"scripts/table.py", detail::CohortTable},
           {"scripts/plots.py", detail::CohortPlots},
           {"scripts/page.py", detail::CohortPage},
           {"profiles/local/config.yaml", detail::CohortLocalProfile, true},
           {"profiles/slurm/config.yaml", detail::CohortSlurmProfile, true},
           {"profiles/slurm/status.sh", detail::CohortSlurmStatus},
           {"profiles/slurm/resume.sh", detail::CohortSlurmResume}}};
}

std::string withText(std::string text, const std::string& mark, const std::string& value) {
  for (std::size_t at = text.find(mark); at != std::string::npos;
       at = text.find(mark, at + value.size())) {
    text.replace(at, mark.size(), value);
  }
  return text;
}

/// A recipe's own method with its options, the others with the number of terminals it asks for.
Json growOptions(const GrowthOptions& growth) {
  Json options = Json::object();
  for (const GrowthMethod& method : growthMethods()) {
    if (method.name == growthMethod(growth).name) {
      options[std::string(method.name)] = growArguments(growth);
      continue;
    }
    GrowthOptions other = method.defaults;
    std::visit(
        [](auto& to, const auto& from) {
          to.terminals =
              std::min<std::uint64_t>(from.terminals, 1'000'000);  // as many as every method takes
          to.seed = from.seed;
        },
        other, growth);
    options[std::string(method.name)] = growArguments(other);
  }
  return options;
}

Json toJson(const CohortCase& one) {
  Json columns = Json::object();
  for (const auto& [name, text] : one.columns) columns[name] = text;
  Json json = {{"case", one.name},
               {"ct", one.ct.string()},
               {"columns", columns},
               {"options",
                {{"info", infoArguments(one.recipe)},
                 {"import", importArguments(one.recipe)},
                 {"segment", segmentArguments(one.recipe)},
                 {"lobes", lobesArguments(one.recipe)},
                 {"grow", growOptions(one.recipe.growth)}}}};
  // What is in them, so that a change is noticed.
  if (!one.recipe.lobes.fissures.empty()) {
    json["fissures_sha256"] = sha256(readFile(one.recipe.lobes.fissures));
  }
  if (!one.recipe.lungEdits.empty()) {
    json["edits_sha256"] = sha256(readFile(one.recipe.lungEdits));
  }
  return json;
}

/// @throws InvalidInput for a path that JSON cannot hold
std::string casesText(const Cohort& cohort) {
  try {
    return toJson(cohort).dump(1) + "\n";
  } catch (const Json::type_error&) {
    throw InvalidInput("a CT or a file of this cohort has a name that is not UTF-8; rename it");
  }
}

std::string textFor(const WorkflowFile& file, const CohortWorkflow& workflow) {
  // Bytes that are no UTF-8 would be no YAML.
  const std::string program =
      Json(workflow.program).dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string text = withText(std::string(file.text), "@PNEUMA@", program);
  // Four fifths of what is free here, or of an amount that any machine has where it does not tell.
  const std::uint64_t available = availableMemoryBytes();
  const std::uint64_t known = available == 0 ? 4'000'000'000 : available;
  const std::uint64_t bytes = std::max<std::uint64_t>(known / 5 * 4, 1'000'000'000);
  text = withText(text, "@MEMORY@", std::to_string(bytes / 1'000'000));
  return withText(text, "@AGAIN@", workflow.again);
}

}  // namespace

Json toJson(const Cohort& cohort) {
  Json json = {{"schema", "pneuma/cohort/1"},
               {"app", {{"name", "pneuma"}, {"version", versionText()}, {"commit", commitText()}}},
               {"methods", cohort.methods},
               {"cases", Json::array()}};
  for (const CohortCase& one : cohort.cases) json["cases"].push_back(toJson(one));
  return json;
}

WrittenCohort writeCohort(const fs::path& folder, const CohortWorkflow& workflow,
                          Existing existing) {
  std::error_code error;
  WrittenCohort written;
  std::vector<std::pair<std::string, std::string>> texts = {
      {"cases.json", casesText(workflow.cohort)}};
  for (const WorkflowFile& file : workflowFiles()) {
    const std::string name(file.name);
    if (file.forPeople && existing == Existing::Replace && fs::exists(folder / name, error)) {
      written.kept.push_back(name);
      continue;
    }
    texts.emplace_back(name, textFor(file, workflow));
  }
  if (existing == Existing::Refuse) {
    for (const auto& [name, text] : texts) {
      if (fs::exists(folder / name, error)) {
        throw OutputFailed("'" + (folder / name).string() +
                           "' exists already; use --force to write the workflow anew: results, "
                           "config.yaml and profiles stay as they are");
      }
    }
  }
  StagedFolder staged(folder);
  for (const auto& [name, text] : texts) {
    const fs::path path = staged.path() / name;
    makeFolder(path.parent_path());
    writeFile(path, text);
    written.files.push_back(name);
  }
  staged.keep(existing);
  return written;
}

}  // namespace pneuma
