#include "pipeline/case_page.h"

#include <vtkBase64Utilities.h>

#include "io/markup_text.h"
#include "pipeline/detail/case_text.h"
#include "pipeline/detail/page_style.h"

namespace pneuma {
namespace {

constexpr std::string_view Style = R"(
  body { max-width: 62em; }
  h1 { font-size: 1.6em; margin: 0; } h2 { font-size: 1.1em; margin: 1.6em 0 .4em; }
  header p, footer, .soft { color: var(--soft); margin: .2em 0; }
  .pictures { display: grid; grid-template-columns: repeat(4, 1fr); gap: .6em; margin-top: 1em; }
  img { border-radius: 4px; } figcaption { text-align: center; }
  table { border-collapse: collapse; width: 100%; }
  th { text-align: left; font-weight: 600; border-bottom: 1px solid var(--ink); }
  td, th { padding: .22em .6em .22em 0; vertical-align: top; }
  td { border-bottom: 1px solid var(--line); }
  td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; }
  .columns { display: grid; grid-template-columns: 1fr 1fr; gap: 0 2.5em; }
  code { overflow-wrap: anywhere; }
  footer { border-top: 1px solid var(--line); margin-top: 2em; padding-top: .6em; font-size: .85em; }
  @media print { body { font-size: 9.5pt; margin: 0; max-width: none; padding: 0; }
                 h2, tr, figure { break-inside: avoid; } @page { size: A4; margin: 14mm; } }
  @media (max-width: 50em) { .columns { display: block; }
                             .pictures { grid-template-columns: 1fr 1fr; } }
)";

std::string element(const char* name, const std::string& content, const char* kind = "") {
  std::string text = "<";
  text += name;
  if (*kind != '\0') text.append(" class=\"").append(kind).append("\"");
  return text.append(">").append(content).append("</").append(name).append(">");
}

std::string heading(std::string_view text) { return element("h2", markupEscaped(text)) + "\n"; }

std::string cell(std::string_view text, const char* kind = "") {
  return element("td", markupEscaped(text), kind);
}

/// @param head of the columns; those that begin with '#' hold numbers
std::string table(const std::vector<std::string>& head, const std::string& rows) {
  std::string first;
  for (const std::string& title : head) {
    const bool numbers = title.starts_with('#');
    first += element("th", markupEscaped(numbers ? title.substr(1) : title), numbers ? "n" : "");
  }
  return "<table>\n" + element("tr", first) + "\n" + rows + "</table>\n";
}

std::string picturesOf(const std::vector<PagePicture>& pictures) {
  if (pictures.empty()) return {};
  std::string text = "<div class=\"pictures\">\n";
  for (const PagePicture& picture : pictures) {
    const auto length = static_cast<unsigned long>(picture.png.size());
    std::string base64(length / 3 * 4 + 8, '\0');
    base64.resize(
        vtkBase64Utilities::Encode(reinterpret_cast<const unsigned char*>(picture.png.data()),
                                   length, reinterpret_cast<unsigned char*>(base64.data())));
    text += "<figure><img alt=\"" + markupEscaped(picture.caption) +
            "\" src=\"data:image/png;base64," + base64 + "\">" +
            element("figcaption", markupEscaped(picture.caption)) + "</figure>\n";
  }
  return text + "</div>\n";
}

std::string volumesOf(const Json& report) {
  if (!report.contains("volumes")) return {};
  std::string rows;
  for (const Json& volume : report.at("volumes")) {
    rows += element("tr", cell(volume.at("region").get<std::string>()) +
                              cell(caseNumber(volume.at("ml"), 0), "n") +
                              cell(casePercent(volume.at("share_of_lung")), "n") +
                              cell(casePercent(volume.at("share_of_all")), "n")) +
            "\n";
  }
  return heading("Volumes") + table({"Region", "#ml", "#of its lung", "#of all"}, rows);
}

std::string limitsOf(const Json& check) {
  const std::string high = textOf(check.at("high").get<double>());
  return check.at("low").is_number() ? textOf(check.at("low").get<double>()) + " to " + high
                                     : "at most " + high;
}

std::string checksOf(const Json& report) {
  std::size_t good = 0;
  std::string failed;
  for (const Json& check : report.at("checks")) {
    if (check.at("ok").get<bool>()) {
      ++good;
      continue;
    }
    failed += element("tr", cell(check.at("of").get<std::string>()) +
                                cell(check.at("id").get<std::string>(), "bad") +
                                cell(caseNumber(check.at("value"), 3), "n") +
                                cell(limitsOf(check)) + cell(check.at("unit").get<std::string>())) +
              "\n";
  }
  const std::size_t all = report.at("checks").size();
  std::string text = heading("Checks");
  text += element("p",
                  std::to_string(good) + " of " + std::to_string(all) + " are right" +
                      (good == all ? "." : "; these are not:"),
                  good == all ? "good" : "bad");
  if (!failed.empty()) text += table({"Of", "Check", "#Value", "Limits", "Unit"}, failed);
  return text + "\n";
}

std::string airwaysOf(const Json& report) {
  if (!report.contains("airways")) return {};
  std::string rows;
  for (const Json& figure : report.at("airways").at("figures")) {
    rows += element("tr", cell(figure.at("figure").get<std::string>()) +
                              cell(figure.at("text").get<std::string>(), "n") +
                              cell(figure.at("published").get<std::string>(), "n") +
                              cell(figure.at("source").get<std::string>(), "soft")) +
            "\n";
  }
  return heading("Airways") + table({"Figure", "#Here", "#Published", "Source"}, rows);
}

std::string breathingOf(const Json& report) {
  if (!report.contains("breathing")) return {};
  const Json& breath = report.at("breathing");
  std::string rows;
  for (const Json& lung : breath.at("lungs")) {
    rows += element("tr", cell(lung.at("lung").get<std::string>()) +
                              cell(caseNumber(lung.at("rest_ml"), 0), "n") +
                              cell(caseNumber(lung.at("least_ml"), 0), "n") +
                              cell(caseNumber(lung.at("most_ml"), 0), "n")) +
            "\n";
  }
  return heading("Breathing: " + breath.at("scenario").get<std::string>()) +
         element("p", caseNumber(breath.at("tidal_ml"), 0) + " ml in " +
                          caseNumber(breath.at("period_s"), 1) + " s. " +
                          markupEscaped(breath.at("basis").get<std::string>())) +
         "\n" + table({"Lung", "#at rest, ml", "#least, ml", "#most, ml"}, rows);
}

std::string sentences(const Json& list) {
  std::string items;
  for (const Json& sentence : list)
    items += element("li", markupEscaped(sentence.get<std::string>())) + "\n";
  return items;
}

std::string methodsOf(const Json& report) {
  std::string text = heading("Methods") +
                     element("p", markupEscaped(report.at("methods").get<std::string>())) + "\n";
  if (const Json& references = report.at("references"); !references.empty()) {
    text += element("ol", sentences(references), "soft") + "\n";
  }
  return text;
}

std::string originOf(const Json& report) {
  std::string rows;
  for (const Json& input : report.at("inputs")) {
    const std::string hash = input.at("sha256").get<std::string>();
    rows += element("tr", element("td", element("code", markupEscaped(hash))) +
                              cell(input.value("path", ""))) +
            "\n";
  }
  std::string text;
  if (!rows.empty()) text += heading("Made from") + table({"SHA-256", "File"}, rows);
  if (const Json& parameters = report.at("parameters"); !parameters.empty()) {
    text += heading("Options") +
            element("p", element("code", markupEscaped(parameters.dump(
                                             -1, ' ', false, Json::error_handler_t::replace)))) +
            "\n";
  }
  return text;
}

}  // namespace

std::string casePage(const Json& report, const std::vector<PagePicture>& pictures) {
  const Json& app = report.at("app");
  const std::string version =
      app.at("version").get<std::string>() + " (" + app.at("commit").get<std::string>() + ")";
  const std::string name =
      report.at("case").is_string() ? report.at("case").get<std::string>() : "Lung report";
  std::string text = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n" +
                     element("title", markupEscaped(name)) + "\n" +
                     element("style", std::string(PageStyle).append(Style)) +
                     "</head><body>\n<header>" + element("h1", markupEscaped(name)) +
                     element("p", "Pneuma " + markupEscaped(version) +
                                      " &middot; research use only, not a medical device") +
                     "</header>\n";
  text += picturesOf(pictures);
  text += "<div class=\"columns\"><div>" + volumesOf(report) + "</div><div>" + checksOf(report) +
          "</div></div>\n";
  text += breathingOf(report) + airwaysOf(report) + methodsOf(report);
  if (const Json& warnings = report.at("warnings"); !warnings.empty()) {
    text += heading("To be aware of") + element("ul", sentences(warnings)) + "\n";
  }
  text += originOf(report);
  text += element("footer", "Lengths in mm, volumes in ml, coordinates LPS. Seed " +
                                std::to_string(report.at("seed").get<std::uint64_t>()) + ".");
  return text + "\n</body></html>\n";
}

}  // namespace pneuma
