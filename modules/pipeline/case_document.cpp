#include "pipeline/case_document.h"

#include "core/error.h"
#include "pipeline/case_pdf.h"

namespace pneuma {

void requireCaseDocumentName(const std::filesystem::path& path) {
  const std::filesystem::path kind = path.extension();
  if (kind == ".html" || kind == ".json" || kind == ".pdf") return;
  throw Unsupported("reports are written as .html, .pdf and .json; '" + path.string() +
                    "' ends otherwise");
}

bool hasPictures(const std::filesystem::path& path) { return path.extension() != ".json"; }

std::string caseDocument(const std::filesystem::path& path, const Json& report,
                         const std::vector<PagePicture>& pictures) {
  requireCaseDocumentName(path);
  const std::filesystem::path kind = path.extension();
  if (kind == ".json") {
    return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  }
  return kind == ".pdf" ? casePdf(report, pictures) : casePage(report, pictures);
}

}  // namespace pneuma
