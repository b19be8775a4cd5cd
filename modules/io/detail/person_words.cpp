#include "io/detail/person_words.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace pneuma {
namespace {

using Text = std::u32string;

constexpr std::size_t ShortestName = 2;    // of the patient, as a word of its own
constexpr std::size_t ShortestWord = 3;    // of others and of numbers, as a word of its own
constexpr std::size_t ShortestWithin = 5;  // a name within a longer word
constexpr std::size_t ShortestNumber = 4;  // within a longer word, or with other punctuation
constexpr std::size_t ShortestAcross = 6;  // a number across blanks
constexpr std::size_t MostWords = 16;      // of a name that are looked for within words
constexpr std::size_t MostNumbers = 100;
constexpr std::size_t LongestText = 1024;  // bytes; DICOM allows 64 letters, damaged files say more
constexpr char32_t WithoutBlanks = 0x800;  // scripts from here on need none between words

/// In small letters, of the Latin, Greek and Cyrillic alphabets.
char32_t folded(char32_t c) {
  const auto within = [c](char32_t first, char32_t last) { return c >= first && c <= last; };
  if (within('A', 'Z') || (within(0xC0, 0xDE) && c != 0xD7)) return c + 0x20;
  if (within(0x100, 0x137) || within(0x14A, 0x177)) return c | 1U;
  if (within(0x139, 0x148) || within(0x179, 0x17E)) return c % 2 == 1 ? c + 1 : c;
  if (c == 0x178) return 0xFF;
  if (c == 0x386) return 0x3AC;
  if (within(0x388, 0x38A)) return c + 0x25;
  if (c == 0x38C) return 0x3CC;
  if (within(0x38E, 0x38F)) return c + 0x3F;
  if (within(0x391, 0x3A9) || within(0x410, 0x42F)) return c + 0x20;
  if (within(0x400, 0x40F)) return c + 0x50;
  return c;
}

/// The characters of UTF-8, folded(); what is none is taken byte by byte.
Text charactersOf(std::string_view text) {
  Text result;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t size = lead < 0xC0U ? 1 : lead < 0xE0U ? 2 : lead < 0xF0U ? 3 : 4;
    char32_t c = size == 1 ? lead : lead & (0xFFU >> (size + 1));
    std::size_t taken = 1;
    while (taken < size && i + taken < text.size() &&
           (static_cast<unsigned char>(text[i + taken]) & 0xC0U) == 0x80U) {
      c = c << 6U | (static_cast<unsigned char>(text[i + taken++]) & 0x3FU);
    }
    result += folded(taken == size ? c : lead);
    i += taken;
  }
  return result;
}

bool isDigit(char32_t c) { return c >= '0' && c <= '9'; }

bool isLetter(char32_t c) { return (c >= 'a' && c <= 'z') || c >= 0x80; }

/// The runs of letters and digits of a text.
std::vector<Text> wordsIn(std::string_view text) {
  std::vector<Text> words;
  Text word;
  for (const char32_t c : charactersOf(text) + U' ') {
    if (isLetter(c) || isDigit(c)) {
      word += c;
    } else if (!word.empty()) {
      words.push_back(std::exchange(word, {}));
    }
  }
  return words;
}

/// Letters and digits alone.
Text squeezed(std::string_view text) {
  Text result = charactersOf(text);
  std::erase_if(result, [](char32_t c) { return !isLetter(c) && !isDigit(c); });
  return result;
}

/// Its runs of letters.
std::vector<Text> withoutDigits(const Text& word) {
  std::vector<Text> runs(1);
  for (const char32_t c : word) {
    if (!isDigit(c)) {
      runs.back() += c;
    } else if (!runs.back().empty()) {
      runs.emplace_back();
    }
  }
  return runs;
}

struct Person {
  std::set<Text> words;     ///< that name them: names, two of them, or one with an initial
  std::vector<Text> glued;  ///< names, to be found within words
  std::vector<Text> numbers;
};

void addName(Person& person, std::string_view name, std::size_t shortest) {
  std::vector<Text> words = wordsIn(name);
  for (const Text& word : words) {
    if (word.size() >= shortest) person.words.insert(word);
  }
  words.resize(std::min(words.size(), MostWords));
  for (const Text& word : words) {
    if (word.size() >= ShortestWithin) person.glued.push_back(word);
    for (const Text& other : words) {
      if (&word == &other || word.size() < ShortestName) continue;
      if (word.size() + other.size() >= ShortestWithin && other.size() >= ShortestName) {
        person.glued.push_back(word + other);
      }
      person.words.insert({word + other, word + other.front(), other.front() + word});
    }
  }
}

/// Of several values, with backslashes between them.
void addNumbers(Person& person, const std::string& values) {
  std::istringstream stream(values);
  for (std::string value; std::getline(stream, value, '\\');) {
    for (const Text& word : wordsIn(value)) {
      if (word.size() >= ShortestWord) person.words.insert(word);
    }
    if (person.numbers.size() >= MostNumbers) continue;
    const Text number = squeezed(value);
    person.numbers.push_back(
        number.substr(std::min(number.find_first_not_of(U'0'), number.size())));
  }
}

/// A date as DICOM writes it, 19310213: in other orders, without the century and zeros.
void addDate(Person& person, const std::string& date) {
  if (date.size() != 8) return;
  const Text all = charactersOf(date);
  const auto both = [](const Text& two) {
    return std::vector<Text>{two, two.front() == U'0' ? two.substr(1) : two};
  };
  for (const Text& year : {all.substr(0, 4), all.substr(2, 2)}) {
    for (const Text& month : both(all.substr(4, 2))) {
      for (const Text& day : both(all.substr(6, 2))) {
        for (const Text& shown : {year + month + day, day + month + year, month + day + year}) {
          person.numbers.push_back(shown);
        }
      }
    }
  }
}

Person personIn(const Identifiers& identifiers) {
  Person person;
  const auto with = [&](std::initializer_list<const char*> keywords, const auto& add) {
    for (const char* keyword : keywords) {
      const auto found = identifiers.find(keyword);
      if (found != identifiers.end()) add(found->second.substr(0, LongestText));
    }
  };
  with({"PatientName"}, [&](const std::string& name) { addName(person, name, ShortestName); });
  with({"ReferringPhysicianName", "PerformingPhysicianName", "OperatorsName"},
       [&](const std::string& name) { addName(person, name, ShortestWord); });
  with({"PatientBirthDate"}, [&](const std::string& date) { addDate(person, date); });
  with({"PatientID", "OtherPatientIDs", "AccessionNumber", "PatientBirthDate"},
       [&](const std::string& number) { addNumbers(person, number); });
  return person;
}

/// True if a word without blanks names the person.
bool isNamed(const std::string& word, const Person& person) {
  const Text all = squeezed(word);
  const auto isWithin = [](const Text& longer) {
    return [&longer](const Text& name) { return longer.find(name) != Text::npos; };
  };
  if (person.words.contains(all) || std::ranges::any_of(person.glued, isWithin(all))) return true;
  const auto isName = [&](const Text& part) { return person.words.contains(part); };
  return std::ranges::any_of(wordsIn(word), [&](const Text& part) {
    return isName(part) || std::ranges::any_of(withoutDigits(part), isName) ||
           std::ranges::any_of(person.words, [&](const Text& name) {
             return name.front() >= WithoutBlanks && isWithin(part)(name);
           });
  });
}

}  // namespace

std::string withoutPerson(const std::string& description, const Identifiers& identifiers) {
  if (description.empty()) return {};
  const Person person = personIn(identifiers);
  std::vector<std::string> words;
  std::vector<bool> named;
  Text all;                         // squeezed
  std::vector<std::size_t> wordAt;  // for each character of it
  std::istringstream stream(description.substr(0, LongestText));
  for (std::string word; stream >> word;) {
    all += squeezed(word);
    wordAt.resize(all.size(), words.size());
    named.push_back(isNamed(word, person));
    words.push_back(word);
  }
  for (const Text& number : person.numbers) {
    if (number.size() < ShortestNumber) continue;
    for (std::size_t at = all.find(number); at != Text::npos; at = all.find(number, at + 1)) {
      const std::size_t first = wordAt[at];
      const std::size_t last = wordAt[at + number.size() - 1];
      if (first != last && number.size() < ShortestAcross) continue;
      for (std::size_t i = first; i <= last; ++i) named[i] = true;
    }
  }
  std::string kept;
  for (std::size_t i = 0; i < words.size(); ++i) {
    kept += (i == 0 ? "" : " ") + (named[i] ? "..." : words[i]);
  }
  return kept;
}

}  // namespace pneuma
