#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "lobes/fissure_proposal.h"

namespace pneuma::testing {

/// A person's points upon fissures, carried into the lungs of lungs_cip_10002K. LPS, mm.
struct Person {
  std::string name;
  std::map<Fissure, std::vector<Vec3>> points;
};

/// The people of fissures_cip, by name.
std::vector<Person> fissurePopulation(const std::filesystem::path& folder);

/// The fissure of most of these people: quadratics fitted to the points of each in the lung's box,
/// every person with the same weight, points far off with less (Cauchy).
/// @param leftOut who does not count; none if it is people.size()
BoxQuadratic usualFissure(const std::vector<Person>& people, std::size_t leftOut, Fissure fissure,
                          const LungBox& box);

}  // namespace pneuma::testing
