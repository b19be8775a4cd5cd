#include "cli/arguments.h"

#include "cli/limits.h"

namespace pneuma::cli {

void addCommon(CLI::App& app, CommonOptions& common) {
  app.add_flag("-q,--quiet", common.quiet, "Say nothing but errors and results.");
  app.add_flag("-v,--verbose", common.verbose, "Name every step on standard error as it begins.");
  const auto [progress, threads, timeout] = CommonOptions::fields();
  addField(app, common, progress);
  addField(app, common, threads, "-j,--threads");
  addField(app, common, timeout);
  app.add_option_function<std::string>(
         "--max-memory",
         [&common](const std::string& text) { common.maxMemoryBytes = parseMemorySize(text); },
         "Memory for data, such as 8G or 500M: work that needs more ends with exit code 9; 0: all "
         "there is.")
      ->type_name("SIZE")
      ->default_str("0");
}

CLI::Option* addOutput(CLI::App& app, CommonOptions& common, const std::string& typeName,
                       const std::string& help) {
  addForce(app, common);
  return app.add_option("-o,--output", common.output, help)->type_name(typeName);
}

void addForce(CLI::App& app, CommonOptions& common) {
  app.add_flag("-f,--force", common.force, "Replace outputs that exist.");
}

void addJson(CLI::App& app, CommonOptions& common) {
  app.add_flag("--json", common.json, "Print the result as JSON on standard output.");
}

CLI::Option* addFiles(CLI::App& app, const std::string& name,
                      std::vector<std::filesystem::path>& files, const std::string& help) {
  return app.add_option(name, files, help)->type_name("FILE");
}

CLI::Option* addRepeatable(CLI::App& app, const std::string& name, std::vector<std::string>& values,
                           const std::string& typeName, const std::string& help) {
  return app.add_option(name, values, help)->type_name(typeName)->allow_extra_args(false);
}

}  // namespace pneuma::cli
