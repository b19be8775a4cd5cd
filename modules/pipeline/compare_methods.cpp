#include "pipeline/compare_methods.h"

#include <string>

#include "pipeline/report.h"

namespace pneuma {
namespace {

constexpr double ReadyAt = 0.02;
constexpr double GrownAt = 0.75;  // measuring takes a quarter of the time

/// Says which method it is that works. Points of several trees on top of each other show nothing.
class MethodProgress final : public ProgressSink {
 public:
  MethodProgress(const Progress& whole, std::string method)
      : whole_(whole), method_(std::move(method)) {}

  void report(double fraction, std::string_view what) override {
    const std::string text = method_ + (what.empty() ? "" : ": ") + std::string(what);
    whole_.part(0.0, 1.0, text).report(fraction);
  }

  bool stopRequested() const override { return whole_.stopRequested(); }

 private:
  Progress whole_;
  std::string method_;
};

OpenedTree openedOf(const LungModel& grown) {
  const std::string name(growthMethod(grown.growth->options).name);
  return {name, {name + ".vtp", {}}, "VTP", treeMetadata(grown), {}, treeOf(grown)};
}

}  // namespace

MethodComparison compareMethods(const LungModel& model, std::span<const GrowthOptions> methods,
                                const Progress& progress) {
  progress.part(0.0, ReadyAt, "preparing the lobes").report(0.0);
  MethodComparison result;
  result.organ = readyToGrow(model);
  result.organ.growth = nullptr;
  std::vector<OpenedTree> trees;
  const auto count = static_cast<double>(methods.size());
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const auto from = static_cast<double>(i);
    const Progress part = progress.part(ReadyAt + (GrownAt - ReadyAt) * from / count,
                                        ReadyAt + (GrownAt - ReadyAt) * (from + 1.0) / count, {});
    MethodProgress sink(part, std::string(growthMethod(methods[i]).title) + ", " +
                                  std::to_string(i + 1) + " of " + std::to_string(methods.size()));
    const LungModel grown = grow(result.organ, methods[i], Progress(sink));
    trees.push_back(openedOf(grown));
    result.growths.push_back(grown.growth);
  }
  result.measured = compareTrees(std::move(trees), result.organ, 1,
                                 progress.part(GrownAt, 1.0, "measuring the trees"));
  progress.report(1.0);
  return result;
}

LungModel withGrowthOf(LungModel model, const MethodComparison& comparison, std::size_t method) {
  model.regions = comparison.organ.regions;
  model.central = comparison.organ.central;
  model.growth = comparison.growths.at(method);
  return model;
}

}  // namespace pneuma
