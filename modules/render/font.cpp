#include "render/font.h"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include <vtkTextProperty.h>

namespace pneuma {
namespace {

std::string findFontFile() {
  std::vector<std::filesystem::path> folders = {"/usr/share/fonts", "/usr/local/share/fonts"};
  if (const char* home = std::getenv("HOME"); home != nullptr) {
    folders.emplace_back(std::filesystem::path(home) / ".local/share/fonts");
    folders.emplace_back(std::filesystem::path(home) / ".fonts");
  }
  constexpr std::array<const char*, 7> Candidates = {"opentype/inter/Inter-Medium.otf",
                                                     "truetype/inter/Inter-Medium.ttf",
                                                     "inter/Inter-Medium.otf",
                                                     "inter/Inter-Medium.ttf",
                                                     "rsms-inter-fonts/Inter-Medium.otf",
                                                     "Inter-Medium.otf",
                                                     "Inter-Medium.ttf"};
  for (const std::filesystem::path& folder : folders) {
    for (const char* candidate : Candidates) {
      std::error_code ignored;
      if (std::filesystem::is_regular_file(folder / candidate, ignored)) {
        return (folder / candidate).string();
      }
    }
  }
  return {};
}

}  // namespace

const std::string& fontFile() {
  static const std::string file = findFontFile();
  return file;
}

void setFont(vtkTextProperty* property, int pixels) {
  if (fontFile().empty()) {
    property->SetFontFamilyToArial();
  } else {
    property->SetFontFamily(VTK_FONT_FILE);
    property->SetFontFile(fontFile().c_str());
  }
  property->SetFontSize(pixels);
}

}  // namespace pneuma
