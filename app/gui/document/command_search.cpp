#include "document/command_search.h"

#include <QStringList>
#include <algorithm>
#include <utility>

namespace pneuma {

namespace {

constexpr int WholeWord = 120;
constexpr int WordStart = 100;
constexpr int Initials = 80;
constexpr int InsideWord = 60;
constexpr int Scattered = 20;
constexpr int FarPenalty = 30;  ///< at most, for words that come late in the text

/// Letter by letter, so that places stay the same.
QString folded(const QString& text) {
  QString plain = text;
  for (QChar& letter : plain) {
    const QString parts = letter.decomposition();
    if (!parts.isEmpty() && letter.decompositionTag() == QChar::Canonical) letter = parts.front();
    letter = letter.toLower();
  }
  return plain;
}

bool beginsWord(const QString& text, int place) {
  return text[place].isLetterOrNumber() && (place == 0 || !text[place - 1].isLetterOrNumber());
}

std::vector<int> run(int from, int length) {
  std::vector<int> places;
  for (int i = from; i < from + length; ++i) places.push_back(i);
  return places;
}

CommandMatch scored(int score, std::vector<int> hits) {
  const int penalty = std::min(FarPenalty, hits.front() / 8);  // a letter more or less is nothing
  return {score - penalty, std::move(hits)};
}

std::optional<CommandMatch> matchInOnePiece(const QString& word, const QString& text) {
  std::optional<CommandMatch> best;
  for (int at = text.indexOf(word); at >= 0; at = text.indexOf(word, at + 1)) {
    const int end = at + word.size();
    const bool starts = beginsWord(text, at) || !text[at].isLetterOrNumber();
    const bool ends = end == text.size() || !text[end].isLetterOrNumber();
    CommandMatch match = scored(starts && ends ? WholeWord
                                : starts       ? WordStart
                                               : InsideWord,
                                run(at, word.size()));
    if (!best || match.score > best->score) best = std::move(match);
  }
  return best;
}

std::optional<CommandMatch> matchInitials(const QString& word, const QString& text) {
  std::vector<int> places;
  for (int at = 0; at < text.size() && static_cast<int>(places.size()) < word.size(); ++at) {
    if (!beginsWord(text, at)) continue;
    if (text[at] == word[static_cast<int>(places.size())]) {
      places.push_back(at);
    } else if (!places.empty()) {
      return std::nullopt;  // of words that follow one another
    }
  }
  if (static_cast<int>(places.size()) < word.size() || word.size() < 2) return std::nullopt;
  return scored(Initials, std::move(places));
}

/// From the beginning of a word, and not far apart: otherwise every text would have every word.
std::optional<CommandMatch> matchScattered(const QString& word, const QString& text) {
  if (word.size() < 3) return std::nullopt;
  for (int from = 0; from < text.size(); ++from) {
    if (text[from] != word[0] || !beginsWord(text, from)) continue;
    std::vector<int> places = {from};
    for (int at = from + 1; at < text.size() && static_cast<int>(places.size()) < word.size(); ++at)
      if (text[at] == word[static_cast<int>(places.size())]) places.push_back(at);
    const bool all = static_cast<int>(places.size()) == word.size();
    const int span = places.back() - from + 1;
    if (!all || span > 2 * word.size() + 1) continue;
    return scored(Scattered + 10 - std::min<int>(10, span - word.size()), std::move(places));
  }
  return std::nullopt;
}

}  // namespace

std::optional<CommandMatch> matchCommand(const QString& typed, const QString& text) {
  const QString plain = folded(text);
  CommandMatch all;
  const QStringList words = folded(typed).split(QLatin1Char(' '), Qt::SkipEmptyParts);
  for (const QString& word : words) {
    std::optional<CommandMatch> best;
    for (auto* way : {&matchInOnePiece, &matchInitials, &matchScattered}) {
      auto match = way(word, plain);
      if (match && (!best || match->score > best->score)) best = std::move(match);
    }
    if (!best) return std::nullopt;
    all.score += best->score;
    all.hits.insert(all.hits.end(), best->hits.begin(), best->hits.end());
  }
  if (!words.isEmpty()) all.score /= words.size();
  std::sort(all.hits.begin(), all.hits.end());
  all.hits.erase(std::unique(all.hits.begin(), all.hits.end()), all.hits.end());
  return all;
}

std::vector<std::size_t> bestCommands(const QString& typed, const std::vector<QString>& texts) {
  std::vector<std::pair<int, std::size_t>> found;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (const auto match = matchCommand(typed, texts[i])) found.emplace_back(match->score, i);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::size_t> order;
  for (const auto& [score, index] : found) order.push_back(index);
  return order;
}

}  // namespace pneuma
