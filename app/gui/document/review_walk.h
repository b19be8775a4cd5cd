#pragma once

#include <QObject>
#include <optional>
#include <vector>

#include "document/fissure_editor.h"
#include "document/slice_views.h"

namespace pneuma {

/// Leads through places of each fissure, one after the other, until somebody has said of all that
/// they look right. An edit brings those back that it moved. Needs no display.
class ReviewWalk : public QObject {
  Q_OBJECT

 public:
  ReviewWalk(Document& document, FissureEditor& editor, SliceViews& slices,
             QObject* parent = nullptr);

  /// True if there are fissures and slices to look at.
  bool available() const { return editor_.available() && !slices_.empty(); }

  bool active() const { return at_.has_value(); }

  /// Of the station that is looked at. @pre active()
  Fissure fissure() const { return fissure_; }

  std::size_t station() const { return *at_; }

  std::size_t stations() const { return stations_.size(); }

  /// How many of them look right.
  std::size_t passed() const;

  /// True if every fissure was looked at or accepted as it is now.
  bool complete() const;

  /// Goes on with the fissure that is edited, or the first that nobody has looked at.
  void start();

  /// The station looks right: to the next one.
  void looksRight();

  /// Leaves the walk to edit the fissure here; start() comes back.
  void editHere();

  void stop();

  /// Accepts all fissures as they are without looking.
  void accept();

 signals:
  void changed();

 private:
  struct Station {
    Vec3 place = Vec3::Zero();
    bool passed = false;
  };

  void begin(Fissure fissure);
  /// Lays the stations upon the fissure as it is now; those that moved have to be seen again.
  void refresh();
  /// To the first station that has to be seen; false if there is none.
  bool goOn();
  std::optional<Fissure> nextFissure() const;

  Document& document_;
  FissureEditor& editor_;
  SliceViews& slices_;
  Fissure fissure_ = Fissure::LeftOblique;
  std::vector<Station> stations_;
  std::optional<std::size_t> at_;
  std::vector<std::shared_ptr<const LungShape>> lungs_;  ///< that the stations lie in
};

}  // namespace pneuma
