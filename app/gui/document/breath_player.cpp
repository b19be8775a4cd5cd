#include "document/breath_player.h"

#include <cmath>
#include <utility>

namespace pneuma {

namespace {

constexpr int TickMs = 15;  // 66.7 steps a second, as in the papers; what is slower skips some

}  // namespace

BreathPlayer::BreathPlayer(QObject* parent) : QObject(parent) {
  timer_.setInterval(TickMs);
  connect(&timer_, &QTimer::timeout, this, &BreathPlayer::tick);
}

void BreathPlayer::setBreath(std::shared_ptr<const Breath> breath) {
  if (breath == breath_) return;
  breath_ = std::move(breath);
  if (!breath_) timer_.stop();
  emit changed();
  emit moved();
}

void BreathPlayer::setPlaying(bool playing) {
  if (playing == timer_.isActive() || (playing && !breath_)) return;
  if (playing) {
    sinceTick_.start();
    timer_.start();
  } else {
    timer_.stop();
  }
  emit changed();
}

void BreathPlayer::setPhase(double phase) {
  phase -= std::floor(phase);
  if (phase == phase_) return;
  phase_ = phase;
  emit moved();
}

void BreathPlayer::step(int frames) {
  if (!breath_) return;
  setPlaying(false);
  const auto count = static_cast<double>(breath_->lungs.frames.size());
  setPhase(std::round(phase_ * count + frames) / count);
}

void BreathPlayer::setSpeed(double speed) {
  if (speed == speed_) return;
  speed_ = speed;
  emit changed();
}

void BreathPlayer::setColour(BreathColour colour) {
  if (colour == colour_) return;
  colour_ = colour;
  emit changed();
}

void BreathPlayer::setOnionSkin(bool on) {
  if (on == onionSkin_) return;
  onionSkin_ = on;
  emit changed();
}

void BreathPlayer::tick() {
  const double seconds = static_cast<double>(sinceTick_.restart()) / 1000.0;
  setPhase(phase_ + speed_ * seconds / breath_->lungs.drive.period);
}

}  // namespace pneuma
