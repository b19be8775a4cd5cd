#include "cli/paper_pictures.h"

#include <algorithm>
#include <array>

#include "cli/paper_figure.h"
#include "core/error.h"

namespace pneuma::cli {
namespace {

struct PaperFigures {
  std::string_view paper;
  std::span<const PaperFigure> (*figures)();
};

constexpr std::array<PaperFigures, 5> Papers = {{{"huang-2004", huangFigures},
                                                 {"kitaoka-1999", kitaokaFigures},
                                                 {"santhanam-2003", santhanam2003Figures},
                                                 {"santhanam-2008", santhanam2008Figures},
                                                 {"zhang-2003", zhangFigures}}};

std::span<const PaperFigure> figuresOf(std::string_view paper) {
  const auto found = std::ranges::find(Papers, paper, &PaperFigures::paper);
  if (found == Papers.end()) return {};
  return found->figures();
}

}  // namespace

const LungModel& figureModel(const Reproduction& reproduction, std::string_view name) {
  return std::ranges::find(reproduction.figures, name, &ReproducedFigure::name)->model;
}

std::vector<std::string_view> paperPictureNames(std::string_view paper) {
  std::vector<std::string_view> names;
  for (const PaperFigure& figure : figuresOf(paper)) names.push_back(figure.file);
  return names;
}

std::vector<PaperPicture> paperPictures(const Reproduction& reproduction,
                                        const Progress& progress) {
  const std::span<const PaperFigure> figures = figuresOf(reproduction.paper);
  const double share = 1.0 / static_cast<double>(figures.size());
  std::vector<PaperPicture> pictures;
  for (const PaperFigure& figure : figures) {
    const double from = share * static_cast<double>(pictures.size());
    const Progress part = progress.part(from, from + share, "drawing the figures");
    part.report(0.0);
    pictures.push_back({std::string(figure.file), figure.draw(reproduction, part)});
    part.report(1.0);
  }
  return pictures;
}

}  // namespace pneuma::cli
