#include "pipeline/regress_report.h"

#include <algorithm>

#include "io/markup_text.h"
#include "pipeline/detail/page_style.h"
#include "pipeline/figure_table.h"
#include "pipeline/report.h"

namespace pneuma {
namespace {

constexpr std::string_view OwnStyle = R"(
  body { max-width: 100em; }
  h1 { font-size: 1.5em; margin: 0 0 .2em; } h2 { font-size: 1.05em; margin: 0; }
  p { margin: .2em 0; } code { color: var(--soft); }
  section { border-bottom: 1px solid var(--line); padding: .8em 0; }
  .three { display: grid; grid-template-columns: repeat(3, 1fr); gap: .6em; margin-top: .4em; }
)";

std::string figureOf(const std::string& file, const char* caption) {
  return "<figure><a href=\"" + file + "\"><img loading=\"lazy\" alt=\"" + caption + "\" src=\"" +
         file + "\"></a><figcaption>" + caption + "</figcaption></figure>\n";
}

std::string howOf(const ListedPicture& listed) {
  if (!listed.ready.empty()) return listed.ready.string();
  std::string text = "pneuma render";
  for (const auto& input : listed.inputs) text += " " + input.string();
  for (const std::string& option : listed.options) text += " " + option;
  return text;
}

std::string verdictOf(const ComparedPicture& picture) {
  std::string text;
  if (picture.compared()) {
    text = fixed(picture.score, 4) + ", the limit is " + textOf(picture.listed.limit);
    if (!picture.listed.reason.empty()) text += " (" + picture.listed.reason + ")";
  } else {
    text = picture.note;
  }
  if (picture.updated) text += "; the new one is the reference now";
  return text;
}

std::string sectionOf(const ComparedPicture& picture) {
  const std::string& name = picture.listed.name;
  const bool same = picture.outcome == PictureOutcome::Same;
  std::string text = "<section id=\"" + name + "\"><h2>" + name + "</h2>\n<p class=\"" +
                     (same ? "good" : "bad") + "\">" + markupEscaped(verdictOf(picture)) +
                     "</p>\n<p><code>" + markupEscaped(howOf(picture.listed)) +
                     "</code></p>\n<div class=\"three\">\n";
  if (picture.outcome != PictureOutcome::Missing) {
    text += figureOf(pageFile(name, PagePart::Reference), "reference");
  }
  text += figureOf(pageFile(name, PagePart::New), "new");
  if (picture.compared()) text += figureOf(pageFile(name, PagePart::Difference), "difference");
  return text + "</div></section>\n";
}

}  // namespace

std::size_t countOf(std::span<const ComparedPicture> pictures, PictureOutcome outcome) {
  return static_cast<std::size_t>(std::ranges::count(pictures, outcome, &ComparedPicture::outcome));
}

Json regressReport(const PictureList& list, std::span<const ComparedPicture> pictures,
                   Json parameters) {
  const InputFile input = inputFile(list.file);
  Json report = reportEnvelope("pneuma/regress/1", {&input, 1}, std::move(parameters), 0);
  Json entries = Json::array();
  for (const ComparedPicture& picture : pictures) {
    Json entry = {{"name", picture.listed.name},
                  {"outcome", textOf(picture.outcome)},
                  {"score", picture.compared() ? Json(picture.score) : Json()},
                  {"limit", picture.listed.limit},
                  {"updated", picture.updated}};
    if (!picture.listed.reason.empty()) entry["reason"] = picture.listed.reason;
    if (!picture.compared()) entry["note"] = picture.note;
    entries.push_back(std::move(entry));
  }
  report["pictures"] = std::move(entries);
  report["same"] = countOf(pictures, PictureOutcome::Same);
  report["differ"] = countOf(pictures, PictureOutcome::Differs);
  report["missing"] = countOf(pictures, PictureOutcome::Missing);
  report["peak_memory_mb"] = peakMemoryMb();
  return report;
}

std::string pageFile(const std::string& picture, PagePart part) {
  constexpr std::array<const char*, 3> Endings = {".reference.png", ".new.png", ".difference.png"};
  return picture + Endings[static_cast<std::size_t>(part)];
}

std::string regressPage(const PictureList& list, std::span<const ComparedPicture> pictures) {
  std::vector<const ComparedPicture*> sorted;
  for (const ComparedPicture& picture : pictures) sorted.push_back(&picture);
  const auto rank = [](const ComparedPicture* picture) {
    return picture->outcome == PictureOutcome::Differs   ? 0
           : picture->outcome == PictureOutcome::Missing ? 1
                                                         : 2;
  };
  std::ranges::stable_sort(sorted, {}, rank);
  const std::size_t same = countOf(pictures, PictureOutcome::Same);
  std::string text =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<title>Pictures drawn again</title>\n<style>" +
      std::string(PageStyle).append(OwnStyle) +
      "</style></head>\n<body><header><h1>Pictures drawn again</h1>\n" + "<p class=\"" +
      (same == pictures.size() ? "good" : "bad") + "\">" + std::to_string(same) + " of " +
      std::to_string(pictures.size()) + " look as their references do</p>\n" +
      "<p class=\"soft\">" + markupEscaped(list.file.string()) + ", pneuma " + versionText() +
      " (" + commitText() +
      "). A difference is 0 for equal pictures and 1 for pictures that have " +
      "nothing in common; bright is where they differ.</p></header>\n";
  for (const ComparedPicture* picture : sorted) text += sectionOf(*picture);
  return text + "</body></html>\n";
}

}  // namespace pneuma
