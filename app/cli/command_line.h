#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/App.hpp>

#include "cli/arguments.h"
#include "cli/command.h"

namespace pneuma::cli {

/// A command whose arguments are declared. On the heap, because the parser refers to `common`.
struct DeclaredCommand {
  CommonOptions common;
  CLI::App parser;
  Run run;
};

std::unique_ptr<DeclaredCommand> declared(const Command& command);

/// Fills the options that were declared to the parser from words as they are typed.
/// @param subject whose words they are, for complaints; @param command whose help explains them
/// @returns false if the help page was asked for instead
/// @throws InvalidOption for words that cannot be
bool parseWords(CLI::App& parser, std::string_view subject, std::string_view command,
                std::vector<std::string> words);

/// What an option is for, its default, and whether it must be given; for help and manual pages.
std::string optionText(const CLI::Option& option);

/// What `pneuma help` prints: all commands, one line each.
std::string overview();

/// Reads the arguments that follow the program's name and does what they say.
/// @throws InvalidOption for anything that cannot be; whatever the command throws
ExitCode runCommandLine(std::vector<std::string> arguments);

}  // namespace pneuma::cli
