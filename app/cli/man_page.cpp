#include "cli/man_page.h"

#include <array>
#include <memory>

#include "cli/command_line.h"
#include "pipeline/report.h"

namespace pneuma::cli {
namespace {

struct ExitRow {
  ExitCode code;
  const char* meaning;
};

constexpr std::array<ExitRow, 13> ExitRows = {{
    {ExitCode::Done, "Done."},
    {ExitCode::Internal, "A fault of the program; please report it."},
    {ExitCode::Usage, "A command or an option that cannot be."},
    {ExitCode::InputMissing, "An input is not there, or may not be read."},
    {ExitCode::InputInvalid, "An input is damaged, or does not fit."},
    {ExitCode::Unsupported, "An input is of a kind that is not read."},
    {ExitCode::OutputFailed, "An output could not be written, or is there already."},
    {ExitCode::CheckFailed, "A check of the result failed."},
    {ExitCode::ComparisonOverLimit, "A comparison is over its limits."},
    {ExitCode::OutOfMemory, "There is not enough memory."},
    {ExitCode::NoRendering, "There is no display to draw on."},
    {ExitCode::TimeOver, "The time limit was reached."},
    {ExitCode::Interrupted, "Interrupted."},
}};

/// Text as roff takes it: no line is a request, no dash a hyphen, no backslash an escape.
std::string roff(const std::string& text) {
  std::string result;
  bool lineBegins = true;
  for (const char c : text) {
    if (lineBegins && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
    lineBegins = c == '\n';
  }
  return result;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }

std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string optionHead(const CLI::Option& option) {
  std::string head;
  const auto add = [&](const std::string& name) {
    head += (head.empty() ? "" : ", ") + bold(name);
  };
  if (option.get_positional()) return italic(option.get_name(true, false));
  for (const std::string& name : option.get_snames()) add("-" + name);
  for (const std::string& name : option.get_lnames()) add("--" + name);
  if (option.get_type_size() == 0) return head;
  std::string type = italic(option.get_type_name());
  for (std::size_t at = type.find('|'); at != std::string::npos; at = type.find('|', at + 1)) {
    type.insert(at + 1, "\\:");  // a line may break there
  }
  return head + " " + type;
}

std::string commandText(const Command& command) {
  const std::unique_ptr<DeclaredCommand> ready = declared(command);
  std::string text = ".SS pneuma " + roff(std::string(command.name)) + "\n" +
                     roff(std::string(command.summary)) + "\n";
  for (const bool positional : {true, false}) {
    for (const CLI::Option* option : ready->parser.get_options()) {
      if (option->get_positional() != positional) continue;
      text += ".TP\n" + optionHead(*option) + "\n" + roff(optionText(*option)) + "\n";
    }
  }
  return text;
}

}  // namespace

std::string manPage() {
  std::string text =
      ".TH PNEUMA 1 \"\" \"Pneuma " + roff(versionText()) +
      "\" \"User Commands\"\n"
      ".nh\n.ad l\n.SH NAME\npneuma \\- from a chest CT to lobes, airway trees and breathing\n"
      ".SH SYNOPSIS\n.B pneuma\n.I COMMAND\n.RI [ ARGUMENTS ]\n"
      ".SH DESCRIPTION\n"
      "Finds lungs in a CT, splits them into lobes, grows bronchial trees in them, "
      "makes them breathe,\nmeasures and shows them. Frames are LPS, units mm. "
      "Research use only; not a medical device.\n.SH COMMANDS\n";
  for (const Command& each : commands()) text += commandText(each);
  text += ".SH EXIT STATUS\n";
  for (const ExitRow& row : ExitRows) {
    text +=
        ".TP\n.B " + std::to_string(static_cast<int>(row.code)) + "\n" + roff(row.meaning) + "\n";
  }
  return text + ".SH SEE ALSO\n.BR pneuma\\-desktop (1)\n";
}

}  // namespace pneuma::cli
