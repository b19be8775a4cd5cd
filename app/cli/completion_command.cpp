#include <iostream>
#include <memory>

#include "cli/command_line.h"
#include "cli/completion_scripts.h"

namespace pneuma::cli {
namespace {

using Script = std::string (*)(const std::vector<CompletedCommand>&);

constexpr std::array<std::pair<std::string_view, Script>, 3> Shells = {{
    {"bash", bashCompletion},
    {"zsh", zshCompletion},
    {"fish", fishCompletion},
}};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> words;
  std::size_t from = 0;
  for (std::size_t to = 0; to != std::string::npos; from = to + 1) {
    to = text.find(separator, from);
    words.push_back(text.substr(from, to == std::string::npos ? to : to - from));
  }
  return words;
}

CompletedOption completed(const CLI::Option& option) {
  CompletedOption result;
  result.longNames = option.get_lnames();
  result.shortNames = option.get_snames();
  result.help = option.get_description();
  result.positional = option.get_positional();
  result.takesValue = option.get_type_size() != 0;
  const std::string type = option.get_type_name();
  if (type.starts_with('{')) {
    result.choices = split(type.substr(1, type.size() - 2), '|');
  } else if (result.takesValue) {
    result.isFile = type == "FILE";
    result.isFolder = type == "FOLDER";
  }
  return result;
}

/// The table of commands with what their parsers know.
std::vector<CompletedCommand> completedCommands() {
  std::vector<CompletedCommand> result;
  std::vector<std::string> names;
  for (const Command& each : commands()) names.emplace_back(each.name);
  for (const Command& each : commands()) {
    const std::unique_ptr<DeclaredCommand> ready = declared(each);
    CompletedCommand command{std::string(each.name), std::string(each.summary), {}};
    for (const CLI::Option* option : ready->parser.get_options()) {
      command.options.push_back(completed(*option));
    }
    if (each.name == "help") {
      for (CompletedOption& option : command.options) {
        if (option.positional) option.choices = names;
      }
    }
    result.push_back(std::move(command));
  }
  return result;
}

std::string script(const std::string& shell) {
  std::vector<std::string_view> names;
  for (const auto& [name, write] : Shells) {
    if (name == shell) return write(completedCommands());
    names.push_back(name);
  }
  throw InvalidOption("completion knows " + joinedChoices(names) + ", but '" + shell +
                      "' was given");
}

}  // namespace

Run declareCompletion(CLI::App& app, CommonOptions&) {
  const auto shell = std::make_shared<std::string>();
  std::vector<std::string_view> names;
  for (const auto& [name, write] : Shells) names.push_back(name);
  app.add_option("SHELL", *shell, "The shell: bash, zsh or fish.")
      ->type_name(choiceType(names))
      ->required();
  app.footer(
      "For bash: pneuma completion bash > ~/.local/share/bash-completion/completions/pneuma\n"
      "For zsh: into a file _pneuma in a folder of $fpath.\n"
      "For fish: into ~/.config/fish/completions/pneuma.fish");
  return [shell](const Progress&) {
    std::cout << script(*shell);
    return ExitCode::Done;
  };
}

}  // namespace pneuma::cli
