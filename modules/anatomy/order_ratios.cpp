#include "anatomy/order_ratios.h"

#include <algorithm>
#include <cmath>

namespace pneuma {
namespace {

struct Element {
  int order = 0;
  double length = 0.0;
  double lengthTimesDiameter = 0.0;
};

/// Least squares through ln(values[k]) at k = 0, 1, ..., leaving out values that are not positive.
OrderRatio ratioOf(std::span<const double> values) {
  double n = 0.0;
  double meanX = 0.0;
  double meanY = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!(values[k] > 0.0)) continue;
    n += 1.0;
    meanX += static_cast<double>(k);
    meanY += std::log(values[k]);
  }
  if (n < 2.0) return {};
  meanX /= n;
  meanY /= n;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!(values[k] > 0.0)) continue;
    const double x = static_cast<double>(k) - meanX;
    const double y = std::log(values[k]) - meanY;
    xx += x * x;
    xy += x * y;
    yy += y * y;
  }
  // A level line explains all there is to explain.
  return {std::exp(std::abs(xy / xx)), yy > 0.0 ? xy * xy / (xx * yy) : 1.0};
}

std::vector<Element> elementsOf(const AirwayTree& tree, std::span<const int> orders,
                                std::span<const std::size_t> branches) {
  std::vector<int> elementOf(tree.size(), -1);
  std::vector<Element> elements;
  elements.reserve(branches.size());
  for (const std::size_t i : branches) {
    const int parent = tree[i].parent;
    if (parent >= 0 && orders[static_cast<std::size_t>(parent)] == orders[i]) {
      elementOf[i] = elementOf[static_cast<std::size_t>(parent)];
    }
    if (elementOf[i] < 0) {
      elementOf[i] = static_cast<int>(elements.size());
      elements.push_back({orders[i]});
    }
    Element& element = elements[static_cast<std::size_t>(elementOf[i])];
    const double length = lengthMm(tree[i]);
    element.length += length;
    element.lengthTimesDiameter += length * 2.0 * tree[i].radiusMm;
  }
  return elements;
}

}  // namespace

OrderRatios orderRatios(const AirwayTree& tree, std::span<const int> orders,
                        std::span<const std::size_t> branches) {
  const std::vector<Element> elements = elementsOf(tree, orders, branches);
  int highest = 0;
  for (const Element& element : elements) highest = std::max(highest, element.order);
  const auto size = static_cast<std::size_t>(highest);
  std::vector<double> count(size, 0.0);
  std::vector<double> length(size, 0.0);
  std::vector<double> diameter(size, 0.0);
  for (const Element& element : elements) {
    const auto k = static_cast<std::size_t>(element.order - 1);
    count[k] += 1.0;
    length[k] += element.length;
    if (element.length > 0.0) diameter[k] += element.lengthTimesDiameter / element.length;
  }
  OrderRatios ratios;
  for (std::size_t k = 0; k < size; ++k) {
    ratios.counts.push_back(static_cast<std::size_t>(count[k]));
    if (count[k] > 0.0) {
      length[k] /= count[k];
      diameter[k] /= count[k];
    }
  }
  ratios.branching = ratioOf(count);
  ratios.length = ratioOf(length);
  ratios.diameter = ratioOf(diameter);
  return ratios;
}

}  // namespace pneuma
