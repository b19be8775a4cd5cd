#include "views/case_export.h"

#include <cmath>

#include "views/breath_film.h"
#include "views/breath_gltf.h"

namespace pneuma {

ViewDirection toTenths(ViewDirection direction) {
  const auto rounded = [](double degrees) { return std::round(10.0 * degrees) / 10.0 + 0.0; };
  return {rounded(direction.azimuthDeg), rounded(direction.elevationDeg)};
}

ViewDirection savedView(const Json& view) {
  try {
    if (!view.contains("camera")) return {};
    const Json& camera = view.at("camera");
    return {camera.at("azimuth_deg").get<double>(), camera.at("elevation_deg").get<double>()};
  } catch (const Json::exception&) {
    return {};  // of a newer program
  }
}

void exportCase(const std::filesystem::path& folder, ExportPreset preset, const ProjectState& state,
                ViewDirection view, Existing existing, const Progress& progress,
                const MadeBreath& breath, const ExportFormat& format) {
  const auto write = [&](const std::filesystem::path& file, const BreathingLungs& lungs,
                         const Progress& writing) {
    if (preset == ExportPreset::Share) {
      writeBreathGltf(file, lungs, Existing::Replace, writing);
    } else {
      writeFile(file, breathFilm(lungs, toTenths(view), writing.part(0.0, 1.0, "drawing")));
    }
  };
  writePreset(folder, preset, state, existing, progress, breath, format, write);
}

}  // namespace pneuma
