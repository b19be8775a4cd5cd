#pragma once

#include "segmentation/lung_segmentation.h"

namespace pneuma {

/// Closes the air of one lung to the lung, vessels and hilum included, and writes it into `labels`;
/// airways and the other lung keep their labels.
/// @param label 10 or 20
LungFinding closeLung(const CtImage& ct, std::uint8_t label, const LungOptions& options,
                      LabelImage& labels, const Progress& progress = {});

/// Measures a lung in labels as they are: its volume, its density, its air under a threshold, where
/// it is cut off, what closing would add. What was found of its airways stays.
void measureLung(const CtImage& ct, std::uint8_t label, double thresholdHu,
                 const LabelImage& labels, LungFinding& finding, const Progress& progress = {});

}  // namespace pneuma
