#include "io/detail/branch_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "core/error.h"
#include "io/detail/parent_order.h"
#include "io/detail/text_fields.h"

namespace pneuma {
namespace {

/// What keeps a branch from being one, as the end of a sentence; "" if nothing does.
std::string problemOf(const Branch& branch) {
  bool finite = branch.proximal.allFinite() && branch.distal.allFinite();
  for (const CentrelinePoint& point : branch.via) finite = finite && point.position.allFinite();
  if (!finite) return "has a coordinate that is not a number";
  double least = branch.radiusMm;
  for (const CentrelinePoint& point : branch.via) {
    if (!(point.radiusMm >= least)) least = point.radiusMm;
  }
  if (!(least > 0.0) || !std::isfinite(least)) {
    return "has a radius of " + numberText(least) + " mm; it must be above 0";
  }
  if (!(branch.suppliedMl >= 0.0) || !std::isfinite(branch.suppliedMl)) {
    return "supplies " + numberText(branch.suppliedMl) + " ml; it must be 0 or more";
  }
  return "";
}

/// Position of every row's parent among the rows; -1 for the root.
std::vector<int> parentsOf(const std::vector<BranchRow>& rows, const std::string& name) {
  std::unordered_map<std::int64_t, int> position;
  position.reserve(rows.size());
  for (const BranchRow& row : rows) {
    if (!position.emplace(row.id, static_cast<int>(position.size())).second) {
      throw InvalidInput(name + " has two branches with the id " + std::to_string(row.id) +
                         "; every branch needs its own");
    }
  }
  std::vector<int> parents(rows.size(), -1);
  const BranchRow* root = nullptr;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const BranchRow& row = rows[i];
    if (row.parent == -1) {
      if (root != nullptr) {
        throw InvalidInput(name + " has two roots, branches " + std::to_string(root->id) + " and " +
                           std::to_string(row.id) +
                           "; an airway tree has one, so keep one tree in the file");
      }
      root = &row;
      continue;
    }
    if (row.parent == row.id) {
      throw InvalidInput(name + ": branch " + std::to_string(row.id) +
                         " is its own parent; the root's parent is -1");
    }
    const auto parent = position.find(row.parent);
    if (parent == position.end()) {
      throw InvalidInput(name + ": branch " + std::to_string(row.id) + " names branch " +
                         std::to_string(row.parent) +
                         " as its parent, which is not in the file; is the file complete?");
    }
    parents[i] = parent->second;
  }
  if (root == nullptr) {
    throw InvalidInput(name +
                       " has no root (a branch whose parent is -1), so its branches run in a "
                       "cycle; an airway tree has none");
  }
  return parents;
}

/// The value as a whole number in [0, 255], -1 if it is none.
int byteOf(double value) {
  return value >= 0.0 && value <= 255.0 && value == std::floor(value) ? static_cast<int>(value)
                                                                      : -1;
}

}  // namespace

AirwayTree treeOfRows(std::vector<BranchRow> rows, const std::string& name,
                      std::vector<std::string>& notes) {
  if (rows.empty()) throw InvalidInput(name + " holds no branch; is it the right file?");
  if (rows.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw InvalidInput(name + " holds more than 2147483647 branches; split it");
  }
  for (const BranchRow& row : rows) {
    const std::string problem = problemOf(row.branch);
    if (!problem.empty()) {
      throw InvalidInput(name + ": branch " + std::to_string(row.id) + " " + problem);
    }
  }
  const std::vector<int> parents = parentsOf(rows, name);
  AirwayTree tree;
  tree.reserve(rows.size());
  const std::vector<int> order = parentsFirst(parents);
  if (order.size() < rows.size()) {
    throw InvalidInput(name + " has a cycle: " + std::to_string(rows.size() - order.size()) +
                       " branches do not lead back to the root; an airway tree has no cycle");
  }
  std::vector<int> newIndex(rows.size(), -1);
  for (const int old : order) {
    Branch& branch = rows[static_cast<std::size_t>(old)].branch;
    const int parent = parents[static_cast<std::size_t>(old)];
    branch.parent = parent < 0 ? -1 : newIndex[static_cast<std::size_t>(parent)];
    newIndex[static_cast<std::size_t>(old)] = tree.add(std::move(branch));
  }
  if (!std::is_sorted(order.begin(), order.end())) {
    notes.push_back(name +
                    " lists some branches before their parents; they were put in order and "
                    "renumbered.");
  }
  return tree;
}

void requireWritableTree(const AirwayTree& tree) {
  if (tree.empty()) throw InvalidInput("there is no branch to write; grow or open a tree first");
  int root = -1;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const std::string problem = problemOf(tree[i]);
    if (!problem.empty()) {
      throw InvalidInput("the tree cannot be written: branch " + std::to_string(i) + " " + problem);
    }
    if (tree[i].parent >= 0) continue;
    if (root >= 0) {
      throw InvalidInput("the tree cannot be written: it has two roots, branches " +
                         std::to_string(root) + " and " + std::to_string(i) +
                         "; write one tree to a file");
    }
    root = static_cast<int>(i);
  }
}

Lobe lobeOfValue(double value, const std::string& where) {
  const int number = byteOf(value);
  switch (number) {
    case 0:
    case 1:
    case 2:
    case 3:
    case 4:
    case 5:
    case 6:
    case 10:
    case 20:
      return static_cast<Lobe>(number);
    default:
      throw InvalidInput(where + ": " + numberText(value) +
                         " is no lobe; use 0 whole, 1 RUL, 2 RML, 3 RLL, 4 LUL, 5 LLL, 6 central, "
                         "10 right lung, 20 left lung");
  }
}

Origin originOfValue(double value, const std::string& where) {
  const int number = byteOf(value);
  if (number < 0 || number > 2) {
    throw InvalidInput(where + ": " + numberText(value) +
                       " is no origin; use 0 measured, 1 template, 2 grown");
  }
  return static_cast<Origin>(number);
}

Ending endingOfValue(double value, const std::string& where) {
  const int number = byteOf(value);
  if (number < 0 || number > 3) {
    throw InvalidInput(where + ": " + numberText(value) +
                       " is no ending; use 0 none, 1 small enough, 2 left its region, 3 could not "
                       "be divided");
  }
  return static_cast<Ending>(number);
}

std::uint8_t segmentOfValue(double value, const std::string& where) {
  const int number = byteOf(value);
  if (number < 0) {
    throw InvalidInput(where + ": " + numberText(value) +
                       " is no segment; use a whole number from 0 (unknown) to 255");
  }
  return static_cast<std::uint8_t>(number);
}

}  // namespace pneuma
