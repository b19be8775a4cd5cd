#pragma once

#include <map>
#include <string>

#include "anatomy/morphometry.h"
#include "io/json.h"

namespace pneuma {

/// {"count","mean","sd","min","max"}; null for figures of an empty set.
Json toJson(const Summary& summary);

/// The "morphometry" object of the growth and measure reports; keys end in their units. What was
/// not measured (the gap without a region) is left out, what cannot be known is null.
Json toJson(const Morphometry& morphometry);

/// Every figure that has been published, beside what was measured:
/// [{"quantity","value","low","high","source"}].
Json publishedJson(const Morphometry& whole);

/// A table for people: quantity, measured, the published band and its source, beside each other;
/// then the figures of every lobe.
std::string measureText(const Morphometry& whole, const std::map<Lobe, Morphometry>& byLobe);

/// "region,quantity,value,published_low,published_high,source", one line per figure that is known.
/// The whole tree is the region "all"; bands stand beside its figures only.
std::string measureCsv(const Morphometry& whole, const std::map<Lobe, Morphometry>& byLobe);

}  // namespace pneuma
