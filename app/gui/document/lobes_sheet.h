#pragma once

#include <vector>

#include "document/fissure_editor.h"
#include "document/property_sheet.h"

namespace pneuma {

/// Volumes of the lobes that the fissures give, as they are now.
PropertySheet lobeVolumesSheet(const FissureEditor& editor);

/// Checks of the lobes, with their limits; empty while the lungs are not split as shown.
PropertySheet lobeChecksSheet(const FissureEditor& editor, const Document& document);

/// "12 points, mean 0.6 mm", "proposed by the lung's shape", ...
QString fissureLine(const FissureEditor& editor, Fissure fissure);

/// The same in a word or two, with the share that shows: "12 points   98 %".
QString fissureBrief(const FissureEditor& editor, Fissure fissure);

/// "98 % of it shows in the CT"; empty where nothing is known.
QString fissureShows(const FissureEditor& editor, Fissure fissure);

/// A line for every point of a fissure: its place and, where there are enough of them, how far the
/// others put it from there.
std::vector<QString> fissurePointLines(const FissureEditor& editor, Fissure fissure);

}  // namespace pneuma
