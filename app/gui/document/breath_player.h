#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>
#include <memory>

#include "document/breath.h"

namespace pneuma {

/// Where in its breath the lung that is shown stands, and the clock that moves it on. Needs no
/// display.
class BreathPlayer : public QObject {
  Q_OBJECT

 public:
  explicit BreathPlayer(QObject* parent = nullptr);

  /// Null for none: it stops. Another breath is played on from the same share of the period.
  void setBreath(std::shared_ptr<const Breath> breath);

  const std::shared_ptr<const Breath>& breath() const { return breath_; }

  bool playing() const { return timer_.isActive(); }

  void setPlaying(bool playing);

  /// Share of the period, [0, 1).
  double phase() const { return phase_; }

  /// Goes to a share of the period; whole numbers are taken off.
  void setPhase(double phase);

  /// By so many of the frames that a file would have.
  void step(int frames);

  /// As many times as fast as the lungs breathe.
  double speed() const { return speed_; }

  void setSpeed(double speed);

  BreathColour colour() const { return colour_; }

  void setColour(BreathColour colour);

  /// True if the ends of expiration and inspiration are shown, too.
  bool onionSkin() const { return onionSkin_; }

  void setOnionSkin(bool on);

 signals:
  /// It stands elsewhere.
  void moved();

  /// Another breath, another colour, onion skin or not, playing or not, another speed.
  void changed();

 private:
  void tick();

  std::shared_ptr<const Breath> breath_;
  BreathColour colour_ = BreathColour::Lobe;
  bool onionSkin_ = false;
  double phase_ = 0.0;
  double speed_ = 1.0;
  QElapsedTimer sinceTick_;
  QTimer timer_;
};

}  // namespace pneuma
