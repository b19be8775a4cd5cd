#include "cli/completion_scripts.h"

#include "cli/text.h"

namespace pneuma::cli {
namespace {

std::string joined(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

std::vector<std::string> typedNames(const CompletedOption& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.shortNames) names.push_back(std::string("-") + name);
  for (const std::string& name : option.longNames) names.push_back(std::string("--") + name);
  return names;
}

/// zsh gives ':', '[' and ']' a meaning inside specifications.
std::string zshEscaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == ':' || c == '[' || c == ']') result += '\\';
    result += c;
  }
  return result;
}

std::string zshAction(const CompletedOption& option) {
  if (!option.choices.empty()) {
    const std::string choices = joined(option.choices, " ");
    return "(" + choices + ")";
  }
  if (option.isFile) return "_files";
  if (option.isFolder) return "_files -/";
  return " ";
}

std::string zshSpecification(const CompletedOption& option, const std::string& name) {
  std::string text = name;
  text.append("[").append(zshEscaped(option.help)).append("]");
  if (option.takesValue) text.append(":value:").append(zshAction(option));
  return shellQuoted(text);
}

std::string fishOption(const std::string& command, const CompletedOption& option) {
  std::string line =
      "complete -c pneuma -n " + shellQuoted(std::string("__fish_seen_subcommand_from ") + command);
  for (const std::string& name : option.shortNames) line += " -s " + name;
  for (const std::string& name : option.longNames) line += " -l " + name;
  if (!option.choices.empty()) {
    line += (option.positional ? " -a " : " -x -a ") + shellQuoted(joined(option.choices, " "));
  } else if (option.isFile || option.isFolder) {
    line += option.positional ? " -F" : " -r -F";
  } else if (option.takesValue) {
    line += " -x";
  }
  return line + " -d " + shellQuoted(option.help) + "\n";
}

/// What bash offers after an option that takes a value.
std::string bashValues(const CompletedOption& option) {
  if (!option.choices.empty()) {
    const std::string choices = shellQuoted(joined(option.choices, " "));
    return "COMPREPLY=($(compgen -W " + choices + " -- \"$current\"))";
  }
  if (option.isFolder) return "COMPREPLY=($(compgen -d -- \"$current\"))";
  if (option.isFile) return "COMPREPLY=($(compgen -f -- \"$current\"))";
  return "COMPREPLY=()";
}

/// The branch of bash's `case` for one command.
std::string bashCase(const CompletedCommand& command) {
  std::vector<std::string> words;
  std::string values;
  bool takesFiles = false;
  for (const CompletedOption& option : command.options) {
    const std::vector<std::string> names = typedNames(option);
    if (option.positional) {
      words.insert(words.end(), option.choices.begin(), option.choices.end());
      takesFiles = takesFiles || option.isFile || option.isFolder;
      continue;
    }
    words.insert(words.end(), names.begin(), names.end());
    if (!option.takesValue) continue;
    values.append("        ").append(joined(names, "|")).append(") ");
    values.append(bashValues(option)).append("; return ;;\n");
  }
  std::string text = "    " + command.name + ")\n";
  if (!values.empty()) text += "      case $previous in\n" + values + "      esac\n";
  text += "      COMPREPLY=($(compgen -W " + shellQuoted(joined(words, " ")) + " -- \"$current\")";
  if (takesFiles) text += " $(compgen -f -- \"$current\")";
  return text + ") ;;\n";
}

}  // namespace

std::string bashCompletion(const std::vector<CompletedCommand>& commands) {
  std::vector<std::string> names;
  std::string cases;
  for (const CompletedCommand& command : commands) {
    names.push_back(command.name);
    cases += bashCase(command);
  }
  return "# bash completion of pneuma, made by 'pneuma completion bash'\n"
         "_pneuma() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
         "  if ((COMP_CWORD == 1)); then\n"
         "    COMPREPLY=($(compgen -W " +
         shellQuoted(joined(names, " ")) +
         " -- \"$current\"))\n"
         "    return\n"
         "  fi\n"
         "  case ${COMP_WORDS[1]} in\n" +
         cases +
         "  esac\n"
         "}\n"
         "complete -o filenames -F _pneuma pneuma\n";
}

std::string zshCompletion(const std::vector<CompletedCommand>& commands) {
  std::string list;
  std::string cases;
  for (const CompletedCommand& command : commands) {
    list += "    " + shellQuoted(zshEscaped(command.name) + ":" + command.summary) + "\n";
    cases += "    " + command.name + ")\n      _arguments";
    for (const CompletedOption& option : command.options) {
      if (option.positional) {
        cases += " \\\n        " + shellQuoted("*:argument:" + zshAction(option));
        continue;
      }
      for (const std::string& name : typedNames(option)) {
        cases += " \\\n        " + zshSpecification(option, name);
      }
    }
    cases += " ;;\n";
  }
  return "#compdef pneuma\n"
         "# zsh completion of pneuma, made by 'pneuma completion zsh'\n"
         "_pneuma() {\n"
         "  local -a commands=(\n" +
         list +
         "  )\n"
         "  if ((CURRENT == 2)); then\n"
         "    _describe command commands\n"
         "    return\n"
         "  fi\n"
         "  local command=$words[2]\n"
         "  shift words\n"
         "  ((CURRENT--))\n"
         "  case $command in\n" +
         cases +
         "  esac\n"
         "}\n"
         "if [[ $funcstack[1] == _pneuma ]]; then _pneuma \"$@\"; else compdef _pneuma pneuma; "
         "fi\n";
}

std::string fishCompletion(const std::vector<CompletedCommand>& commands) {
  std::string text =
      "# fish completion of pneuma, made by 'pneuma completion fish'\n"
      "complete -c pneuma -f\n";
  for (const CompletedCommand& command : commands) {
    text += "complete -c pneuma -n __fish_use_subcommand -a " + command.name + " -d " +
            shellQuoted(command.summary) + "\n";
  }
  for (const CompletedCommand& command : commands) {
    for (const CompletedOption& option : command.options) text += fishOption(command.name, option);
  }
  return text;
}

}  // namespace pneuma::cli
