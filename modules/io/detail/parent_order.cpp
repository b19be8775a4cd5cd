#include "io/detail/parent_order.h"

#include <numeric>
#include <utility>

namespace pneuma {

std::vector<int> parentsFirst(std::span<const int> parents) {
  const std::size_t count = parents.size();
  bool inOrder = true;
  for (std::size_t i = 0; i < count; ++i) inOrder = inOrder && parents[i] < static_cast<int>(i);
  std::vector<int> order(inOrder ? count : 0);
  if (inOrder) {
    std::iota(order.begin(), order.end(), 0);
    return order;
  }
  std::vector<int> firstChild(count, -1);
  std::vector<int> nextSibling(count, -1);
  std::vector<int> waiting;
  for (std::size_t i = count; i-- > 0;) {
    if (parents[i] < 0) {
      waiting.push_back(static_cast<int>(i));
    } else {
      int& first = firstChild[static_cast<std::size_t>(parents[i])];
      nextSibling[i] = std::exchange(first, static_cast<int>(i));
    }
  }
  order.reserve(count);
  while (!waiting.empty()) {
    const int item = waiting.back();
    waiting.pop_back();
    order.push_back(item);
    const int sibling = nextSibling[static_cast<std::size_t>(item)];
    const int child = firstChild[static_cast<std::size_t>(item)];
    if (sibling >= 0) waiting.push_back(sibling);
    if (child >= 0) waiting.push_back(child);
  }
  return order;
}

}  // namespace pneuma
