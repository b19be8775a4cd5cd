#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <CLI/App.hpp>

#include "core/options.h"
#include "io/atomic_file.h"

namespace pneuma::cli {

enum class ProgressMode { Auto, None, Bar, Json };

constexpr std::array<std::string_view, 4> choices(ProgressMode) {
  return {"auto", "none", "bar", "json"};
}

/// Options that mean the same in every command that has them.
struct CommonOptions {
  std::filesystem::path output;
  bool force = false;
  bool quiet = false;
  bool verbose = false;
  bool json = false;
  ProgressMode progress = ProgressMode::Auto;
  int threads = 0;
  double timeoutSeconds = 0.0;
  std::uint64_t maxMemoryBytes = 0;  ///< 0: no limit

  static constexpr auto fields() {
    using O = CommonOptions;
    return std::tuple{
        Field{"progress", &O::progress, "", Range{},
              "How to show progress on standard error; auto: a bar on a terminal."},
        Field{"threads", &O::threads, "", Range{0, 4096},
              "Threads to use; 0: all. Results do not depend on it."},
        Field{"timeout", &O::timeoutSeconds, "s", Range{0.0, 1e7},
              "Stop with exit code 11 after this long and write nothing; 0: never."},
    };
  }

  Existing existing() const { return force ? Existing::Replace : Existing::Refuse; }
};

/// Adds -q, -v, --progress, -j/--threads, --timeout and --max-memory, which every command takes.
void addCommon(CLI::App& app, CommonOptions& common);

/// Adds -o/--output and -f/--force.
CLI::Option* addOutput(CLI::App& app, CommonOptions& common, const std::string& typeName,
                       const std::string& help);

void addForce(CLI::App& app, CommonOptions& common);

void addJson(CLI::App& app, CommonOptions& common);

/// Adds a list of files or folders given without an option's name.
CLI::Option* addFiles(CLI::App& app, const std::string& name,
                      std::vector<std::filesystem::path>& files, const std::string& help);

/// Adds an option that takes one text and may be repeated.
CLI::Option* addRepeatable(CLI::App& app, const std::string& name, std::vector<std::string>& values,
                           const std::string& typeName, const std::string& help);

/// "a|b|c"
template <class Names>
std::string joinedChoices(const Names& names) {
  std::string text;
  for (const std::string_view name : names) {
    if (!text.empty()) text += '|';
    text += name;
  }
  return text;
}

/// "{a|b|c}": the type name by which the help and the completion scripts know a closed choice.
template <class Names>
std::string choiceType(const Names& names) {
  return "{" + joinedChoices(names) + "}";
}

/// Adds an option for one field of an options struct: `--name`, or `flags` such as "-j,--threads".
/// Range, unit and choices are the field's; complaints name the option.
template <class Options, class Value>
CLI::Option* addField(CLI::App& app, Options& options, const Field<Options, Value>& field,
                      const std::string& flags = "") {
  const std::string name = "--" + std::string(field.name);
  const auto set = [&options, key = field.name](const std::string& text) {
    try {
      setOption(options, key, text);
    } catch (const InvalidOption& error) {
      throw InvalidOption("--" + std::string(error.what()));
    }
  };
  CLI::Option* option = app.add_option_function<std::string>(flags.empty() ? name : flags, set,
                                                             std::string(field.help));
  if constexpr (std::is_enum_v<Value>) {
    option->type_name(choiceType(choices(Value{})));
  } else {
    option->type_name(field.unit.empty() ? "N" : std::string(field.unit));
  }
  option->default_str(pneuma::textOf(options.*(field.member)));
  return option;
}

/// addField() for every field.
template <HasFields Options>
void addFields(CLI::App& app, Options& options) {
  forEachField<Options>([&](const auto& field) { addField(app, options, field); });
}

/// Sets a field from "key=value".
/// @param option that the assignment was given to, for the message
/// @throws InvalidOption
template <HasFields Options>
void setFromAssignment(Options& options, std::string_view assignment,
                       const std::string& option = "--set") {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    throw InvalidOption(option + " needs key=value, but '" + std::string(assignment) +
                        "' was given");
  }
  setOption(options, assignment.substr(0, equals), assignment.substr(equals + 1));
}

/// The fields of an options struct as lines of a help page: name, default, unit, range, help.
template <HasFields Options>
std::string fieldsHelp(const Options& options) {
  std::string text;
  forEachField<Options>([&](const auto& field) {
    using Value = typename std::remove_cvref_t<decltype(field)>::value_type;
    text += "  " + std::string(field.name) + "=" + textOf(options.*(field.member));
    if constexpr (std::is_enum_v<Value>) {
      text += " (" + joinedChoices(choices(Value{})) + ")";
    } else {
      if (!field.unit.empty()) text += " " + std::string(field.unit);
      text += " (" + textOf(field.range.low) + " to " + textOf(field.range.high) + ")";
    }
    text += "\n      " + std::string(field.help) + "\n";
  });
  return text;
}

}  // namespace pneuma::cli
