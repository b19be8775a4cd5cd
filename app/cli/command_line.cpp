#include "cli/command_line.h"

#include <algorithm>
#include <iostream>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/limits.h"
#include "cli/terminal_progress.h"
#include "core/parallel.h"

namespace pneuma::cli {
namespace {

/// CLI11's help pages with the defaults in the explanations instead of the option's column.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() { column_width(34); }

  std::string make_option_opts(const CLI::Option* option) const override {
    if (option->get_type_size() == 0 || option->get_positional()) return "";
    return " " + option->get_type_name();
  }

  std::string make_option_desc(const CLI::Option* option) const override {
    return optionText(*option);
  }
};

std::string seeHelp(std::string_view command) {
  return "; see 'pneuma help " + std::string(command) + "'";
}

[[noreturn]] void throwUnexpected(const CLI::App& parser, std::string_view subject,
                                  std::string_view command, const std::string& argument) {
  if (argument.size() < 2 || argument.front() != '-') {
    throw InvalidOption("'" + argument + "' is one argument too many for " + std::string(subject) +
                        seeHelp(command));
  }
  const std::string given = argument.substr(0, argument.find('='));
  std::vector<std::string> names;
  for (const CLI::Option* option : parser.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  const std::string_view nearest = nearestWord(given, {names.begin(), names.end()});
  throw InvalidOption(
      std::string(subject) + " has no option '" + given + "'" +
      (nearest.empty() ? seeHelp(command) : "; did you mean '" + std::string(nearest) + "'?"));
}

}  // namespace

std::unique_ptr<DeclaredCommand> declared(const Command& command) {
  auto result = std::make_unique<DeclaredCommand>();
  CLI::App& parser = result->parser;
  parser.name("pneuma " + std::string(command.name));
  parser.description(std::string(command.summary));
  parser.formatter(std::make_shared<HelpFormatter>());
  parser.set_help_flag("-h,--help", "Print this page.");
  result->run = command.declare(parser, result->common);
  addCommon(parser, result->common);
  return result;
}

std::string optionText(const CLI::Option& option) {
  std::string text = option.get_description();
  if (!option.get_default_str().empty()) text += " [" + option.get_default_str() + "]";
  if (option.get_required()) text += " Required.";
  return text;
}

std::string overview() {
  std::string text =
      "Pneuma grows bronchial trees in lung lobes, measures them and shows them.\n"
      "Usage: pneuma COMMAND [ARGUMENTS]\n\nCommands:\n";
  for (const Command& command : commands()) {
    text += "  " + std::string(command.name) + std::string(12 - command.name.size(), ' ') +
            std::string(command.summary) + "\n";
  }
  text += "\n'pneuma help COMMAND' explains one. Not a medical device.\n";
  return text;
}

bool parseWords(CLI::App& parser, std::string_view subject, std::string_view command,
                std::vector<std::string> words) {
  std::reverse(words.begin(), words.end());  // as CLI11 wants them
  try {
    parser.parse(std::move(words));
  } catch (const CLI::CallForHelp&) {
    return false;
  } catch (const CLI::ParseError& error) {
    if (!parser.remaining().empty()) {
      throwUnexpected(parser, subject, command, parser.remaining().front());
    }
    throw InvalidOption(std::string(subject) + ": " + error.what() + seeHelp(command));
  }
  return true;
}

ExitCode runCommandLine(std::vector<std::string> arguments) {
  if (arguments.empty()) {
    std::cerr << overview();
    return ExitCode::Usage;
  }
  if (arguments[0] == "-h" || arguments[0] == "--help") arguments[0] = "help";
  if (arguments[0] == "--version") arguments[0] = "version";
  if (arguments[0].starts_with("-")) {
    throw InvalidOption("the first argument is a command, but '" + arguments[0] +
                        "' was given; 'pneuma help' lists the commands");
  }
  const Command& chosen = command(arguments[0]);
  arguments.erase(arguments.begin());
  const std::unique_ptr<DeclaredCommand> ready = declared(chosen);
  if (!parseWords(ready->parser, chosen.name, chosen.name, std::move(arguments))) {
    std::cout << ready->parser.help();
    return ExitCode::Done;
  }
  const CommonOptions& common = ready->common;
  limitMemory(common.maxMemoryBytes);
  limitTime(common.timeoutSeconds);
  const ThreadLimit limit(static_cast<unsigned>(common.threads));
  TerminalProgress terminal(
      common.quiet ? ProgressMode::None : common.progress,
      common.verbose ? TerminalProgress::Steps::Named : TerminalProgress::Steps::Silent);
  return ready->run(Progress(terminal));
}

}  // namespace pneuma::cli
