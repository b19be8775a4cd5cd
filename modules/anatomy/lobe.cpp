#include "anatomy/lobe.h"

#include <cctype>
#include <string>

namespace pneuma {
namespace {

struct LobeNames {
  Lobe lobe;
  std::string_view brief;
  std::string_view full;
  Side side;
};

constexpr std::array<LobeNames, 9> Names = {{
    {Lobe::Whole, "whole", "whole organ", Side::None},
    {Lobe::RightUpper, "RUL", "right upper lobe", Side::Right},
    {Lobe::RightMiddle, "RML", "right middle lobe", Side::Right},
    {Lobe::RightLower, "RLL", "right lower lobe", Side::Right},
    {Lobe::LeftUpper, "LUL", "left upper lobe", Side::Left},
    {Lobe::LeftLower, "LLL", "left lower lobe", Side::Left},
    {Lobe::Central, "central", "trachea and main bronchi", Side::None},
    {Lobe::RightLung, "right", "right lung", Side::Right},
    {Lobe::LeftLung, "left", "left lung", Side::Left},
}};

const LobeNames& namesOf(Lobe lobe) {
  for (const LobeNames& names : Names) {
    if (names.lobe == lobe) return names;
  }
  return Names[0];
}

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

}  // namespace

Side side(Lobe lobe) { return namesOf(lobe).side; }

std::string_view shortName(Lobe lobe) { return namesOf(lobe).brief; }

std::string_view longName(Lobe lobe) { return namesOf(lobe).full; }

std::string_view name(Side side) {
  return side == Side::Right ? "right" : side == Side::Left ? "left" : "none";
}

std::optional<Lobe> lobeOfShortName(std::string_view text) {
  const std::string wanted = lowerCase(text);
  for (const LobeNames& names : Names) {
    if (lowerCase(names.brief) == wanted) return names.lobe;
  }
  return std::nullopt;
}

std::optional<Lobe> lobeOfFileName(std::string_view fileName) {
  fileName = fileName.substr(fileName.find_last_of("/\\") + 1);
  const std::string stem = lowerCase(fileName.substr(0, fileName.rfind('.')));
  std::optional<Lobe> lung;
  for (std::size_t begin = 0; begin < stem.size();) {
    std::size_t end = begin;
    while (end < stem.size() && std::isalpha(static_cast<unsigned char>(stem[end])) != 0) ++end;
    const std::optional<Lobe> lobe = lobeOfShortName(stem.substr(begin, end - begin));
    if (lobe.has_value() && *lobe >= Lobe::RightUpper && *lobe <= Lobe::LeftLower) return lobe;
    if (lobe == Lobe::RightLung || lobe == Lobe::LeftLung) lung = lobe;
    begin = end + 1;
  }
  return lung;
}

}  // namespace pneuma
