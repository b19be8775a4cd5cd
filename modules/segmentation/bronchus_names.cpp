#include "segmentation/bronchus_names.h"

#include <algorithm>
#include <vector>

namespace pneuma {
namespace {

// What a child must carry to count.
constexpr double MainLengthMm = 30.0;
constexpr double MainShare = 0.12;  ///< of all length
constexpr double LobarLengthMm = 12.0;
constexpr double MiddleForwardMm = 8.0;  ///< tips of the middle lobe lie this far in front
constexpr double MiddleWithinMm = 60.0;  ///< of the beginning of the intermedius

/// What a branch and all below it carry.
struct Carried {
  double lengthMm = 0.0;
  Vec3 tips = Vec3::Zero();
  int tipCount = 0;

  Vec3 meanTip() const { return tips / std::max(tipCount, 1); }
};

class Namer {
 public:
  explicit Namer(AirwayTree& tree) : tree_(tree), children_(tree), carried_(tree.size()) {
    for (std::size_t n = tree.size(); n-- > 0;) {
      tree.setLobe(n, Lobe::Central);
      carried_[n].lengthMm += pneuma::lengthMm(tree[n]);
      if (children_.isTerminal(n)) {
        carried_[n].tips += tree[n].distal;
        ++carried_[n].tipCount;
      }
      if (tree[n].parent < 0) continue;
      Carried& parent = carried_[static_cast<std::size_t>(tree[n].parent)];
      parent.lengthMm += carried_[n].lengthMm;
      parent.tips += carried_[n].tips;
      parent.tipCount += carried_[n].tipCount;
    }
  }

  BronchusNames name() {
    if (tree_.empty()) return {};
    const double least = std::max(MainLengthMm, MainShare * carried_[0].lengthMm);
    const auto trachea = branching(0, least);
    if (!trachea) return {};
    names_.trachea = trachea;
    names_.carina = tree_[*trachea].distal;
    std::vector<std::size_t> mains = childrenOver(*trachea, least);
    std::sort(mains.begin(), mains.end(),
              [&](std::size_t a, std::size_t b) { return tip(a).x() < tip(b).x(); });
    names_.rightMain = mains.front();
    names_.leftMain = mains.back();
    nameRight();
    nameLeft();
    mark(names_.rightUpper, Lobe::RightUpper);
    mark(names_.rightMiddle, Lobe::RightMiddle);
    mark(names_.rightLower, Lobe::RightLower);
    mark(names_.leftUpper, Lobe::LeftUpper);
    mark(names_.leftLower, Lobe::LeftLower);
    return names_;
  }

 private:
  Vec3 tip(std::size_t n) const { return carried_[n].meanTip(); }

  std::vector<std::size_t> childrenOver(std::size_t n, double leastMm) const {
    std::vector<std::size_t> found;
    for (const int child : children_.of(n)) {
      if (carried_[static_cast<std::size_t>(child)].lengthMm >= leastMm) {
        found.push_back(static_cast<std::size_t>(child));
      }
    }
    return found;
  }

  /// The first branch from `n` on down the largest children at whose end two carry `leastMm`.
  std::optional<std::size_t> branching(std::size_t n, double leastMm) const {
    while (true) {
      if (childrenOver(n, leastMm).size() >= 2) return n;
      const auto below = children_.of(n);
      if (below.empty()) return std::nullopt;
      n = static_cast<std::size_t>(*std::max_element(below.begin(), below.end(), [&](int a, int b) {
        return carried_[static_cast<std::size_t>(a)].lengthMm <
               carried_[static_cast<std::size_t>(b)].lengthMm;
      }));
    }
  }

  std::size_t highest(const std::vector<std::size_t>& branches) const {
    return *std::max_element(branches.begin(), branches.end(),
                             [&](std::size_t a, std::size_t b) { return tip(a).z() < tip(b).z(); });
  }

  std::size_t longest(const std::vector<std::size_t>& branches) const {
    return *std::max_element(branches.begin(), branches.end(), [&](std::size_t a, std::size_t b) {
      return carried_[a].lengthMm < carried_[b].lengthMm;
    });
  }

  void nameRight() {
    const auto end = branching(*names_.rightMain, LobarLengthMm);
    if (!end) return;
    std::vector<std::size_t> parts = childrenOver(*end, LobarLengthMm);
    names_.rightUpper = highest(parts);
    std::erase(parts, *names_.rightUpper);
    names_.intermedius = longest(parts);
    // Down the trunk: what turns to the front first is the middle lobe's; what turns to the back
    // before it is the lower lobe's superior segment.
    const Vec3 begin = tree_[*names_.intermedius].proximal;
    std::size_t trunk = *names_.intermedius;
    while (const auto at = branching(trunk, LobarLengthMm)) {
      const Vec3 here = tree_[*at].distal;
      if ((here - begin).norm() > MiddleWithinMm) break;
      std::vector<std::size_t> below = childrenOver(*at, LobarLengthMm);
      // Of those that go on, the one with the deepest tips is the trunk of the lower lobe.
      const std::size_t lower =
          *std::min_element(below.begin(), below.end(),
                            [&](std::size_t a, std::size_t b) { return tip(a).z() < tip(b).z(); });
      std::erase(below, lower);
      for (const std::size_t side : below) {
        const Vec3 forward = tip(side) - here;
        if (-forward.y() >= MiddleForwardMm && tip(side).y() < tip(lower).y()) {
          names_.rightMiddle = side;
        }
      }
      if (names_.rightMiddle) {
        names_.rightLower = lower;
        return;
      }
      trunk = lower;
    }
    // No middle lobe: all that goes on down belongs to the lower one.
    if (const auto at = branching(*names_.intermedius, LobarLengthMm)) {
      names_.rightLower = longest(childrenOver(*at, LobarLengthMm));
    } else if (tip(*names_.intermedius).z() < begin.z() - 2.0 * LobarLengthMm) {
      names_.rightLower = names_.intermedius;
    }
  }

  void nameLeft() {
    const auto end = branching(*names_.leftMain, LobarLengthMm);
    if (!end) return;
    std::vector<std::size_t> parts = childrenOver(*end, LobarLengthMm);
    names_.leftUpper = highest(parts);
    std::erase(parts, *names_.leftUpper);
    names_.leftLower = longest(parts);
  }

  void mark(std::optional<std::size_t> first, Lobe lobe) {
    if (!first) return;
    std::vector<bool> below(tree_.size(), false);
    for (std::size_t n = *first; n < tree_.size(); ++n) {
      const int parent = tree_[n].parent;
      below[n] = n == *first || (parent >= 0 && below[static_cast<std::size_t>(parent)]);
      if (below[n]) tree_.setLobe(n, lobe);
    }
  }

  AirwayTree& tree_;
  Children children_;
  std::vector<Carried> carried_;
  BronchusNames names_;
};

}  // namespace

BronchusNames nameBronchi(AirwayTree& tree) { return Namer(tree).name(); }

double lengthBetweenMm(const AirwayTree& tree, std::size_t from, std::optional<std::size_t> to) {
  double length = 0.0;
  std::size_t n = to && tree[*to].parent >= 0 ? static_cast<std::size_t>(tree[*to].parent) : from;
  while (true) {
    length += lengthMm(tree[n]);
    if (n == from || tree[n].parent < 0) return length;
    n = static_cast<std::size_t>(tree[n].parent);
  }
}

}  // namespace pneuma
