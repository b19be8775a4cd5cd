#include "growth/point_splitter.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "growth/quantised_points.h"

namespace pneuma {
namespace {

/// A branch whose points are still to be split.
struct Task {
  int branch = -1;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  QuantisedSum sum;
  Vec3 at;
  Vec3 direction;
  Vec3 parentDirection;
};

class Splitter {
 public:
  Splitter(std::span<const Vec3> points, const Domain& domain, const SplitRules& rules,
           const Progress& progress)
      : domain_(domain),
        rules_(rules),
        progress_(progress),
        cosMin_(std::cos(rules.minAngleRad)),
        sinMin_(std::sin(rules.minAngleRad)),
        cosMax_(std::cos(rules.maxAngleRad)),
        sinMax_(std::sin(rules.maxAngleRad)) {
    quantise(points);
    result_.branches.reserve(points.size() / 2 + 8);
  }

  SplitTree grow(const SplitInlet& inlet) {
    push({-1, 0, static_cast<std::uint32_t>(points_.size()), sumOf(points_.data(), points_.size()),
          inlet.end, inlet.direction, inlet.parentDirection});
    std::size_t done = 0;
    while (!tasks_.empty()) {
      if (++done % 4096 == 0) progress_.throwIfStopped();
      const Task task = tasks_.back();
      tasks_.pop_back();
      split(task);
    }
    return std::move(result_);
  }

 private:
  void quantise(std::span<const Vec3> points) {
    Box3 box;
    for (const Vec3& p : points) box.extend(p);
    if (points.empty()) return;
    middle_ = box.center();
    // The finest binary fraction of the spacing, down to 1/64, that lets the box fit 16 bits.
    quantum_ = rules_.spacingMm / 64.0;
    while (box.sizes().maxCoeff() / quantum_ > 65000.0 && quantum_ < rules_.spacingMm) {
      quantum_ *= 2.0;
    }
    if (box.sizes().maxCoeff() / quantum_ > 65000.0) {
      throw InvalidInput(
          "the points of one inlet spread over more than 65,000 spacings; choose a "
          "larger spacing or check the units of the surface");
    }
    points_.resize(points.size());
    scratch_.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 q = (points[i] - middle_) * (1.0 / quantum_);
      points_[i] = {rounded(q.x()), rounded(q.y()), rounded(q.z()), 0};
    }
  }

  /// To the nearest integer; a cast is several times faster than std::lround.
  static std::int16_t rounded(double v) {
    return static_cast<std::int16_t>(static_cast<std::int32_t>(v + 32768.5) - 32768);
  }

  Vec3 mean(const QuantisedSum& sum, std::uint32_t count) const {
    return middle_ + (quantum_ / count) * Vec3(static_cast<double>(sum.x),
                                               static_cast<double>(sum.y),
                                               static_cast<double>(sum.z));
  }

  /// Normal of the splitting plane: across the plane of the branch and its parent, or, where those
  /// are in line, the direction in which the points spread most.
  Vec3 splittingNormal(const Task& task, const Vec3& centroid) const {
    const Vec3 across = task.direction.cross(task.parentDirection);
    const double length = across.norm();
    if (length > 1e-6) return across * (1.0 / length);
    const Vec3 u = anyPerpendicular(task.direction);
    const Vec3 w = task.direction.cross(u);
    double uu = 0.0;
    double uw = 0.0;
    double ww = 0.0;
    for (std::uint32_t i = task.begin; i < task.end; ++i) {
      const Vec3 q = middle_ + quantum_ * Vec3(points_[i].x, points_[i].y, points_[i].z) - centroid;
      const double a = q.dot(u);
      const double b = q.dot(w);
      uu += a * a;
      uw += a * b;
      ww += b * b;
    }
    const double angle = 0.5 * std::atan2(2.0 * uw, uu - ww);
    return std::cos(angle) * u + std::sin(angle) * w;
  }

  void split(const Task& task) {
    const std::uint32_t count = task.end - task.begin;
    const Vec3 centroid = mean(task.sum, count);
    const Vec3 normal = splittingNormal(task, centroid);
    const QuantisedPlane plane(normal, (centroid - middle_) * (1.0 / quantum_));
    QuantisedPoint* const points = points_.data() + task.begin;
    const auto inFront =
        static_cast<std::uint32_t>(partition(points, count, plane, scratch_.data()));
    const QuantisedSum front = sumOf(points, inFront);
    const std::uint32_t middle = task.begin + inFront;
    addDaughter(task, task.begin, middle, front, -normal);
    addDaughter(task, middle, task.end, task.sum - front, normal);
  }

  /// Keeps a branch for splitting, unless it is a terminal.
  void push(const Task& task) {
    if (task.end - task.begin <= static_cast<std::uint32_t>(rules_.minPoints)) {
      serve(task.branch, task.end - task.begin);
    } else {
      tasks_.push_back(task);
    }
  }

  void serve(int branch, std::uint32_t points) {
    if (branch < 0) {
      result_.inletPoints += points;
    } else {
      result_.branches[static_cast<std::size_t>(branch)].points += points;
    }
  }

  /// @param away unit normal of the splitting plane towards these points
  void addDaughter(const Task& mother, std::uint32_t begin, std::uint32_t end,
                   const QuantisedSum& sum, const Vec3& away) {
    if (begin == end) return;
    const std::uint32_t count = end - begin;
    Vec3 way = rules_.ratio * (mean(sum, count) - mother.at);
    const double length = way.norm();
    if (length < rules_.minLengthMm || length <= 0.0) {
      drop(mother, count);
      return;
    }
    way = withinAngles(mother.direction, way, length, away);
    if (rules_.containment != Containment::None && !keepInside(mother, way)) {
      drop(mother, count);
      return;
    }
    const int branch = static_cast<int>(result_.branches.size());
    result_.branches.push_back({mother.branch, mother.at + way, 0});
    push({branch, begin, end, sum, mother.at + way, way.normalized(), mother.direction});
  }

  void drop(const Task& mother, std::uint32_t points) {
    ++result_.counts.dropped;
    result_.counts.droppedPoints += points;
    serve(mother.branch, points);
  }

  /// `way` turned in its plane with the mother's direction until the angle is within the limits.
  Vec3 withinAngles(const Vec3& direction, const Vec3& way, double length, const Vec3& away) const {
    const double along = way.dot(direction);
    const bool tooSmall = along > cosMin_ * length;
    if (!tooSmall && along >= cosMax_ * length) return way;
    Vec3 sideways = way - along * direction;
    const double size = sideways.norm();
    sideways = size > 1e-9 * length ? Vec3(sideways * (1.0 / size)) : away;
    return tooSmall ? Vec3(length * (cosMin_ * direction + sinMin_ * sideways))
                    : Vec3(length * (cosMax_ * direction + sinMax_ * sideways));
  }

  bool allowed(const Vec3& from, const Vec3& to) const {
    return rules_.containment == Containment::Ends ? domain_.contains(to)
                                                   : domain_.containsSegment(from, to);
  }

  /// Rule 7: shortens `way`, or leads it to a lattice point inside. False if there is no way.
  bool keepInside(const Task& mother, Vec3& way) {
    const Vec3& from = mother.at;
    if (allowed(from, from + way)) return true;
    const double length = way.norm();
    for (const double share : {0.75, 0.5, 0.35}) {
      if (share * length < rules_.minLengthMm) break;
      if (allowed(from, from + share * way)) {
        way *= share;
        ++result_.counts.shortened;
        return true;
      }
    }
    return leadToNode(mother, way);
  }

  /// Leads `way` to the lattice node nearest to its end that is inside, far enough and reachable.
  bool leadToNode(const Task& mother, Vec3& way) {
    const Vec3& from = mother.at;
    const Vec3 target = from + way;
    const double h = rules_.spacingMm;
    const Vec3 nearest = ((target - rules_.anchor) / h).array().round();
    double bestSquared = 0.0;
    Vec3 best = Vec3::Zero();
    bool found = false;
    int tries = 0;
    const auto look = [&](int i, int j, int k) {
      const Vec3 node = rules_.anchor + h * (nearest + Vec3(i, j, k));
      const double squared = (node - target).squaredNorm();
      if (found && squared >= bestSquared) return;
      const double length = (node - from).norm();
      const bool backwards = (node - from).dot(mother.direction) < MostBackwards * length;
      if (length < rules_.minLengthMm || backwards || !domain_.contains(node)) return;
      ++tries;
      if (!allowed(from, node)) return;
      found = true;
      bestSquared = squared;
      best = node;
    };
    // Cubic shells; the nearest node may lie one or two shells further out than the first found.
    for (int shell = 0; shell <= MostShells && tries < MostTries; ++shell) {
      if (found && (shell - 0.5) * h * (shell - 0.5) * h > bestSquared) break;
      for (int k = -shell; k <= shell; ++k)
        for (int j = -shell; j <= shell; ++j) {
          const bool face = std::abs(k) == shell || std::abs(j) == shell;
          for (int i = -shell; i <= shell; i += face || shell == 0 ? 1 : 2 * shell) look(i, j, k);
        }
    }
    if (!found) return false;
    way = best - from;
    ++result_.counts.redirected;
    return true;
  }

  // A branch that finds no way among this many nodes is better not made.
  static constexpr int MostShells = 16;
  static constexpr double MostBackwards = -0.5;  // cosine of 120 degrees: not back along the mother
  static constexpr int MostTries = 100;

  const Domain& domain_;
  const SplitRules& rules_;
  const Progress& progress_;
  double cosMin_;
  double sinMin_;
  double cosMax_;
  double sinMax_;
  Vec3 middle_ = Vec3::Zero();
  double quantum_ = 1.0;
  std::vector<QuantisedPoint> points_;
  std::vector<QuantisedPoint> scratch_;
  std::vector<Task> tasks_;
  SplitTree result_;
};

}  // namespace

SplitTree splitPoints(const SplitInlet& inlet, std::span<const Vec3> points, const Domain& domain,
                      const SplitRules& rules, const Progress& progress) {
  return Splitter(points, domain, rules, progress).grow(inlet);
}

}  // namespace pneuma
