#include "pipeline/lobe_files.h"

#include <cctype>
#include <string>

#include "io/multiblock_file.h"
#include "io/surface_file.h"
#include "io/volume_file.h"

namespace pneuma {

std::filesystem::path lobeFile(Lobe lobe) {
  std::string name(shortName(lobe));
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name + ".vtp";
}

std::filesystem::path patchFile(Fissure fissure) {
  return std::filesystem::path("fissures") / (std::string(shortName(fissure)) + ".vtp");
}

std::vector<std::filesystem::path> lobeOutputs(const LungModel& model, const LobeInputs& inputs) {
  std::vector<Side> sides;
  for (const LobeSurface& surface : *model.surfaces) {
    if (surface.lobe == Lobe::RightLung || surface.lobe == Lobe::LeftLung) {
      sides.push_back(side(surface.lobe));
    }
  }
  return lobeOutputs(sides, inputs);
}

std::vector<std::filesystem::path> lobeOutputs(const std::vector<Side>& sides,
                                               const LobeInputs& inputs) {
  std::vector<std::filesystem::path> files;
  for (const Side of : sides) {
    for (const Lobe lobe : lobesOf(of)) files.push_back(lobeFile(lobe));
    for (const Fissure fissure : fissuresOf(of)) files.push_back(patchFile(fissure));
  }
  for (const char* name : {LobesTogetherFile, LobeLabelsFile, LobesReportFile}) {
    files.emplace_back(name);
  }
  if (!inputs.given.empty() || !inputs.accessory.empty()) files.emplace_back(FissurePointsFile);
  for (const auto& part : partedLobeFiles(inputs.accessory)) files.push_back(part);
  return files;
}

void writeLobes(const std::filesystem::path& folder, const LobesOfLungs& lobes,
                const LabelImage& labels, const LobeInputs& inputs, const Json& report,
                const Progress& progress) {
  std::vector<Block> blocks;
  for (const SplitLung& lung : lobes.lungs) {
    for (const Lobe lobe : lobesOf(lung.side)) {
      writeSurface(folder / lobeFile(lobe),
                   surfaceOf(lung.complex, static_cast<RegionId>(lobe)).mesh);
      blocks.push_back({std::string(shortName(lobe)), {lobeFile(lobe)}});
      progress.throwIfStopped();
    }
  }
  for (const SplitLung& lung : lobes.lungs) {
    for (const Fissure fissure : fissuresOf(lung.side)) {
      TriangleMarks marks;
      const auto complete = lobes.complete.find(fissure);
      if (complete != lobes.complete.end()) marks["on_fissure"] = complete->second.onSheet;
      writeSurface(folder / patchFile(fissure), fissurePatch(lung, fissure), {}, marks);
      blocks.push_back({std::string(shortName(fissure)), {patchFile(fissure)}});
      progress.throwIfStopped();
    }
  }
  writeMultiblock(folder / LobesTogetherFile, blocks);
  writeVolume(folder / LobeLabelsFile, labels, Existing::Replace, progress);
  writePartedLobes(folder, lobes.parted);
  if (!inputs.given.empty() || !inputs.accessory.empty()) {
    writeFissures(folder / FissurePointsFile, inputs.given, inputs.accessory);
  }
  writeFile(folder / LobesReportFile,
            report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace pneuma
