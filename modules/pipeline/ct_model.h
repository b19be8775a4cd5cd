#pragma once

#include <filesystem>
#include <span>

#include "io/ct_file.h"
#include "pipeline/lung_model.h"
#include "segmentation/label_surface.h"

namespace pneuma {

/// A model with a CT and what was noticed while reading it.
/// @throws as readCt()
LungModel openCt(const std::filesystem::path& path, const CtCorrections& corrections = {},
                 const Progress& progress = {}, const SeriesChoice& choice = {});

/// How openFiles() reads a CT.
struct CtReading {
  CtCorrections corrections;
  SeriesChoice series;
};

/// What a person drops on the window, with a CT read as is said.
/// @throws as openFiles()
LungModel openFiles(std::span<const std::filesystem::path> paths, const CtReading& reading,
                    const Progress& progress = {});

/// What was read, for a report: a file's hash, or one over the hashes of a series' files in the
/// order of its slices. Every byte is read once more. @throws InputMissing, Cancelled
InputFile ctInput(const std::filesystem::path& path, const CtFile& file,
                  const Progress& progress = {});

/// The same with the CT that its lungs were found in, and their labels.
/// @param ct as openCt() gave it
/// @param labels a file; empty: they are found again
/// @throws as withLabels() and withLungs()
LungModel withCt(const LungModel& model, const LungModel& ct, const std::filesystem::path& labels,
                 const Progress& progress = {});

/// The model of a CT that was read already. @param source how, for the record
LungModel modelOf(CtFile file, CtSource source);

/// The same with lungs and central airways found in its CT. What was grown before is gone.
/// @throws InvalidInput if there is no CT; as segmentLungs()
LungModel withLungs(const LungModel& model, const LungOptions& options = {},
                    const Progress& progress = {});

/// The same with the closed surfaces of the lungs in its labels, to grow in or to split.
/// @throws InvalidInput if there are no labels of lungs; as labelSurface()
LungModel withSurfaces(const LungModel& model, const SurfaceOptions& options = {},
                       const Progress& progress = {});

}  // namespace pneuma
