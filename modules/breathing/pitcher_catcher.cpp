#include "breathing/pitcher_catcher.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"

namespace pneuma {
namespace {

constexpr std::size_t StepsBetweenReports = 1U << 16U;

/// The network with all of its nodes, and what each of them holds.
class Nodes {
 public:
  Nodes(const SpringNetwork& network, std::span<const double> force)
      : masses_(network.masses()), first_(masses_ + network.springs() + 1, 0) {
    const std::vector<SpringNetwork::Spring> springs = network.springNodes();
    for (const SpringNetwork::Spring& spring : springs) {
      for (const std::uint32_t mass : spring.mass) ++first_[mass + 1];
    }
    for (std::size_t s = 0; s < springs.size(); ++s) first_[masses_ + s + 1] = 2;
    for (std::size_t n = 0; n + 1 < first_.size(); ++n) first_[n + 1] += first_[n];
    links_.resize(first_.back());
    kept_.resize(first_.size() - 1);
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t s = 0; s < springs.size(); ++s) {
      const auto node = static_cast<std::uint32_t>(masses_ + s);
      const double ofSpring = network.expandability(springs[s]);
      kept_[node] = ofSpring;
      for (std::size_t end = 0; end < 2; ++end) {
        const std::uint32_t mass = springs[s].mass[end];
        const double distance = springs[s].distance[end];
        links_[next[mass]++] = {node, ofSpring / distance};
        links_[next[node]++] = {mass, network.expandability(mass) / distance};
      }
    }
    for (std::size_t mass = 0; mass < masses_; ++mass) kept_[mass] = network.expandability(mass);
    for (std::size_t n = 0; n < size(); ++n) {  // (8)
      double all = kept_[n];
      for (std::size_t at = first_[n]; at < first_[n + 1]; ++at) all += links_[at].share;
      for (std::size_t at = first_[n]; at < first_[n + 1]; ++at) links_[at].share /= all;
      kept_[n] /= all;
    }
    held.pitcher.assign(force.begin(), force.end());
    held.pitcher.resize(size(), 0.0);
    held.catcher.assign(size(), 0.0);
  }

  std::size_t size() const { return kept_.size(); }

  std::size_t masses() const { return masses_; }

  /// (12) to (14) for one node; calls raised(i) for every neighbour.
  template <class Raised>
  void pitch(std::size_t node, const Raised& raised) {
    const double pitched = held.pitcher[node];
    held.catcher[node] += pitched * kept_[node];
    held.pitcher[node] = 0.0;
    for (std::size_t at = first_[node]; at < first_[node + 1]; ++at) {
      held.pitcher[links_[at].node] += pitched * links_[at].share;
      raised(links_[at].node);
    }
    ++held.steps;
  }

  PitchedForces held;

 private:
  struct Link {
    std::uint32_t node;
    double share;  // T_e
  };

  std::size_t masses_;
  std::vector<std::size_t> first_;  // of each node's links
  std::vector<Link> links_;
  std::vector<double> kept_;  // T_e of a node to itself
};

/// Nodes with the largest pitcher on top; knows where each of them stands.
class PitcherHeap {
 public:
  explicit PitcherHeap(const std::vector<double>& pitcher)
      : pitcher_(pitcher), heap_(pitcher.size()), place_(pitcher.size()) {
    for (std::size_t n = 0; n < heap_.size(); ++n) {
      heap_[n] = static_cast<std::uint32_t>(n);
      place_[n] = n;
    }
    for (std::size_t n = heap_.size() / 2; n-- > 0;) sink(n);
  }

  std::uint32_t top() const { return heap_.front(); }

  /// Puts a node right whose pitcher has changed.
  void changed(std::uint32_t node) {
    std::size_t at = place_[node];
    while (at > 0 && height(at) > height((at - 1) / 2)) {
      exchange(at, (at - 1) / 2);
      at = (at - 1) / 2;
    }
    sink(at);
  }

 private:
  double height(std::size_t at) const { return std::abs(pitcher_[heap_[at]]); }

  void exchange(std::size_t a, std::size_t b) {
    std::swap(heap_[a], heap_[b]);
    place_[heap_[a]] = a;
    place_[heap_[b]] = b;
  }

  void sink(std::size_t at) {
    for (;;) {
      const std::size_t left = 2 * at + 1;
      if (left >= heap_.size()) return;
      const std::size_t right = left + 1;
      const std::size_t higher =
          right < heap_.size() && height(right) > height(left) ? right : left;
      if (height(higher) <= height(at)) return;
      exchange(at, higher);
      at = higher;
    }
  }

  const std::vector<double>& pitcher_;
  std::vector<std::uint32_t> heap_;
  std::vector<std::size_t> place_;
};

/// Says how far it is by how many powers of ten the largest pitcher has come down.
class Descent {
 public:
  Descent(double highest, double enough, const Progress& progress)
      : highest_(highest), enough_(enough), progress_(progress) {}

  void report(double now) const {
    const double whole = std::log(highest_ / enough_);
    progress_.report(whole > 0.0 && now > 0.0 ? std::log(highest_ / now) / whole : 1.0);
  }

 private:
  double highest_;
  double enough_;
  const Progress& progress_;
};

void pitchByHeap(Nodes& nodes, double enough, const Descent& descent) {
  PitcherHeap heap(nodes.held.pitcher);
  while (std::abs(nodes.held.pitcher[heap.top()]) > enough) {
    const std::uint32_t node = heap.top();
    if (nodes.held.steps % StepsBetweenReports == 0) {
      descent.report(std::abs(nodes.held.pitcher[node]));
    }
    nodes.pitch(node, [&](std::uint32_t raised) { heap.changed(raised); });
    heap.changed(node);
  }
}

void pitchByBuckets(Nodes& nodes, double enough, const Descent& descent) {
  // By power of 2 above `enough`; what has pitched or risen since it was put there is passed over.
  std::vector<std::vector<std::uint32_t>> buckets;
  const auto bucketOf = [&](std::size_t node) {
    const double held = std::abs(nodes.held.pitcher[node]);
    return held > enough ? static_cast<std::size_t>(std::ilogb(held / enough)) + 1 : std::size_t{0};
  };
  std::vector<std::size_t> standsIn(nodes.size(), 0);  // 0: in none
  const auto put = [&](std::uint32_t node) {
    const std::size_t bucket = bucketOf(node);
    if (bucket == 0 || bucket <= standsIn[node]) return;
    if (bucket >= buckets.size()) buckets.resize(bucket + 1);
    buckets[bucket].push_back(node);
    standsIn[node] = bucket;
  };
  for (std::uint32_t node = 0; node < nodes.size(); ++node) put(node);
  while (!buckets.empty()) {
    if (buckets.back().empty()) {
      buckets.pop_back();
      continue;
    }
    const std::size_t bucket = buckets.size() - 1;
    const std::uint32_t node = buckets.back().back();
    buckets.back().pop_back();
    if (standsIn[node] != bucket) continue;
    standsIn[node] = 0;
    if (nodes.held.steps % StepsBetweenReports == 0) {
      descent.report(std::abs(nodes.held.pitcher[node]));
    }
    nodes.pitch(node, put);
  }
}

void pitchBySweeps(Nodes& nodes, double enough, const Descent& descent) {
  for (;;) {
    double most = 0.0;
    for (const double held : nodes.held.pitcher) most = std::max(most, std::abs(held));
    descent.report(most);
    if (most <= enough) return;
    for (std::size_t node = 0; node < nodes.size(); ++node) {
      if (nodes.held.pitcher[node] != 0.0) nodes.pitch(node, [](std::uint32_t) {});
    }
  }
}

}  // namespace

double PitchedForces::sum() const {
  double all = 0.0;
  for (const double held : catcher) all += held;
  for (const double held : pitcher) all += held;
  return all;
}

PitchedForces pitchForces(const SpringNetwork& network, std::span<const double> force,
                          const PitchOptions& options, const Progress& progress) {
  if (force.size() != network.masses()) {
    throw InvalidInput("the network has " + std::to_string(network.masses()) +
                       " masses, but there are " + std::to_string(force.size()) + " forces");
  }
  double mean = 0.0;
  double most = 0.0;
  for (const double f : force) {
    mean += std::abs(f) / static_cast<double>(force.size());
    most = std::max(most, std::abs(f));
  }
  Nodes nodes(network, force);
  const double enough = options.tolerance * mean;
  const Descent descent(most, enough, progress);
  if (!std::isfinite(mean)) throw InvalidInput("a force of the network is no number");
  switch (options.order) {
    case PitchOrder::Heap:
      pitchByHeap(nodes, enough, descent);
      break;
    case PitchOrder::Buckets:
      pitchByBuckets(nodes, enough, descent);
      break;
    case PitchOrder::Sweeps:
      pitchBySweeps(nodes, enough, descent);
      break;
  }
  return std::move(nodes.held);
}

}  // namespace pneuma
