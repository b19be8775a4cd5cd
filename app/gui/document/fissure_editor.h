#pragma once

#include <QObject>
#include <QString>
#include <map>
#include <optional>
#include <vector>

#include "document/document.h"
#include "pipeline/lobe_preview.h"

namespace pneuma {

/// The fissures while they are edited: which of them, what a drag that is not over would make of
/// them, and the lobes that they give, at once. The document gets every edit when it is done.
/// Needs no display.
class FissureEditor : public QObject {
  Q_OBJECT

 public:
  /// A point that was set, or a handle of a plane.
  struct Mark {
    Fissure fissure = Fissure::LeftOblique;
    std::size_t index = 0;
    Vec3 place = Vec3::Zero();
  };

  explicit FissureEditor(Document& document, QObject* parent = nullptr);

  /// True if there are whole lungs.
  bool available() const { return !previews_.empty(); }

  /// Those of the lungs that there are.
  std::vector<Fissure> fissures() const;

  Fissure current() const { return current_; }

  void setCurrent(Fissure fissure);

  /// The next fissure, or the one before for -1.
  void step(int by);

  /// True if clicks set points.
  bool placing() const { return placing_; }

  void setPlacing(bool placing);

  /// With a drag that is not over.
  const LobeEdits& edits() const { return draft_; }

  const FissureEdit& edit(Fissure fissure) const;

  /// @pre the fissure is one of fissures()
  const UsedFissure& used(Fissure fissure) const { return used_.at(fissure).fissure; }

  /// Points of a fissure where they lie: drawn onto what shows in the CT while that is wanted.
  std::vector<Vec3> points(Fissure fissure) const;

  /// How the fissure lies in the CT; null while it moves, and where nothing was looked for.
  const TracedFissure* traced(Fissure fissure) const;

  /// Where it shows; null where traced() does not know.
  std::shared_ptr<const ShownParts> shownParts(Fissure fissure) const;

  /// True if the surface of a file would reach the lung's wall if it were extended.
  bool canExtend(Fissure fissure) const;

  /// Why what was set gives no fissure; empty if it does.
  QString problem(Fissure fissure) const;

  /// One for each lung.
  const std::vector<LobePreview>& previews() const { return previews_; }

  const LobePreview* preview(Side side) const;

  /// Exact where the lungs are split so, else as near as the preview tells.
  std::map<Lobe, double> volumesMm3() const;

  /// True if the lobes are split as they are shown.
  bool exact() const;

  /// All of them, those of the current fissure last.
  std::vector<Mark> marks() const;

  /// The nearest mark that a slice shows at a point, if one is so near.
  /// @param normal the axis across the slice
  std::optional<Mark> markAt(const Vec3& point, int normal, double reachMm) const;

  /// @pre for a surface one was read
  void setMethod(Fissure fissure, FissureMethod method);
  void addPoint(const Vec3& point);
  void removePoint(Fissure fissure, std::size_t index);
  void removeLast();
  void clear();
  /// How much a point counts beside the others. @param weight positive
  void setWeight(Fissure fissure, std::size_t index, double weight);
  /// @pre the fissure is a plane
  void setAngles(Fissure fissure, const PlaneAngles& angles);
  /// Lets surfaces of files go on to the lung's wall, as far as may be.
  void extendSurfaces();
  /// Wanted volumes; snapping ends, which would undo them.
  void setShares(const std::map<Side, LobeShares>& shares);

  /// Shows a mark elsewhere, or another smoothness, until release() makes it an edit.
  void drag(const Mark& mark, const Vec3& to);
  void dragSmoothness(double smoothness);
  void release();

  /// A slice shows marks that are so near to it.
  static constexpr double SliceReachMm = 2.0;

 signals:
  /// Anything that the functions above tell.
  void changed();

 private:
  struct Used {
    UsedFissure fissure;
    std::vector<Vec3> points;  ///< where they lie
    QString problem;
    bool canExtend = false;
    std::shared_ptr<const FissureTraces> from;  ///< null: worked out here, while things move
  };

  void follow();
  void begin();
  void update(const LobeEdits& edits);
  /// The fissure as the document found that it lies.
  void adopt(Fissure fissure, LobePreview& preview,
             const std::shared_ptr<const FissureTraces>& traces);
  /// The fissure as near as it can be told at once.
  void workOut(Fissure fissure, LobePreview& preview, const LobeEdits& edits);
  /// True if the fissure has to be worked out anew.
  bool isOther(Fissure fissure, const LobeEdits& before, const LobeEdits& now) const;
  bool wouldReach(Fissure fissure, const LobePreview& preview, LobeEdits edits) const;
  UsedFissure surfaceOf(Fissure fissure, const LobePreview& preview, const LobeOptions& options,
                        GivenFissures& given) const;
  void moveToShares(LobePreview& preview, const LobeEdits& edits);
  void commit(const LobeEdits& edits, const QString& what);
  std::array<Vec3, 3> firstHandles(Fissure fissure) const;

  Document& document_;
  std::vector<std::shared_ptr<const LungShape>> lungs_;
  std::vector<LobePreview> previews_;
  LobeEdits draft_;
  QString dragged_;  ///< what the drag does; empty while there is none
  std::map<Fissure, Used> used_;
  Fissure current_ = Fissure::LeftOblique;
  bool placing_ = false;
};

}  // namespace pneuma
