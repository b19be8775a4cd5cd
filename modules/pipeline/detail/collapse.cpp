#include "pipeline/detail/collapse.h"

#include <cmath>
#include <utility>

#include "core/error.h"

namespace pneuma {
namespace {

/// Where the airways enter a lung, or the middle of its side towards the heart without any.
Vec3 hilumOf(const LungModel& model, Side of, const Box3& box) {
  if (const auto tree = treeOf(model)) {
    for (const Branch& branch : *tree) {
      if (side(branch.lobe) == of) return branch.proximal;
    }
  }
  Vec3 hilum = box.center();
  hilum.x() = of == Side::Right ? box.max().x() : box.min().x();
  return hilum;
}

}  // namespace

double Collapse::size() const { return std::cbrt(share); }

Collapse collapseOf(const LungModel& model, Side of, double share) {
  Box3 box;
  if (model.surfaces) {
    for (const LobeSurface& surface : *model.surfaces) {
      if (side(surface.lobe) == of) box.extend(bounds(*surface.mesh));
    }
  }
  if (box.isEmpty()) {
    throw InvalidInput("there is no " + std::string(name(of)) +
                       " lung to have a pneumothorax; choose the other with --affected");
  }
  return {of, hilumOf(model, of, box), share};
}

LungModel collapsed(const LungModel& model, const Collapse& collapse) {
  const double size = collapse.size();
  const auto shrunk = [&](const Vec3& p) {
    return Vec3(collapse.hilum + size * (p - collapse.hilum));
  };
  LungModel result = model;
  auto surfaces = std::make_shared<std::vector<LobeSurface>>(*model.surfaces);
  for (LobeSurface& surface : *surfaces) {
    if (side(surface.lobe) != collapse.side) continue;
    auto mesh = std::make_shared<TriangleMesh>(*surface.mesh);
    for (Vec3& p : mesh->points) p = shrunk(p);
    surface.mesh = std::move(mesh);
  }
  result.surfaces = std::move(surfaces);
  const auto tree = treeOf(model);
  if (!tree) return result;
  auto moved = std::make_shared<AirwayTree>();
  for (Branch branch : *tree) {
    if (side(branch.lobe) == collapse.side) {
      branch.proximal = shrunk(branch.proximal);
      branch.distal = shrunk(branch.distal);
      for (CentrelinePoint& point : branch.via) point.position = shrunk(point.position);
    }
    if (branch.parent >= 0 &&
        side((*moved)[static_cast<std::size_t>(branch.parent)].lobe) != collapse.side) {
      branch.proximal = (*moved)[static_cast<std::size_t>(branch.parent)].distal;
    }
    moved->add(std::move(branch));
  }
  result.growth = nullptr;
  result.central = nullptr;
  result.opened = std::move(moved);
  return result;
}

TriangleMesh beforeCollapse(TriangleMesh surface, const Collapse& collapse) {
  for (Vec3& p : surface.points) p = collapse.hilum + (p - collapse.hilum) / collapse.size();
  return surface;
}

std::string warningOf(const Collapse& collapse) {
  return "The lung with the pneumothorax was shrunk about its hilum to " +
         std::to_string(std::lround(100.0 * collapse.share)) +
         " % of its volume: a drawing of the disease, not a measurement. The chest wall around it "
         "is where the lung's surface was.";
}

}  // namespace pneuma
