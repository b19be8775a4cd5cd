#include "core/joint_progress.h"

namespace pneuma {

JointProgress::JointProgress(const Progress& whole, std::size_t tasks) : whole_(whole) {
  for (std::size_t i = 0; i < tasks; ++i) tasks_.emplace_back(*this);
}

void JointProgress::Task::report(double fraction, std::string_view what) {
  const std::lock_guard lock(joint_.mutex_);
  if (fraction <= fraction_) return;
  joint_.sum_ += fraction - fraction_;
  fraction_ = fraction;
  joint_.whole_.part(0.0, 1.0, what)
      .report(joint_.sum_ / static_cast<double>(joint_.tasks_.size()));
}

}  // namespace pneuma
