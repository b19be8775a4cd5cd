#pragma once

#include <array>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include <vtkActor.h>
#include <vtkNew.h>

#include "anatomy/airway_tree.h"
#include "render/branch_colours.h"
#include "render/breathing_scene.h"
#include "render/scene.h"
#include "render/tube_mesh.h"

class vtkRenderer;

namespace pneuma {

/// The airways of a scene: tubes, lines for dragging, and the selected branch.
class AirwayLayer {
 public:
  explicit AirwayLayer(vtkRenderer* renderer);

  /// Null for no tree.
  void setTree(std::shared_ptr<const AirwayTree> tree, const SceneOptions& options);

  /// Trees whose values the colours of this one must stand beside. None of them may be null.
  void setPeers(std::vector<std::shared_ptr<const AirwayTree>> peers);

  /// Rebuilds colours and tubes as far as the options ask for it.
  void setOptions(const SceneOptions& options);

  void setInteractive(bool interactive);

  /// While a preview shows what grows, the branches that were grown before give way to it.
  void setPreviewing(bool previewing);

  void select(std::optional<std::size_t> branch);

  /// Lets the airways move with the lungs, or stand (null). Kept, not copied.
  void setBreathing(std::shared_ptr<const BreathingScene> breathing);

  void setBreath(const BreathScale& scale);

  /// The tree where it stands at the moment; null without one.
  std::shared_ptr<const AirwayTree> movedTree() const;

  const AirwayTree* tree() const { return tree_.get(); }

  std::span<const std::shared_ptr<const AirwayTree>> peers() const { return peers_; }

  /// One entry per branch.
  const std::vector<bool>& visible() const { return previewing_ ? given_ : visible_; }

  /// The lobes of the visible branches, the peers' too.
  const std::set<Lobe>& lobes() const { return lobes_; }

  const Legend& legend() const { return colours_.legend; }

 private:
  void show(vtkActor* actor, const TubeMesh& mesh);
  void show(vtkActor* actor, const LineMesh& mesh);
  std::array<vtkActor*, 5> actors() const;
  /// Where it stands at the moment.
  Branch movedBranchOf(std::size_t n) const;
  void rebuild();
  void buildFine();
  void buildCoarse();
  void buildGiven();
  void buildSelection();
  void showActors();

  std::shared_ptr<const AirwayTree> tree_;
  std::vector<std::shared_ptr<const AirwayTree>> peers_;
  SceneOptions options_;
  std::vector<bool> visible_;
  std::vector<bool> given_;  ///< those of the visible that were not grown, while previewing
  std::set<Lobe> lobes_;
  BranchColours colours_;
  std::optional<std::size_t> selected_;
  bool interactive_ = false;
  bool fineBuilt_ = false;
  bool coarseBuilt_ = false;
  bool previewing_ = false;
  std::shared_ptr<const BreathingScene> breathing_;
  BreathScale scale_;
  vtkNew<vtkActor> tubes_;
  vtkNew<vtkActor> coarseTubes_;
  vtkNew<vtkActor> coarseLines_;
  vtkNew<vtkActor> givenTubes_;
  vtkNew<vtkActor> selection_;
};

}  // namespace pneuma
