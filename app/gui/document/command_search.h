#pragma once

#include <QString>
#include <cstddef>
#include <optional>
#include <vector>

namespace pneuma {

/// How well a text answers what was typed.
struct CommandMatch {
  int score = 0;          ///< the higher the better
  std::vector<int> hits;  ///< places of the letters in the text that were meant, rising
};

/// Looks for every typed word in a text, in any order, whatever the case and the accents: as the
/// beginning of a word, as the first letters of words ("fl" means "Find lungs"), inside a word, or
/// as letters that follow one another closely. Nothing typed is found everywhere.
/// @return nothing if some word is not found
std::optional<CommandMatch> matchCommand(const QString& typed, const QString& text);

/// Which of the texts answer, the best first; equally good ones keep their order.
std::vector<std::size_t> bestCommands(const QString& typed, const std::vector<QString>& texts);

}  // namespace pneuma
