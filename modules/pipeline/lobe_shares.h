#pragma once

#include <map>
#include <string>

#include "lobes/lobe_splitting.h"

namespace pneuma {

/// Wanted shares of the lobes as people type them: "RUL,RML,RLL" or "RUL,RML,RLL/LUL,LLL" in
/// percent, "usual" for usualShares(), nothing for none.
/// @throws InvalidOption
std::map<Side, LobeShares> lobeSharesOfText(const std::string& text);

/// Back to text: "40.5,12.9,46.6/50,50".
std::string textOfLobeShares(const std::map<Side, LobeShares>& shares);

}  // namespace pneuma
