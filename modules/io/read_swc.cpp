#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "core/error.h"
#include "io/detail/branch_rows.h"
#include "io/detail/point_tree.h"
#include "io/detail/text_fields.h"
#include "io/detail/tree_comments.h"
#include "io/detail/tree_formats.h"

namespace pneuma {
namespace {

constexpr std::array<std::string_view, 7> Columns = {"id", "type",   "x",     "y",
                                                     "z",  "radius", "parent"};

/// Where a point stands and what it names, before its parent is looked up.
struct SwcPoint {
  std::int64_t id = 0;
  std::int64_t parent = -1;
  std::size_t line = 0;
};

std::string lineOf(const std::string& name, std::size_t line) {
  return name + ", line " + std::to_string(line);
}

std::array<std::string_view, 7> splitLine(std::string_view line, const std::string& where) {
  std::array<std::string_view, 7> fields;
  constexpr std::string_view Blanks = " \t,";
  std::size_t count = 0;
  for (std::size_t begin = line.find_first_not_of(Blanks); begin != std::string_view::npos;
       begin = line.find_first_not_of(Blanks, begin)) {
    const std::size_t end = std::min(line.find_first_of(Blanks, begin), line.size());
    if (line[begin] == '#') break;
    if (count < fields.size()) fields[count] = line.substr(begin, end - begin);
    ++count;
    begin = end;
  }
  if (count < fields.size()) {
    throw InvalidInput(where + " has " + std::to_string(count) +
                       " columns; SWC has seven: id type x y z radius parent");
  }
  return fields;
}

double numberIn(const std::array<std::string_view, 7>& fields, std::size_t column,
                const std::string& where) {
  const std::optional<double> number = parseDouble(fields[column]);
  if (!number.has_value() || !std::isfinite(*number)) {
    throw InvalidInput(where + ", column " + std::to_string(column + 1) + " (" +
                       std::string(Columns[column]) + "): \"" + std::string(fields[column]) +
                       "\" is not a number");
  }
  return *number;
}

std::int64_t integerIn(const std::array<std::string_view, 7>& fields, std::size_t column,
                       const std::string& where) {
  const double number = numberIn(fields, column, where);
  if (number != std::floor(number) || std::abs(number) > 1e15) {
    throw InvalidInput(where + ", column " + std::to_string(column + 1) + " (" +
                       std::string(Columns[column]) + "): \"" + std::string(fields[column]) +
                       "\" is not a whole number");
  }
  return static_cast<std::int64_t>(number);
}

/// Finds every point's parent among the points.
void linkParents(std::vector<PointTree::Node>& nodes, const std::vector<SwcPoint>& points,
                 const std::string& name) {
  std::unordered_map<std::int64_t, int> nodeOfId;
  nodeOfId.reserve(points.size());
  for (const SwcPoint& point : points) {
    if (!nodeOfId.emplace(point.id, static_cast<int>(nodeOfId.size())).second) {
      throw InvalidInput(lineOf(name, point.line) + ": the id " + std::to_string(point.id) +
                         " is taken by a line above; every point needs its own");
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SwcPoint& point = points[i];
    if (point.parent == -1) continue;
    const auto parent = nodeOfId.find(point.parent);
    if (parent == nodeOfId.end()) {
      throw InvalidInput(lineOf(name, point.line) + ": the parent " + std::to_string(point.parent) +
                         " is not in the file; is the file complete?");
    }
    if (parent->second == static_cast<int>(i)) {
      throw InvalidInput(lineOf(name, point.line) + ": point " + std::to_string(point.id) +
                         " is its own parent; the root's parent is -1");
    }
    nodes[i].parent = parent->second;
  }
}

/// Calls `f` with the node of every id in a list such as "2-15 18".
template <class F>
void forEachListed(std::string_view list, std::vector<PointTree::Node>& nodes,
                   const std::string& name, F&& f) {
  // Pneuma numbers its points 1, 2, 3 ...
  const auto count = static_cast<std::int64_t>(nodes.size());
  while (!(list = trimmed(list)).empty()) {
    const std::string_view range = list.substr(0, list.find(' '));
    list.remove_prefix(range.size());
    const std::size_t dash = range.find('-');
    const std::optional<std::int64_t> first = parseInteger(range.substr(0, dash));
    const std::optional<std::int64_t> last =
        dash == std::string_view::npos ? first : parseInteger(range.substr(dash + 1));
    if (!first || !last || *first < 1 || *last < *first || *last > count) {
      throw InvalidInput(name + ": \"" + std::string(range) +
                         "\" in its comments is no range of points; delete the comments to read it "
                         "as any SWC file");
    }
    for (std::int64_t id = *first; id <= *last; ++id) f(nodes[static_cast<std::size_t>(id - 1)]);
  }
}

/// What only files of Pneuma say: lobes, origins and which points end a branch.
void takeOwnComments(PointTree& tree, const std::vector<int>& types, const TreeComments& comments,
                     const std::string& name) {
  tree.endRadiusIsBranchRadius = true;
  for (std::size_t i = 0; i < types.size(); ++i) {
    tree.nodes[i].lobe = lobeOfValue(types[i] - FirstSwcType,
                                     name + ", type of point " + std::to_string(i + 1) + " less 5");
    tree.nodes[i].endsBranch = true;
  }
  for (const auto& [key, list] : comments.reserved) {
    for (std::size_t origin = 0; origin < OriginKeys.size(); ++origin) {
      if (key != OriginKeys[origin]) continue;
      forEachListed(list, tree.nodes, name,
                    [&](PointTree::Node& node) { node.origin = static_cast<Origin>(origin); });
    }
    if (key == BetweenKey) {
      forEachListed(list, tree.nodes, name, [](PointTree::Node& node) { node.endsBranch = false; });
    }
  }
}

}  // namespace

TreeFile readSwc(const std::string& content, const std::string& name) {
  TreeFile file;
  file.format = "SWC";
  PointTree tree;
  TreeComments comments;
  std::vector<SwcPoint> points;
  std::vector<int> types;
  Lines lines(content);
  while (const std::optional<std::string_view> next = lines.next()) {
    const std::string_view line = trimmed(*next);
    if (line.empty()) continue;
    if (line.front() == '#') {
      comments.add(*next);
      continue;
    }
    const std::string where = lineOf(name, lines.number());
    const auto fields = splitLine(line, where);
    PointTree::Node node;
    node.position =
        Vec3(numberIn(fields, 2, where), numberIn(fields, 3, where), numberIn(fields, 4, where));
    node.radiusMm = numberIn(fields, 5, where);
    if (!(node.radiusMm > 0.0)) {
      throw InvalidInput(where + ": the radius is " + std::string(fields[5]) +
                         " mm; it must be above 0");
    }
    if (points.size() == static_cast<std::size_t>(std::numeric_limits<int>::max())) {
      throw InvalidInput(name + " holds more than 2147483647 points; split it");
    }
    types.push_back(
        static_cast<int>(std::clamp<std::int64_t>(integerIn(fields, 1, where), -1, 999)));
    points.push_back({integerIn(fields, 0, where), integerIn(fields, 6, where), lines.number()});
    tree.nodes.push_back(std::move(node));
  }
  comments.requireCount(PointCountKey, points.size(), content, name);
  linkParents(tree.nodes, points, name);
  if (comments.ownFile) {
    takeOwnComments(tree, types, comments, name);
  }
  file.tree = treeOfPoints(tree, name);
  file.metadata = std::move(comments.metadata);
  if (comments.ras) {
    file.tree = turnedFromRas(file.tree);
    file.notes.push_back(turnedFromRasNote(name));
  }
  return file;
}

}  // namespace pneuma
