#include "pipeline/lobe_shares.h"

#include <algorithm>
#include <sstream>

#include "core/error.h"
#include "core/options.h"

namespace pneuma {
namespace {

LobeShares sharesOf(const std::string& text, std::size_t count) {
  LobeShares shares;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    try {
      std::size_t used = 0;
      shares.push_back(std::stod(part, &used) / 100.0);
      if (used != part.size()) shares.clear();
    } catch (const std::exception&) {
      shares.clear();
    }
    if (shares.empty()) break;
  }
  if (shares.size() == count) return shares;
  throw InvalidOption("fractions are RUL,RML,RLL or RUL,RML,RLL/LUL,LLL in percent, not '" + text +
                      "'");
}

}  // namespace

std::string textOfLobeShares(const std::map<Side, LobeShares>& shares) {
  const auto isUsual = [](const auto& entry) { return entry.second == usualShares(entry.first); };
  if (shares.size() == 2 && std::ranges::all_of(shares, isUsual)) return "usual";
  std::string text;
  for (const Side of : {Side::Right, Side::Left}) {
    const auto wanted = shares.find(of);
    if (wanted == shares.end()) continue;
    if (!text.empty()) text += "/";
    std::string list;
    for (const double share : wanted->second) {
      list += (list.empty() ? "" : ",") + textOf(100.0 * share);
    }
    text += list;
  }
  return text;
}

std::map<Side, LobeShares> lobeSharesOfText(const std::string& text) {
  if (text.empty()) return {};
  if (text == "usual") {
    return {{Side::Right, usualShares(Side::Right)}, {Side::Left, usualShares(Side::Left)}};
  }
  const std::size_t slash = text.find('/');
  std::map<Side, LobeShares> shares;
  shares[Side::Right] = sharesOf(text.substr(0, slash), 3);
  if (slash != std::string::npos) shares[Side::Left] = sharesOf(text.substr(slash + 1), 2);
  return shares;
}

}  // namespace pneuma
