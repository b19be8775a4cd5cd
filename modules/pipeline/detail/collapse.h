#pragma once

#include <string>

#include "pipeline/lung_model.h"

namespace pneuma {

/// A lung that shrinks about its hilum: a drawing of a pneumothorax.
struct Collapse {
  Side side = Side::None;
  Vec3 hilum = Vec3::Zero();
  double share = 1.0;  ///< of its volume that the lung keeps

  double size() const;
};

/// @param share of its volume that the lung keeps
/// @throws InvalidInput if the model has no such lung
Collapse collapseOf(const LungModel& model, Side side, double share);

/// The model with that lung shrunk, its lobes and airways with it.
LungModel collapsed(const LungModel& model, const Collapse& collapse);

/// A surface of the shrunk lung as it was before.
TriangleMesh beforeCollapse(TriangleMesh surface, const Collapse& collapse);

/// One sentence on what was done to the lung.
std::string warningOf(const Collapse& collapse);

}  // namespace pneuma
