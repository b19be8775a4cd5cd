#include "document/option_layout.h"

#include <QObject>
#include <algorithm>
#include <variant>

namespace pneuma {

namespace {

using Names = std::vector<std::string>;

/// What is wanted; options that a method does not have are left out.
OptionLayout wantedLayout(std::string_view method) {
  const auto tr = [](const char* text) { return QObject::tr(text); };
  if (method == "kitaoka") {
    return {
        {"terminals", "flow-threshold", "symmetry", "seed", "rescue"},
        {{tr("Rules"), {"rule-4a", "rule-6a", "rule-7a", "rule-8a"}},
         {tr("Shape"), {"length-to-diameter", "diameter-exponent", "trunk-diameter", "rotation"}},
         {tr("Limits"),
          {"min-distance-to-length", "max-distance-to-length", "ratio-threshold", "last-ratio",
           "grid"}},
         {tr("Variation"), {"length-spread", "rotation-spread"}},
         {tr("Beyond the paper"),
          {"containment", "inlet-regions", "terminal-ends", "reach", "remeasure"}}}};
  }
  if (method == "centroid") return {{"terminals", "ratio", "containment", "seed"}, {}};
  if (method == "dla") {
    return {{"particles", "terminals", "voxel", "seed"},
            {{tr("Walkers"), {"wall", "most-steps", "sticking"}},
             {tr("Where walkers start"),
              {"share-rul", "share-rml", "share-rll", "share-lul", "share-lll"}},
             {tr("From aggregate to tree"), {"min-twig", "smoothing", "diameter-exponent"}}}};
  }
  return {{"terminals", "containment", "seed"}, {}};
}

Names optionNames(const GrowthOptions& options) {
  Names names;
  std::visit(
      [&](const auto& chosen) {
        forEachField<std::remove_cvref_t<decltype(chosen)>>(
            [&](const auto& field) { names.emplace_back(field.name); });
      },
      options);
  return names;
}

/// Those of `wanted` that are still in `left`, which loses them.
Names taken(const Names& wanted, Names& left) {
  Names result;
  for (const std::string& name : wanted) {
    if (std::erase(left, name) > 0) result.push_back(name);
  }
  return result;
}

}  // namespace

OptionLayout optionLayout(const GrowthMethod& method) {
  const OptionLayout wanted = wantedLayout(method.name);
  Names left = optionNames(method.defaults);
  OptionLayout layout;
  layout.usual = taken(wanted.usual, left);
  for (const OptionGroup& group : wanted.groups) {
    if (Names names = taken(group.names, left); !names.empty()) {
      layout.groups.push_back({group.title, std::move(names)});
    }
  }
  if (!left.empty()) {
    layout.groups.push_back({layout.groups.empty() ? QString() : QObject::tr("Other"), left});
  }
  return layout;
}

std::optional<GrowthOptions> paperOptions(const GrowthMethod& method) {
  if (std::holds_alternative<KitaokaOptions>(method.defaults)) return kitaokaPaper();
  return std::nullopt;
}

}  // namespace pneuma
