#include <iostream>
#include <memory>

#include "cli/command_line.h"
#include "cli/man_page.h"

namespace pneuma::cli {

Run declareHelp(CLI::App& app, CommonOptions&) {
  const auto name = std::make_shared<std::string>();
  const auto man = std::make_shared<bool>(false);
  auto* which =
      app.add_option("COMMAND", *name, "The command to explain; without it, all are listed.");
  app.add_flag("--man", *man, "Print the manual page pneuma(1) instead, for man.")->excludes(which);
  return [name, man](const Progress&) {
    std::cout << (*man            ? manPage()
                  : name->empty() ? overview()
                                  : declared(command(*name))->parser.help());
    return ExitCode::Done;
  };
}

}  // namespace pneuma::cli
