#include "pipeline/detail/sample_walls.h"

#include "pipeline/detail/lung_lattice.h"

namespace pneuma {

std::map<Side, TriangleMesh> sampleWalls() {
  constexpr double CellMm = 6.0;
  std::map<Side, TriangleMesh> walls;
  for (const auto& [side, lung] :
       {std::pair(Side::Right, Lobe::RightLung), std::pair(Side::Left, Lobe::LeftLung)}) {
    walls.emplace(side, LungLattice(sampleLung(side), CellMm).surface(lung));
  }
  return walls;
}

}  // namespace pneuma
