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

  void setMethod(Fissure fissure, FissureMethod method);
  void addPoint(const Vec3& point);
  void removePoint(Fissure fissure, std::size_t index);
  void removeLast();
  void clear();
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
    QString problem;
  };

  void follow();
  void begin();
  void update(const LobeEdits& edits);
  void workOut(Fissure fissure, LobePreview& preview, const LobeEdits& edits);
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
