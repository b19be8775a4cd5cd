#include "document/held_bytes.h"

#include <memory>
#include <set>

#include "document/breath.h"
#include "pipeline/lung_corrections.h"

namespace pneuma {

namespace {

template <class T>
std::size_t bytesOf(const std::vector<T>& list) {
  return list.capacity() * sizeof(T);
}

std::size_t bytesOf(const TriangleMesh& mesh) {
  return bytesOf(mesh.points) + bytesOf(mesh.triangles);
}

std::size_t bytesOf(const AirwayTree& tree) {
  std::size_t bytes = 0;
  for (const Branch& branch : tree) bytes += sizeof(Branch) + bytesOf(branch.via);
  return bytes;
}

/// Adds up parts that were not met before.
class Parts {
 public:
  std::size_t bytes() const { return bytes_; }

  void add(const Snapshot& snapshot) {
    const LungModel& model = snapshot.model;
    once(model.ct, [](const CtImage& ct) { return bytesOf(ct.voxels); });
    once(model.labels, [](const LabelImage& labels) { return bytesOf(labels.voxels); });
    once(snapshot.lungLabels, [](const LabelImage& labels) { return bytesOf(labels.voxels); });
    once(model.lungs, [this](const LungSegmentation& lungs) { return found(lungs); });
    once(model.corrections, [this](const LungCorrections& corrections) {
      once(corrections.found, [this](const LungSegmentation& lungs) { return found(lungs); });
      once(corrections.read, [](const LabelImage& labels) { return bytesOf(labels.voxels); });
      std::size_t bytes = bytesOf(corrections.edits);
      for (const LungEdit& edit : corrections.edits) bytes += bytesOf(edit.points);
      return bytes;
    });
    surfaces(model.surfaces);
    surfaces(model.wholeLungs);
    surfaces(snapshot.grownIn);
    once(model.lobes, [](const LobesOfLungs& lobes) {
      std::size_t bytes = 0;
      for (const SplitLung& lung : lobes.lungs) {
        bytes += bytesOf(lung.complex.points) + bytesOf(lung.complex.facets);
      }
      return bytes;
    });
    once(model.central, [](const AirwayTree& tree) { return bytesOf(tree); });
    once(model.opened, [](const AirwayTree& tree) { return bytesOf(tree); });
    once(model.growth, [](const Growth& growth) {
      return bytesOf(growth.result.tree) + bytesOf(growth.result.aggregate);
    });
    once(snapshot.figures, [](const TreeFigures& figures) {
      return bytesOf(figures.generation) + bytesOf(figures.horsfieldOrder) +
             bytesOf(figures.strahlerOrder) + bytesOf(figures.flowFraction) +
             bytesOf(figures.pathMm);
    });
    for (const auto& lung : snapshot.lungs) {
      once(lung, [](const LungShape& shape) { return bytesOf(shape.inside); });
    }
    once(snapshot.traces, [this](const FissureTraces& traces) {
      for (const auto& [fissure, traced] : traces.fissures) mesh(traced.patch);
      return std::size_t{0};
    });
    once(snapshot.breath, [this](const Breath& breath) { return moving(breath); });
  }

 private:
  std::size_t found(const LungSegmentation& lungs) {
    const bool counted = !met_.insert(&lungs.labels).second;
    return counted ? bytesOf(lungs.central) : bytesOf(lungs.labels.voxels) + bytesOf(lungs.central);
  }

  template <class T, class Size>
  void once(const std::shared_ptr<const T>& part, const Size& size) {
    if (part && met_.insert(part.get()).second) bytes_ += size(*part);
  }

  void mesh(const std::shared_ptr<const TriangleMesh>& part) {
    once(part, [](const TriangleMesh& one) { return bytesOf(one); });
  }

  void surfaces(const std::shared_ptr<const std::vector<LobeSurface>>& list) {
    once(list, [this](const std::vector<LobeSurface>& all) {
      for (const LobeSurface& surface : all) mesh(surface.mesh);
      return std::size_t{0};
    });
  }

  std::size_t moving(const Breath& breath) {
    std::size_t bytes = 0;
    for (const MovingSurface& surface : breath.lungs.surfaces) {
      mesh(surface.surface.mesh);
      bytes += bytesOf(surface.displacement) + bytesOf(surface.volumeChange);
    }
    once(breath.lungs.tree, [](const AirwayTree& tree) { return bytesOf(tree); });
    for (const auto& scene : breath.scenes) {
      once(scene, [this](const BreathingScene& shown) {
        std::size_t ofScene = 0;
        for (const auto& surface : shown.surfaces) {
          mesh(surface.coarse);
          ofScene += bytesOf(surface.displacement) + bytesOf(surface.values) +
                     bytesOf(surface.coarseDisplacement) + bytesOf(surface.coarseValues);
        }
        for (const auto& shell : shown.shells) {
          mesh(shell.mesh);
          ofScene += bytesOf(shell.displacement);
        }
        return ofScene;
      });
    }
    return bytes;
  }

  std::set<const void*> met_;
  std::size_t bytes_ = 0;
};

}  // namespace

std::size_t heldBytes(const Snapshot& shown, std::span<const Snapshot* const> others) {
  Parts parts;
  parts.add(shown);
  const std::size_t before = parts.bytes();
  for (const Snapshot* other : others) parts.add(*other);
  return parts.bytes() - before;
}

std::size_t keptWithin(std::size_t bytes, const Snapshot& shown,
                       std::span<const Snapshot* const> others) {
  Parts parts;
  parts.add(shown);
  const std::size_t before = parts.bytes();
  for (std::size_t i = 0; i < others.size(); ++i) {
    parts.add(*others[i]);
    if (i > 0 && parts.bytes() - before > bytes) return i;
  }
  return others.size();
}

}  // namespace pneuma
