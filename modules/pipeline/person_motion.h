#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "breathing/motion_form.h"
#include "io/json.h"

namespace pneuma {

/// Constants that `pneuma estimate` fitted to a person, and what they are worth.
struct PersonMotion {
  std::string name;  ///< of the file, in quotation marks
  FormKind kind = FormKind::Deep;
  MotionForm form;
  std::size_t landmarks = 0;      ///< fitted
  std::size_t heldOut = 0;        ///< landmarks that were not
  double errorMm = 0.0;           ///< mean on these, or on the fitted where there are none
  double stillMm = 0.0;           ///< of no motion on the same
  std::map<Side, double> strain;  ///< of each lung while its landmarks moved
  std::map<Side, double> restMl;  ///< volume of each lung at rest; empty where it is not known
};

/// Reads the file of `pneuma estimate`.
/// @throws InputMissing; InvalidInput if it is no such file, is damaged, or its constants are out
/// of range
PersonMotion readPersonMotion(const std::filesystem::path& path);

/// What stands in the way of moving lungs by a person's constants, in whole sentences: lungs of
/// other volumes, breaths of another size.
/// @param restMm3,mostMm3 volumes of each lung that breathes
std::vector<std::string> doubts(const PersonMotion& person, const std::map<Side, double>& restMm3,
                                const std::map<Side, double>& mostMm3);

/// In a sentence without its end: "constants fitted to ...".
std::string basisOf(const PersonMotion& person);

Json toJson(const PersonMotion& person);

}  // namespace pneuma
