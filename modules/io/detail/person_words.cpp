#include "io/detail/person_words.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace pneuma {
namespace {

constexpr std::size_t ShortestName = 2;    // of the patient, as a word of its own
constexpr std::size_t ShortestWord = 3;    // of others and of numbers, as a word of its own
constexpr std::size_t ShortestWithin = 5;  // a name within a longer word
constexpr std::size_t ShortestNumber = 4;  // within a longer word, or with other punctuation
constexpr std::size_t ShortestAcross = 6;  // a number across blanks
constexpr std::size_t MostWords = 16;      // of a name that are looked for within words
constexpr std::size_t MostNumbers = 100;

bool isLetter(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return std::isalnum(byte) != 0 || byte >= 0x80U;
}

/// In small letters, those of Western Europe too (UTF-8).
std::string folded(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool capital = i > 0 && static_cast<unsigned char>(text[i - 1]) == 0xC3U &&
                         byte >= 0x80U && byte <= 0x9EU && byte != 0x97U;
    if (capital || (byte >= 'A' && byte <= 'Z')) text[i] = static_cast<char>(byte + 0x20U);
  }
  return text;
}

/// The words of a text, folded().
std::vector<std::string> wordsOf(const std::string& text) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : folded(text) + ' ') {
    if (isLetter(c)) {
      word += c;
    } else if (!word.empty()) {
      words.push_back(std::exchange(word, {}));
    }
  }
  return words;
}

/// Letters and digits alone, folded().
std::string squeezed(const std::string& text) {
  std::string result;
  for (const char c : folded(text)) {
    if (isLetter(c)) result += c;
  }
  return result;
}

struct Person {
  std::set<std::string> words;     ///< that name them
  std::vector<std::string> glued;  ///< names, to be found within words
  std::set<std::string> initials;  ///< two names, or one with an initial, as a word of their own
  std::vector<std::string> numbers;
};

void addName(Person& person, const std::string& name, std::size_t shortest) {
  std::vector<std::string> words = wordsOf(name);
  for (const std::string& word : words) {
    if (word.size() >= shortest) person.words.insert(word);
  }
  words.resize(std::min(words.size(), MostWords));
  for (const std::string& word : words) {
    if (word.size() >= ShortestWithin) person.glued.push_back(word);
    for (const std::string& other : words) {
      if (&word == &other || word.size() < ShortestName) continue;
      if (word.size() + other.size() >= ShortestWithin && other.size() >= ShortestName) {
        person.glued.push_back(word + other);
      }
      person.initials.insert(word + other);
      person.initials.insert(word + other.front());
      person.initials.insert(other.front() + word);
    }
  }
}

/// Of several values, with backslashes between them.
void addNumbers(Person& person, const std::string& values) {
  std::istringstream stream(values);
  for (std::string value; std::getline(stream, value, '\\');) {
    for (const std::string& word : wordsOf(value)) {
      if (word.size() >= ShortestWord) person.words.insert(word);
    }
    if (person.numbers.size() >= MostNumbers) continue;
    const std::string number = squeezed(value);
    person.numbers.push_back(number.substr(std::min(number.find_first_not_of('0'), number.size())));
  }
}

/// A date as DICOM writes it, 19310213, in other orders and without the century.
void addDate(Person& person, const std::string& date) {
  if (date.size() != 8) return;
  const std::string year = date.substr(0, 4);
  const std::string month = date.substr(4, 2);
  const std::string day = date.substr(6, 2);
  for (const std::string& shown : {year, year.substr(2)}) {
    person.numbers.push_back(shown + month + day);
    person.numbers.push_back(day + month + shown);
    person.numbers.push_back(month + day + shown);
  }
}

Person personIn(const Identifiers& identifiers) {
  Person person;
  const auto with = [&](std::initializer_list<const char*> keywords, const auto& add) {
    for (const char* keyword : keywords) {
      const auto found = identifiers.find(keyword);
      if (found != identifiers.end()) add(found->second);
    }
  };
  with({"PatientName"}, [&](const std::string& name) { addName(person, name, ShortestName); });
  with({"ReferringPhysicianName", "PerformingPhysicianName", "OperatorsName"},
       [&](const std::string& name) { addName(person, name, ShortestWord); });
  with({"PatientID", "OtherPatientIDs", "AccessionNumber", "PatientBirthDate"},
       [&](const std::string& number) { addNumbers(person, number); });
  with({"PatientBirthDate"}, [&](const std::string& date) { addDate(person, date); });
  return person;
}

bool isNamed(const std::string& word, const Person& person) {
  const std::string all = squeezed(word);
  return person.initials.contains(all) ||
         std::ranges::any_of(person.glued,
                             [&](const std::string& name) { return all.find(name) != all.npos; }) ||
         std::ranges::any_of(wordsOf(word), [&](const std::string& part) {
           if (person.words.contains(part) || person.initials.contains(part)) return true;
           // Scripts without blanks.
           return std::ranges::any_of(person.words, [&](const std::string& name) {
             return static_cast<unsigned char>(name.front()) >= 0xE0U &&
                    part.find(name) != part.npos;
           });
         });
}

}  // namespace

std::string withoutPerson(const std::string& description, const Identifiers& identifiers) {
  const Person person = personIn(identifiers);
  std::vector<std::string> words;
  std::vector<bool> named;
  std::string all;                  // squeezed
  std::vector<std::size_t> wordAt;  // for each byte of it
  std::istringstream stream(description);
  for (std::string word; stream >> word;) {
    all += squeezed(word);
    wordAt.resize(all.size(), words.size());
    named.push_back(isNamed(word, person));
    words.push_back(word);
  }
  for (const std::string& number : person.numbers) {
    if (number.size() < ShortestNumber) continue;
    for (std::size_t at = all.find(number); at != all.npos; at = all.find(number, at + 1)) {
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
