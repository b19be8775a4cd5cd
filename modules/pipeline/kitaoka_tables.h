#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "growth/kitaoka.h"
#include "pipeline/reproduce.h"

namespace pneuma {

/// One tree of Kitaoka 1999: an organ, and how growth in it differs from her best conditions.
struct KitaokaCase {
  std::string_view organ = "simple";
  KitaokaOptions options = kitaokaPaper();
  double trunkTurnLeftDeg = 0.0;  ///< of the trunk about its start, to the patient's left
  double trunkTurnBackDeg = 0.0;  ///< to the back
  double trunkLength = 1.0;       ///< times the organ's own

  bool operator==(const KitaokaCase&) const = default;
};

/// A published figure and what ours is held to.
struct KitaokaFigure {
  std::string_view quantity;
  double published = 0.0;
  Limit limit;
  std::string_view note = {};
};

using KitaokaFigures = std::vector<KitaokaFigure>;

struct KitaokaRow {
  std::string name;
  KitaokaCase grown;
  KitaokaFigures figures;
};

/// That a quantity rises, or falls, from row to row.
struct KitaokaOrder {
  std::string name;
  std::string_view quantity;
  bool rises = true;
  std::vector<std::size_t> rows;  ///< of the table
};

struct KitaokaTable {
  std::string_view id;
  std::string_view name;
  std::vector<KitaokaRow> rows;
  std::vector<KitaokaOrder> orders = {};
};

/// Tables 1 to 5, the thorax, and what the text claims, with all published figures. Rows of the
/// same case are one tree.
std::vector<KitaokaTable> kitaokaTables();

/// The paper's figures of trees: their names and what they show. 6b is drawn by the caption (rule
/// 6a off), 6b-text as the text has it (rule 8a off).
struct KitaokaPicture {
  std::string_view name;
  KitaokaCase shown;
};

std::vector<KitaokaPicture> kitaokaPictures();

}  // namespace pneuma
