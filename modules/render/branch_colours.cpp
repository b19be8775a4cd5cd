#include "render/branch_colours.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "anatomy/branch_order.h"
#include "anatomy/segment.h"
#include "render/colour_map.h"

namespace pneuma {
namespace {

using Peers = std::span<const std::shared_ptr<const AirwayTree>>;

std::vector<double> values(const AirwayTree& tree, ColourBy quantity) {
  std::vector<double> result(tree.size());
  if (quantity == ColourBy::Generation || quantity == ColourBy::Strahler) {
    const std::vector<int> orders =
        quantity == ColourBy::Generation ? generations(tree) : strahlerOrders(tree);
    std::copy(orders.begin(), orders.end(), result.begin());
  } else if (quantity == ColourBy::Diameter) {
    std::transform(tree.begin(), tree.end(), result.begin(),
                   [](const Branch& branch) { return 2.0 * branch.radiusMm; });
  } else {
    result = flowFractions(tree);
  }
  return result;
}

std::pair<Scale::Kind, std::string> kindAndTitle(ColourBy quantity) {
  switch (quantity) {
    case ColourBy::Generation:
      return {Scale::Kind::Count, "Generation"};
    case ColourBy::Strahler:
      return {Scale::Kind::Count, "Strahler order"};
    case ColourBy::Diameter:
      return {Scale::Kind::LogarithmicMm, "Diameter, mm"};
    default:
      return {Scale::Kind::LogarithmicShare, "Share of flow"};
  }
}

/// A branch without diameter or flow has no place on a logarithmic scale; it gets the lowest.
bool hasPlace(double value, bool logarithmic) { return !logarithmic || value > 0.0; }

/// The values that a scale must reach.
struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(const std::vector<double>& values, const std::vector<bool>& visible, bool logarithmic) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!visible[i] || !hasPlace(values[i], logarithmic)) continue;
      low = std::min(low, values[i]);
      high = std::max(high, values[i]);
    }
  }
};

BranchColours colouredByValue(const AirwayTree& tree, const std::vector<bool>& visible,
                              const SceneOptions& options, Peers peers) {
  const auto [kind, title] = kindAndTitle(options.colourBy);
  const bool logarithmic = kind != Scale::Kind::Count;
  const std::vector<double> value = values(tree, options.colourBy);
  Extent extent;
  extent.add(value, visible, logarithmic);
  for (const auto& peer : peers) {
    extent.add(values(*peer, options.colourBy), branchesUpTo(*peer, options.maxGeneration),
               logarithmic);
  }
  if (extent.low > extent.high) extent.low = extent.high = 1.0;
  const Scale scale(kind, extent.low, extent.high);
  BranchColours result;
  result.legend = scale.legend(title, options.background);
  result.colours.reserve(tree.size());
  for (const double v : value) {
    const double t = hasPlace(v, logarithmic) ? scale.position(v) : 0.0;
    result.colours.push_back(onBackground(scaleColour(t), options.background));
  }
  return result;
}

void addSegments(const AirwayTree& tree, const std::vector<bool>& visible,
                 std::set<std::uint8_t>& segments) {
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (visible[i]) segments.insert(tree[i].segment);
  }
}

/// "RB1" ... "LB10"; the number of a segment that has no name.
std::string segmentLabel(std::uint8_t segment) {
  const std::string_view name = segmentName(segment);
  return name.empty() ? std::to_string(segment) : std::string(name);
}

BranchColours colouredBySegment(const AirwayTree& tree, const std::vector<bool>& visible,
                                const SceneOptions& options, Peers peers) {
  const Background background = options.background;
  BranchColours result;
  for (const Branch& branch : tree) {
    result.colours.push_back(onBackground(segmentColour(branch.segment), background));
  }
  std::set<std::uint8_t> present;
  addSegments(tree, visible, present);
  for (const auto& peer : peers) {
    addSegments(*peer, branchesUpTo(*peer, options.maxGeneration), present);
  }
  result.legend.title = "Segment";
  const bool unnamed = present.erase(0) > 0;  // the airways before the segments: named last
  for (const std::uint8_t segment : present) {
    const std::string label = segmentLabel(segment);
    result.legend.chips.push_back({label, label, onBackground(segmentColour(segment), background)});
  }
  if (unnamed) {
    result.legend.chips.push_back({"none", "none", onBackground(segmentColour(0), background)});
  }
  return result;
}

}  // namespace

BranchColours branchColours(const AirwayTree& tree, const std::vector<bool>& visible,
                            const SceneOptions& options, Peers peers) {
  if (options.colourBy == ColourBy::Segment) {
    return colouredBySegment(tree, visible, options, peers);
  }
  if (options.colourBy != ColourBy::Lobe) return colouredByValue(tree, visible, options, peers);
  BranchColours result;
  result.colours.reserve(tree.size());
  for (const Branch& branch : tree) {
    result.colours.push_back(
        onBackground(airwayColour(branch.lobe, options.palette), options.background));
  }
  return result;
}

std::vector<bool> branchesUpTo(const AirwayTree& tree, int maxGeneration) {
  const std::vector<int> generation = generations(tree);
  std::vector<bool> visible(tree.size());
  for (std::size_t i = 0; i < tree.size(); ++i) visible[i] = generation[i] <= maxGeneration;
  return visible;
}

}  // namespace pneuma
