#include "growth/growth.h"

#include <array>

#include "core/error.h"

namespace pneuma {
namespace {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};

std::span<const GrowthMethod> methods() {
  static const auto table = std::to_array<GrowthMethod>({
      {"kitaoka", "Kitaoka's rules",
       "Kitaoka H, Takaki R, Suki B. A three-dimensional model of the human airway tree. J Appl "
       "Physiol 87(6): 2207-2217, 1999",
       KitaokaOptions{}},
      {"centroid", "Centroid splitting",
       "Huang XY, Tan XP, Pei JM. A three dimensional fractal simulation of the lung bronchial "
       "tree. 2004",
       CentroidSplittingOptions{}},
      {"dla", "Diffusion-limited aggregation",
       "Zhang J, Tan XP, Pei JM. DLA simulation of fractal growth of bronchial tree. J Sichuan "
       "Univ "
       "(Eng Sci Ed) 35(1): 66-68, 2003",
       DlaOptions{}},
  });
  return table;
}

}  // namespace

std::span<const GrowthMethod> growthMethods() { return methods(); }

const GrowthMethod& growthMethod(std::string_view name) {
  std::vector<std::string_view> names;
  for (const GrowthMethod& method : methods()) {
    if (method.name == name) return method;
    names.push_back(method.name);
  }
  detail::throwUnknownChoice("the growth method", name, names);
}

const GrowthMethod& growthMethod(const GrowthOptions& options) {
  return methods()[options.index()];
}

GrowthResult growAirways(const AirwayTree& central, std::span<const LobeRegion> lobes,
                         const GrowthOptions& options, const Progress& progress) {
  if (lobes.empty()) throw InvalidInput("there is no lobe to grow in");
  if (central.empty()) {
    throw InvalidInput("there are no central airways to grow from; read some or make a template");
  }
  return std::visit(
      Overloaded{
          [&](const KitaokaOptions& o) { return growByKitaoka(central, lobes, o, progress); },
          [&](const CentroidSplittingOptions& o) {
            return growByCentroidSplitting(central, lobes, o, progress);
          },
          [&](const DlaOptions& o) { return growByDla(central, lobes, o, progress); }},
      options);
}

}  // namespace pneuma
