#include <initializer_list>

#include <nlohmann/json.hpp>

#include "io/detail/branch_columns.h"
#include "io/detail/text_fields.h"
#include "io/detail/tree_comments.h"
#include "io/detail/tree_formats.h"

namespace pneuma {
namespace {

/// Appends values with commas between them.
class Joined {
 public:
  explicit Joined(std::string& text) : text_(text) {}

  Joined& operator<<(double value) { return append(value); }

  Joined& operator<<(int value) { return append(std::int64_t{value}); }

  Joined& operator<<(const Vec3& p) { return *this << p.x() << p.y() << p.z(); }

 private:
  template <class Value>
  Joined& append(Value value) {
    if (!first_) text_ += ',';
    first_ = false;
    appendNumber(text_, value);
    return *this;
  }

  std::string& text_;
  bool first_ = true;
};

/// The points of an SWC file and the ranges of them that its comments list.
class SwcLines {
 public:
  /// Adds a point and returns its number.
  int add(const Vec3& p, double radiusMm, const Branch& branch, int parent, bool between) {
    const int id = ++count_;
    appendNumber(text_, std::int64_t{id});
    text_ += ' ';
    appendNumber(text_, std::int64_t{FirstSwcType + static_cast<int>(branch.lobe)});
    for (const double value : {p.x(), p.y(), p.z(), radiusMm}) {
      text_ += ' ';
      appendNumber(text_, value);
    }
    text_ += ' ';
    appendNumber(text_, std::int64_t{parent});
    text_ += '\n';
    origins_[static_cast<std::size_t>(branch.origin)].add(id);
    if (between) between_.add(id);
    return id;
  }

  int count() const { return count_; }

  const std::string& text() const { return text_; }

  std::string rangeComments() const {
    std::string text = comment(BetweenKey, between_);
    for (std::size_t origin = 0; origin < OriginKeys.size(); ++origin) {
      text += comment(OriginKeys[origin], origins_[origin]);
    }
    return text;
  }

 private:
  struct Ranges {
    std::vector<std::pair<int, int>> parts;

    void add(int id) {
      if (!parts.empty() && parts.back().second == id - 1) {
        parts.back().second = id;
      } else {
        parts.emplace_back(id, id);
      }
    }
  };

  static std::string comment(std::string_view key, const Ranges& ranges) {
    if (ranges.parts.empty()) return "";
    std::string text = "# " + std::string(key) + ":";
    for (const auto& [first, last] : ranges.parts) {
      text += ' ' + std::to_string(first);
      if (last > first) text += '-' + std::to_string(last);
    }
    return text + '\n';
  }

  std::string text_;
  int count_ = 0;
  Ranges between_;
  std::array<Ranges, 3> origins_;
};

std::string quotedJson(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void appendJsonList(std::string& text, std::initializer_list<double> values) {
  text += '[';
  Joined joined(text);
  for (const double value : values) joined << value;
  text += ']';
}

}  // namespace

std::string swcText(const AirwayTree& tree, const Metadata& metadata) {
  SwcLines lines;
  std::vector<int> endPoint(tree.size());  // number of the point at every branch's distal end
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const Branch& branch = tree[i];
    int last = -1;
    if (branch.parent < 0) {
      last = lines.add(branch.proximal, branch.radiusMm, branch, -1, false);
    } else {
      const auto parent = static_cast<std::size_t>(branch.parent);
      last = endPoint[parent];
      // A branch that starts away from its parent's end keeps its start as a point on its way.
      if (branch.proximal != tree[parent].distal) {
        last = lines.add(branch.proximal, branch.radiusMm, branch, last, true);
      }
    }
    for (const CentrelinePoint& point : branch.via) {
      last = lines.add(point.position, point.radiusMm, branch, last, true);
    }
    endPoint[i] = lines.add(branch.distal, branch.radiusMm, branch, last, false);
  }
  return treeCommentsText(metadata, PointCountKey, static_cast<std::size_t>(lines.count())) +
         lines.rangeComments() +
         "# Type is 5 plus the lobe of the branch that ends at or runs through the point, as in "
         "docs/vtp-format.md of Pneuma.\n"
         "# id type x y z radius parent\n" +
         lines.text();
}

std::string treeCsvText(const AirwayTree& tree, const Metadata& metadata) {
  const BranchColumns columns(tree);
  std::string text = treeCommentsText(metadata, BranchCountKey, tree.size());
  text.reserve(text.size() + 200 * tree.size());
  text +=
      "id,parent,lobe,side,segment,generation,horsfield_order,strahler_order,x0,y0,z0,x1,y1,z1,"
      "length_mm,diameter_mm,flow_fraction,region_ml,terminal,origin,ending,supplied_ml\n";
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const Branch& branch = tree[i];
    Joined(text) << static_cast<int>(i) << branch.parent << static_cast<int>(branch.lobe)
                 << static_cast<int>(side(branch.lobe)) << static_cast<int>(branch.segment)
                 << columns.generation[i] << columns.horsfieldOrder[i] << columns.strahlerOrder[i]
                 << branch.proximal << branch.distal << lengthMm(branch) << 2.0 * branch.radiusMm
                 << columns.flowFraction[i] << columns.regionMl[i]
                 << static_cast<int>(columns.terminal[i]) << static_cast<int>(branch.origin)
                 << static_cast<int>(branch.ending) << branch.suppliedMl;
    text += '\n';
  }
  return text;
}

std::string treeJsonText(const AirwayTree& tree, const Metadata& metadata) {
  const BranchColumns columns(tree);
  std::string text = "{\n\"schema\": \"" + std::string(TreeJsonSchema) +
                     "\",\n\"space\": \"LPS\",\n\"units\": \"" + std::string(Units) +
                     "\",\n\"metadata\": {";
  bool first = true;
  for (const auto& [key, value] : metadata) {
    if (key == SpaceKey || key == UnitsKey) continue;
    text += (first ? "\n  " : ",\n  ") + quotedJson(key) + ": " + quotedJson(value);
    first = false;
  }
  text += "\n},\n\"branches\": [";
  text.reserve(text.size() + 400 * tree.size());
  const auto member = [&text](const char* key, auto value) {
    text += ",\"";
    text += key;
    text += "\":";
    appendNumber(text, value);
  };
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const Branch& branch = tree[i];
    text += i == 0 ? "\n{\"id\":" : ",\n{\"id\":";
    appendNumber(text, static_cast<std::int64_t>(i));
    member("parent", std::int64_t{branch.parent});
    member("lobe", static_cast<std::int64_t>(branch.lobe));
    member("side", static_cast<std::int64_t>(side(branch.lobe)));
    member("segment", std::int64_t{branch.segment});
    member("generation", std::int64_t{columns.generation[i]});
    member("horsfield_order", std::int64_t{columns.horsfieldOrder[i]});
    member("strahler_order", std::int64_t{columns.strahlerOrder[i]});
    text += ",\"proximal\":";
    appendJsonList(text, {branch.proximal.x(), branch.proximal.y(), branch.proximal.z()});
    text += ",\"distal\":";
    appendJsonList(text, {branch.distal.x(), branch.distal.y(), branch.distal.z()});
    member("length_mm", lengthMm(branch));
    member("diameter_mm", 2.0 * branch.radiusMm);
    member("flow_fraction", columns.flowFraction[i]);
    member("region_ml", columns.regionMl[i]);
    member("terminal", std::int64_t{columns.terminal[i]});
    member("origin", static_cast<std::int64_t>(branch.origin));
    member("ending", static_cast<std::int64_t>(branch.ending));
    member("supplied_ml", branch.suppliedMl);
    if (!branch.via.empty()) {
      text += ",\"via\":[";
      for (const CentrelinePoint& point : branch.via) {
        if (&point != branch.via.data()) text += ',';
        const Vec3& p = point.position;
        appendJsonList(text, {p.x(), p.y(), p.z(), point.radiusMm});
      }
      text += ']';
    }
    text += '}';
  }
  return text + "\n]\n}\n";
}

}  // namespace pneuma
