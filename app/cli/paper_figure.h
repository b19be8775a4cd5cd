#pragma once

#include <span>
#include <string_view>

#include "cli/paper_pictures.h"

namespace pneuma::cli {

/// One figure of a paper: its file and how to draw it.
struct PaperFigure {
  std::string_view file;
  Picture (*draw)(const Reproduction& reproduction, const Progress& progress);
};

/// Huang 2004: the lobes (Fig. 1), the tree up to generation 2, 3, 6, 8, 12 and 14 on one sheet
/// (Fig. 4), the whole tree from the front with the upper lobe red, the middle one green and the
/// lower one blue (Fig. 5).
std::span<const PaperFigure> huangFigures();

/// Kitaoka 1999: projections of the trees without supplementary rules (Fig. 6 A), without rule 6a
/// (B by its caption), without rule 8a (B by the text) and with all rules (C); the thorax with
/// every segment in its own colour from the front and from the right (Fig. 7).
std::span<const PaperFigure> kitaokaFigures();

/// Santhanam 2003: strain over distance for the healthy and the ill (Fig. 5, the mechanism of the
/// paper), lungs at rest (Fig. 6) and breathed in by 1.5 l (Fig. 7) from the same place, both in
/// one picture (Fig. 8).
std::span<const PaperFigure> santhanam2003Figures();

/// Santhanam 2008: fitted breaths (Fig. 2), the lungs' box while volume rises (Fig. 4), how fast
/// pitching and damped masses come to rest (Fig. 7), the bent plane (Fig. 8), the blown disc
/// (Fig. 9).
std::span<const PaperFigure> santhanam2008Figures();

/// Zhang 2003: the tree in the outline of a right lung (Fig. 1); the same with long steps, from two
/// other centres and with absorbing walls on one sheet; a million particles in three lobes.
std::span<const PaperFigure> zhangFigures();

/// The organ that was kept under this name.
const LungModel& figureModel(const Reproduction& reproduction, std::string_view name);

}  // namespace pneuma::cli
