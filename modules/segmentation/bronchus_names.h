#pragma once

#include <optional>

#include "anatomy/airway_tree.h"

namespace pneuma {

/// Where the named bronchi of a measured tree begin: indices of branches. What cannot be told stays
/// empty.
struct BronchusNames {
  std::optional<Vec3> carina;          ///< LPS, mm
  std::optional<std::size_t> trachea;  ///< the branch that ends at the carina
  std::optional<std::size_t> rightMain;
  std::optional<std::size_t> leftMain;
  std::optional<std::size_t> intermedius;
  std::optional<std::size_t> rightUpper;
  std::optional<std::size_t> rightMiddle;
  std::optional<std::size_t> rightLower;
  std::optional<std::size_t> leftUpper;
  std::optional<std::size_t> leftLower;

  /// Of the five lobar bronchi.
  int lobarCount() const {
    return (rightUpper ? 1 : 0) + (rightMiddle ? 1 : 0) + (rightLower ? 1 : 0) +
           (leftUpper ? 1 : 0) + (leftLower ? 1 : 0);
  }
};

/// Finds carina, main and lobar bronchi by the amount and the direction of what they carry, and
/// marks every branch below a lobar bronchus with its lobe, others as central.
/// @param tree LPS, root at the top of the trachea
BronchusNames nameBronchi(AirwayTree& tree);

/// Length from where a named bronchus begins to where the next one does, or to its end, mm.
double lengthBetweenMm(const AirwayTree& tree, std::size_t from, std::optional<std::size_t> to);

}  // namespace pneuma
