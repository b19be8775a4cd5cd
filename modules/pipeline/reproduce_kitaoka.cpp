#include <algorithm>
#include <array>

#include "core/joint_progress.h"
#include "core/parallel.h"
#include "pipeline/kitaoka_growth.h"
#include "pipeline/kitaoka_tables.h"
#include "pipeline/reproduce_paper.h"

namespace pneuma {
namespace {

/// The trees of the paper that are needed, each once.
class Trees {
 public:
  void want(const KitaokaCase& grown) {
    if (std::ranges::find(cases_, grown) == cases_.end()) cases_.push_back(grown);
  }

  /// Their tree is kept too, not only its figures.
  void keep(const KitaokaCase& grown) {
    want(grown);
    kept_.push_back(grown);
  }

  void grow(const Progress& progress) {
    JointProgress joint(progress, cases_.size());
    growths_.resize(cases_.size());
    parallelFor(cases_.size(), [&](std::size_t i) {
      growths_[i] = growCase(cases_[i], joint.task(i));
      if (std::ranges::find(kept_, cases_[i]) == kept_.end()) growths_[i].model = {};
    });
  }

  /// @pre wanted and grown
  const KitaokaGrowth& of(const KitaokaCase& grown) const {
    return growths_[static_cast<std::size_t>(std::ranges::find(cases_, grown) - cases_.begin())];
  }

 private:
  std::vector<KitaokaCase> cases_;
  std::vector<KitaokaCase> kept_;
  std::vector<KitaokaGrowth> growths_;
};

bool keepsOrder(const KitaokaTable& table, const KitaokaOrder& order, const Trees& trees) {
  std::vector<double> values;
  for (const std::size_t row : order.rows) {
    values.push_back(trees.of(table.rows[row].grown).figures.at(std::string(order.quantity)));
  }
  if (!order.rises) std::ranges::reverse(values);
  return std::ranges::adjacent_find(values, std::ranges::greater_equal{}) == values.end();
}

ReproducedTable filled(const KitaokaTable& table, const Trees& trees) {
  ReproducedTable result{std::string(table.id), std::string(table.name), {}};
  for (const KitaokaRow& row : table.rows) {
    const KitaokaGrowth& growth = trees.of(row.grown);
    for (const KitaokaFigure& figure : row.figures) {
      const std::string quantity(figure.quantity);
      result.rows.push_back({row.name, quantity, figure.published, growth.figures.at(quantity),
                             figure.limit, std::string(figure.note)});
    }
  }
  for (const KitaokaOrder& order : table.orders) {
    result.rows.push_back({order.name,
                           "order",
                           1.0,
                           keepsOrder(table, order, trees) ? 1.0 : 0.0,
                           Limit::difference(0.0),
                           {}});
  }
  return result;
}

void reproduceKitaoka(const ReproduceOptions& options, Reproduction& result,
                      const Progress& progress) {
  std::vector<KitaokaTable> tables = kitaokaTables();
  std::erase_if(tables, [&](const KitaokaTable& table) { return !wanted(options, table.id); });
  const std::vector<KitaokaPicture> pictures =
      options.figures ? kitaokaPictures() : std::vector<KitaokaPicture>{};
  Trees trees;
  for (const KitaokaTable& table : tables) {
    for (const KitaokaRow& row : table.rows) trees.want(row.grown);
  }
  for (const KitaokaPicture& picture : pictures) trees.keep(picture.shown);
  trees.grow(progress);
  for (const KitaokaTable& table : tables) result.tables.push_back(filled(table, trees));
  for (const KitaokaPicture& picture : pictures) {
    result.figures.push_back({std::string(picture.name), trees.of(picture.shown).model});
  }
}

}  // namespace

const Paper& kitaoka1999() {
  static const std::vector<PaperTable> tables = [] {
    std::vector<PaperTable> names;
    for (const KitaokaTable& table : kitaokaTables()) names.push_back({table.id, table.name});
    return names;
  }();
  static const Paper paper{"kitaoka-1999", growthMethod("kitaoka").citation, tables,
                           reproduceKitaoka};
  return paper;
}

}  // namespace pneuma
