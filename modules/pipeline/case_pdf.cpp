#include "pipeline/case_pdf.h"

#include <algorithm>
#include <array>
#include <memory>

#include <hpdf.h>

#include "core/error.h"
#include "pipeline/detail/case_text.h"

namespace pneuma {
namespace {

// Points of 1/72 inch, from the lower left corner of an A4 sheet.
constexpr float SheetWidth = 595.0F;
constexpr float SheetHeight = 842.0F;
constexpr float Margin = 42.0F;
constexpr float Gutter = 20.0F;
constexpr float ColumnWidth = (SheetWidth - 2.0F * Margin - Gutter) / 2.0F;
constexpr float TextSize = 8.0F;
constexpr float LineHeight = 10.6F;

/// As the sheet's fonts have it: what is not Latin becomes a question mark.
std::string latin(std::string_view utf8) {
  std::string text;
  for (std::size_t n = 0; n < utf8.size(); ++n) {
    const auto c = static_cast<unsigned char>(utf8[n]);
    if (c < 0x80) {
      text += utf8[n];
    } else if ((c == 0xc2 || c == 0xc3) && n + 1 < utf8.size()) {
      const auto next = static_cast<unsigned char>(utf8[++n]);
      text += static_cast<char>((c == 0xc3 ? 0x40U : 0x00U) + next);
    } else if (c >= 0xc0) {
      text += '?';
    }
  }
  return text;
}

void ignored(HPDF_STATUS, HPDF_STATUS, void*) {}  // asked for once, at the end

/// A document with its two fonts.
class Sheets {
 public:
  Sheets() : document_(HPDF_New(ignored, nullptr)) {
    if (!document_) throw Error(ExitCode::OutOfMemory, "there is no memory for a PDF");
    HPDF_SetCompressionMode(document_.get(), HPDF_COMP_ALL);
    plain = HPDF_GetFont(document_.get(), "Helvetica", "WinAnsiEncoding");
    bold = HPDF_GetFont(document_.get(), "Helvetica-Bold", "WinAnsiEncoding");
  }

  HPDF_Page add() {
    HPDF_Page page = HPDF_AddPage(document_.get());
    HPDF_Page_SetSize(page, HPDF_PAGE_SIZE_A4, HPDF_PAGE_PORTRAIT);
    pages_.push_back(page);
    return page;
  }

  HPDF_Page page(std::size_t n) {
    while (n >= pages_.size()) add();
    return pages_[n];
  }

  HPDF_Image image(const std::string& png) {
    return HPDF_LoadPngImageFromMem(document_.get(), reinterpret_cast<const HPDF_BYTE*>(png.data()),
                                    static_cast<HPDF_UINT>(png.size()));
  }

  void setTitle(const std::string& title) {
    HPDF_SetInfoAttr(document_.get(), HPDF_INFO_TITLE, title.c_str());
    HPDF_SetInfoAttr(document_.get(), HPDF_INFO_CREATOR, "Pneuma");
  }

  std::string take() {
    HPDF_SaveToStream(document_.get());
    const HPDF_STATUS status = HPDF_GetError(document_.get());
    std::string content(HPDF_GetStreamSize(document_.get()), '\0');
    auto size = static_cast<HPDF_UINT32>(content.size());
    HPDF_ReadFromStream(document_.get(), reinterpret_cast<HPDF_BYTE*>(content.data()), &size);
    if (status != HPDF_OK || size != content.size() || content.empty()) {
      throw OutputFailed("the PDF could not be made (error " + std::to_string(status) +
                         "); write the report as .html");
    }
    return content;
  }

  HPDF_Font plain = nullptr;
  HPDF_Font bold = nullptr;

 private:
  struct Freed {
    void operator()(HPDF_Doc document) const { HPDF_Free(document); }
  };

  std::unique_ptr<std::remove_pointer_t<HPDF_Doc>, Freed> document_;
  std::vector<HPDF_Page> pages_;
};

enum class Ink { Black, Grey, Green, Red };

void setInk(HPDF_Page page, Ink ink) {
  constexpr std::array<std::array<float, 3>, 4> Inks = {
      {{0.11F, 0.15F, 0.19F}, {0.36F, 0.42F, 0.47F}, {0.12F, 0.48F, 0.3F}, {0.7F, 0.21F, 0.11F}}};
  const auto& [r, g, b] = Inks[static_cast<std::size_t>(ink)];
  HPDF_Page_SetRGBFill(page, r, g, b);
}

/// A column of text that goes on in the same place of the next page.
class Column {
 public:
  Column(Sheets& sheets, float left, float top) : sheets_(sheets), left_(left), y_(top) {}

  void title(const std::string& text) {
    need(2.6F * LineHeight);
    y_ -= 0.7F * LineHeight;
    line(text, sheets_.bold, 10.0F, Ink::Black);
    y_ -= 2.0F;
  }

  void paragraph(const std::string& text, Ink ink = Ink::Black, float indent = 0.0F) {
    std::string row;
    std::string rest = latin(text) + " ";
    for (std::size_t space = rest.find(' '); space != std::string::npos; space = rest.find(' ')) {
      const std::string word = rest.substr(0, space);
      rest.erase(0, space + 1);
      const std::string longer = row.empty() ? word : row + " " + word;
      if (!row.empty() && width(longer, sheets_.plain) > ColumnWidth - indent) {
        put(row, ink, indent);
        row = word;
      } else {
        row = longer;
      }
    }
    if (!row.empty()) put(row, ink, indent);
  }

  /// The first cell flush left, the others flush right at their ends, shares of the width.
  void row(const std::vector<std::string>& cells, const std::vector<float>& ends,
           bool head = false) {
    need(LineHeight);
    HPDF_Font font = head ? sheets_.bold : sheets_.plain;
    for (std::size_t n = 0; n < cells.size(); ++n) {
      const std::string text = latin(cells[n]);
      const float x = n == 0 ? left_ : left_ + ends[n] * ColumnWidth - width(text, font);
      write(text, font, TextSize, x, Ink::Black);
    }
    y_ -= LineHeight;
    rule(y_ + LineHeight - 2.6F, head ? 0.6F : 0.25F);
  }

 private:
  void need(float height) {
    if (y_ - height > Margin) return;
    ++page_;
    y_ = SheetHeight - Margin;
  }

  float width(const std::string& text, HPDF_Font font) {
    HPDF_Page page = sheets_.page(page_);
    HPDF_Page_SetFontAndSize(page, font, TextSize);
    return HPDF_Page_TextWidth(page, text.c_str());
  }

  void write(const std::string& text, HPDF_Font font, float size, float x, Ink ink) {
    HPDF_Page page = sheets_.page(page_);
    HPDF_Page_BeginText(page);
    HPDF_Page_SetFontAndSize(page, font, size);
    setInk(page, ink);
    HPDF_Page_TextOut(page, x, y_, text.c_str());
    HPDF_Page_EndText(page);
  }

  void line(const std::string& text, HPDF_Font font, float size, Ink ink) {
    write(latin(text), font, size, left_, ink);
    y_ -= LineHeight;
  }

  void put(const std::string& text, Ink ink, float indent) {
    need(LineHeight);
    write(text, sheets_.plain, TextSize, left_ + indent, ink);
    y_ -= LineHeight;
  }

  void rule(float y, float thickness) {
    HPDF_Page page = sheets_.page(page_);
    HPDF_Page_SetLineWidth(page, thickness);
    HPDF_Page_SetRGBStroke(page, 0.6F, 0.65F, 0.7F);
    HPDF_Page_MoveTo(page, left_, y);
    HPDF_Page_LineTo(page, left_ + ColumnWidth, y);
    HPDF_Page_Stroke(page);
  }

  Sheets& sheets_;
  float left_;
  float y_;
  std::size_t page_ = 0;
};

/// Title, line of versions and pictures. @returns where columns begin
float head(Sheets& sheets, const std::string& title, const std::string& below,
           const std::vector<PagePicture>& pictures) {
  HPDF_Page page = sheets.page(0);
  float y = SheetHeight - Margin - 12.0F;
  const auto text = [&](const std::string& what, HPDF_Font font, float size, float x, Ink ink) {
    HPDF_Page_BeginText(page);
    HPDF_Page_SetFontAndSize(page, font, size);
    setInk(page, ink);
    HPDF_Page_TextOut(page, x, y, latin(what).c_str());
    HPDF_Page_EndText(page);
  };
  text(title, sheets.bold, 17.0F, Margin, Ink::Black);
  y -= 15.0F;
  text(below, sheets.plain, TextSize, Margin, Ink::Grey);
  y -= 10.0F;
  if (pictures.empty()) return y;
  constexpr float Space = 8.0F;
  const auto count = static_cast<float>(pictures.size());
  const float side = (SheetWidth - 2.0F * Margin - (count - 1.0F) * Space) / count;
  y -= side;
  float x = Margin;
  for (const PagePicture& picture : pictures) {
    HPDF_Page_DrawImage(page, sheets.image(picture.png), x, y, side, side);
    x += side + Space;
  }
  y -= 9.0F;
  x = Margin;
  for (const PagePicture& picture : pictures) {
    text(picture.caption, sheets.plain, 7.0F, x, Ink::Grey);
    x += side + Space;
  }
  return y - 4.0F;
}

void addVolumes(const Json& report, Column& column) {
  if (!report.contains("volumes")) return;
  const std::vector<float> ends = {0.0F, 0.6F, 0.8F, 1.0F};
  column.title("Volumes");
  column.row({"Region", "ml", "of its lung", "of all"}, ends, true);
  for (const Json& volume : report.at("volumes")) {
    column.row({volume.at("region").get<std::string>(), caseNumber(volume.at("ml"), 0),
                casePercent(volume.at("share_of_lung")), casePercent(volume.at("share_of_all"))},
               ends);
  }
}

void addChecks(const Json& report, Column& column) {
  const Json& checks = report.at("checks");
  const auto good = std::ranges::count_if(
      checks, [](const Json& check) { return check.at("ok").template get<bool>(); });
  const bool all = good == static_cast<std::ptrdiff_t>(checks.size());
  column.title("Checks");
  column.paragraph(std::to_string(good) + " of " + std::to_string(checks.size()) + " are right" +
                       (all ? "." : "; these are not:"),
                   all ? Ink::Green : Ink::Red);
  for (const Json& check : checks) {
    if (check.at("ok").get<bool>()) continue;
    column.paragraph(
        check.at("of").get<std::string>() + ", " + check.at("id").get<std::string>() + ": " +
            caseNumber(check.at("value"), 3) + ", limit " +
            (check.at("low").is_number() ? caseNumber(check.at("low"), 3) + " to " : "") +
            caseNumber(check.at("high"), 3) + " " + check.at("unit").get<std::string>(),
        Ink::Red);
  }
}

void addBreath(const Json& report, Column& column) {
  if (!report.contains("breathing")) return;
  const Json& breath = report.at("breathing");
  const std::vector<float> ends = {0.0F, 0.5F, 0.75F, 1.0F};
  column.title("Breathing: " + breath.at("scenario").get<std::string>());
  column.paragraph(caseNumber(breath.at("tidal_ml"), 0, " ml in ") +
                   caseNumber(breath.at("period_s"), 1, " s. ") +
                   breath.at("basis").get<std::string>());
  column.row({"Lung", "at rest, ml", "least, ml", "most, ml"}, ends, true);
  for (const Json& lung : breath.at("lungs")) {
    column.row({lung.at("lung").get<std::string>(), caseNumber(lung.at("rest_ml"), 0),
                caseNumber(lung.at("least_ml"), 0), caseNumber(lung.at("most_ml"), 0)},
               ends);
  }
}

void addAirways(const Json& report, Column& column) {
  if (!report.contains("airways")) return;
  const std::vector<float> ends = {0.0F, 0.7F, 1.0F};
  column.title("Airways");
  column.row({"Figure", "here", "published"}, ends, true);
  for (const Json& figure : report.at("airways").at("figures")) {
    column.row({figure.at("figure").get<std::string>(), figure.at("text").get<std::string>(),
                figure.at("published").get<std::string>()},
               ends);
  }
}

void addMethods(const Json& report, Column& column) {
  column.title("Methods");
  column.paragraph(report.at("methods").get<std::string>());
  std::size_t n = 0;
  for (const Json& reference : report.at("references")) {
    column.paragraph("[" + std::to_string(++n) + "] " + reference.get<std::string>(), Ink::Grey);
  }
}

void addWarnings(const Json& report, Column& column) {
  if (report.at("warnings").empty()) return;
  column.title("To be aware of");
  for (const Json& warning : report.at("warnings")) {
    column.paragraph(warning.get<std::string>());
  }
}

void addInputs(const Json& report, Column& column) {
  if (report.at("inputs").empty()) return;
  column.title("Made from");
  for (const Json& input : report.at("inputs")) {
    const std::string path = input.value("path", "");
    if (!path.empty()) column.paragraph(path);
    column.paragraph("SHA-256 " + input.at("sha256").get<std::string>().substr(0, 32) + "...",
                     Ink::Grey);
  }
}

}  // namespace

std::string casePdf(const Json& report, const std::vector<PagePicture>& pictures) {
  Sheets sheets;
  const Json& app = report.at("app");
  const std::string title =
      report.at("case").is_string() ? report.at("case").get<std::string>() : "Lung report";
  sheets.setTitle(latin(title));
  const float top = head(sheets, title,
                         "Pneuma " + app.at("version").get<std::string>() + " (" +
                             app.at("commit").get<std::string>() +
                             "), research use only, not a medical device. Lengths in mm, "
                             "coordinates LPS, seed " +
                             std::to_string(report.at("seed").get<std::uint64_t>()) + ".",
                         pictures);
  Column left(sheets, Margin, top);
  addVolumes(report, left);
  addChecks(report, left);
  addBreath(report, left);
  addMethods(report, left);
  addWarnings(report, left);
  Column right(sheets, Margin + ColumnWidth + Gutter, top);
  addAirways(report, right);
  addInputs(report, right);
  return sheets.take();
}

}  // namespace pneuma
