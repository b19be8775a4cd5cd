#include <algorithm>
#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "io/detail/branch_rows.h"
#include "io/detail/text_fields.h"
#include "io/detail/tree_formats.h"

namespace pneuma {
namespace {

enum Member {
  Id,
  Parent,
  LobeValue,
  Segment,
  Diameter,
  OriginValue,
  EndingValue,
  Supplied,
  Proximal,
  Distal,
  Via,
  MemberCount
};

constexpr std::array<std::string_view, MemberCount> Names = {
    "id",     "parent",      "lobe",     "segment", "diameter_mm", "origin",
    "ending", "supplied_ml", "proximal", "distal",  "via"};

constexpr std::array<Member, 5> Required = {Id, Parent, Diameter, Proximal, Distal};

/// Takes the tree from the text as it is parsed: a document in memory would take ten times longer.
class TreeHandler {
 public:
  using number_integer_t = nlohmann::json::number_integer_t;
  using number_unsigned_t = nlohmann::json::number_unsigned_t;
  using number_float_t = nlohmann::json::number_float_t;
  using string_t = nlohmann::json::string_t;
  using binary_t = nlohmann::json::binary_t;

  explicit TreeHandler(const std::string& name) : name_(name) {}

  bool null() { return takeOther("null"); }

  bool boolean(bool value) { return takeOther(value ? "true" : "false"); }

  bool number_integer(number_integer_t value) { return takeNumber(static_cast<double>(value)); }

  bool number_unsigned(number_unsigned_t value) { return takeNumber(static_cast<double>(value)); }

  bool number_float(number_float_t value, const string_t& /*text*/) { return takeNumber(value); }

  bool string(string_t& text) { return takeOther(text); }

  bool binary(binary_t& /*bytes*/) { return true; }

  bool start_object(std::size_t /*size*/) {
    ++depth_;
    if (inBranches_ && depth_ == BranchDepth) {
      rows_.emplace_back();
      seen_.fill(false);
      member_ = MemberCount;
    } else if (inBranches_) {
      throwIfExpected("an object");
    }
    return true;
  }

  bool key(string_t& text) {
    if (depth_ == 1) {
      rootKey_ = text;
    } else if (depth_ == 2 && rootKey_ == "metadata") {
      metadataKey_ = text;
    } else if (inBranches_ && depth_ == BranchDepth) {
      const auto found = std::find(Names.begin(), Names.end(), text);
      member_ = static_cast<Member>(found - Names.begin());
    }
    return true;
  }

  bool end_object() {
    if (inBranches_ && depth_ == BranchDepth) finishBranch();
    --depth_;
    return true;
  }

  bool start_array(std::size_t /*size*/) {
    ++depth_;
    if (depth_ == 2 && rootKey_ == "branches") {
      inBranches_ = true;
      hasBranches_ = true;
    } else if (inBranches_ && depth_ == BranchDepth) {
      throw InvalidInput(where(rows_.size()) + " is a list; it must be an object");
    } else if (inBranches_ && depth_ == BranchDepth + 1) {
      values_.clear();
      if (member_ < Proximal) throwIfExpected("a list");
    } else if (inBranches_ && depth_ == BranchDepth + 2 && member_ != Via) {
      throwIfExpected("a list of lists");
    }
    return true;
  }

  bool end_array() {
    if (inBranches_ && depth_ == BranchDepth + 2 && member_ == Via && values_.size() % 4 != 0) {
      throwIfExpected("a list of other than four numbers");
    }
    if (inBranches_ && depth_ == BranchDepth + 1) finishList();
    if (depth_ == 2) inBranches_ = false;
    --depth_;
    return true;
  }

  bool parse_error(std::size_t position, const std::string& /*token*/,
                   const nlohmann::json::exception& /*error*/) {
    throw InvalidInput(name_ + " is damaged or cut off near byte " + std::to_string(position) +
                       "; get it anew");
  }

  TreeFile result() && {
    if (schema_ != TreeJsonSchema) {
      throw InvalidInput(name_ + " is JSON but not an airway tree: its \"schema\" is not \"" +
                         std::string(TreeJsonSchema) + "\"");
    }
    if (!hasBranches_) throw InvalidInput(name_ + " has no list \"branches\"");
    TreeFile file;
    file.format = "JSON";
    file.metadata = std::move(metadata_);
    file.tree = treeOfRows(std::move(rows_), name_, file.notes);
    if (space_ == "RAS") {
      file.tree = turnedFromRas(file.tree);
      file.notes.push_back(turnedFromRasNote(name_));
    }
    return file;
  }

 private:
  /// Objects and lists around a branch's members: root, "branches", the branch.
  static constexpr int BranchDepth = 3;

  std::string where(std::size_t entry) const {
    return name_ + ", entry " + std::to_string(entry) + " of \"branches\"";
  }

  std::string here() const { return where(rows_.size() - 1); }

  /// For a value that cannot be the member's. Members that are not known may be anything.
  void throwIfExpected(const std::string& found) const {
    if (member_ == MemberCount) return;
    throw InvalidInput(here() + ": \"" + std::string(Names[member_]) + "\" is or holds " + found +
                       "; compare with docs/vtp-format.md");
  }

  bool takeOther(const std::string& text) {
    if (inBranches_) {
      if (depth_ < BranchDepth) throw InvalidInput(where(rows_.size()) + " is not an object");
      throwIfExpected("\"" + text + "\"");
    } else if (depth_ == 1 && rootKey_ == "schema") {
      schema_ = text;
    } else if (depth_ == 1 && rootKey_ == "space") {
      space_ = text;
    } else if (depth_ == 2 && rootKey_ == "metadata") {
      metadata_[metadataKey_] = text;
    }
    return true;
  }

  bool takeNumber(double value) {
    if (!inBranches_) return takeOther(numberText(value));
    if (depth_ < BranchDepth) throw InvalidInput(where(rows_.size()) + " is not an object");
    if (member_ == MemberCount) return true;
    if (depth_ > BranchDepth) {
      const int listDepth = member_ == Via ? BranchDepth + 2 : BranchDepth + 1;
      if (depth_ != listDepth) throwIfExpected("a number where a list should be");
      values_.push_back(value);
      return true;
    }
    if (member_ >= Proximal) throwIfExpected("a number");
    takeScalar(value);
    return true;
  }

  void takeScalar(double value) {
    BranchRow& row = rows_.back();
    seen_[member_] = true;
    switch (member_) {
      case Id:
        row.id = wholeNumber(value);
        break;
      case Parent:
        row.parent = wholeNumber(value);
        break;
      case LobeValue:
        row.branch.lobe = lobeOfValue(value, here());
        break;
      case Segment:
        row.branch.segment = segmentOfValue(value, here());
        break;
      case Diameter:
        row.branch.radiusMm = value / 2.0;
        break;
      case OriginValue:
        row.branch.origin = originOfValue(value, here());
        break;
      case EndingValue:
        row.branch.ending = endingOfValue(value, here());
        break;
      case Supplied:
        row.branch.suppliedMl = value;
        break;
      default:
        break;
    }
  }

  std::int64_t wholeNumber(double value) const {
    if (value != std::floor(value) || std::abs(value) > 1e15) {
      throwIfExpected(numberText(value) + ", no whole number");
    }
    return static_cast<std::int64_t>(value);
  }

  void finishList() {
    if (member_ < Proximal || member_ == MemberCount) return;
    seen_[member_] = true;
    Branch& branch = rows_.back().branch;
    if (member_ == Via) {
      for (std::size_t i = 0; i < values_.size(); i += 4) {
        branch.via.push_back({Vec3(values_.data() + i), values_[i + 3]});
      }
      return;
    }
    if (values_.size() != 3) throwIfExpected("other than three numbers");
    (member_ == Proximal ? branch.proximal : branch.distal) = Vec3(values_.data());
  }

  void finishBranch() {
    for (const Member member : Required) {
      if (seen_[member]) continue;
      throw InvalidInput(here() + " has no \"" + std::string(Names[member]) +
                         "\"; compare with docs/vtp-format.md");
    }
    if (!seen_[OriginValue]) rows_.back().branch.origin = Origin::Measured;
  }

  const std::string& name_;
  int depth_ = 0;
  bool inBranches_ = false;
  bool hasBranches_ = false;
  std::string rootKey_;
  std::string metadataKey_;
  std::string schema_;
  std::string space_;
  Metadata metadata_;
  std::vector<BranchRow> rows_;
  Member member_ = MemberCount;
  std::array<bool, MemberCount> seen_{};
  std::vector<double> values_;
};

}  // namespace

TreeFile readTreeJson(const std::string& content, const std::string& name) {
  TreeHandler handler(name);
  nlohmann::json::sax_parse(content, &handler);
  return std::move(handler).result();
}

}  // namespace pneuma
