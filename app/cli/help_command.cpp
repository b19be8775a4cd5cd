#include <iostream>
#include <memory>

#include "cli/command_line.h"

namespace pneuma::cli {

Run declareHelp(CLI::App& app, CommonOptions&) {
  const auto name = std::make_shared<std::string>();
  app.add_option("COMMAND", *name, "The command to explain; without it, all are listed.");
  return [name](const Progress&) {
    std::cout << (name->empty() ? overview() : declared(command(*name))->parser.help());
    return ExitCode::Done;
  };
}

}  // namespace pneuma::cli
