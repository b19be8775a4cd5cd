#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "anatomy/airway_tree.h"
#include "anatomy/efficiency.h"
#include "anatomy/validation.h"
#include "core/image.h"
#include "core/progress.h"
#include "core/triangle_mesh.h"
#include "geometry/mesh_doctor.h"
#include "growth/growth.h"
#include "io/ct_corrections.h"
#include "segmentation/lung_segmentation.h"

namespace pneuma {

struct LobesOfLungs;
struct LungCorrections;

/// A file that was read, for the record.
struct InputFile {
  std::string path;
  std::string sha256;
};

/// The file's path and hash. @throws InputMissing, Cancelled
InputFile inputFile(const std::filesystem::path& path, const Progress& progress = {});

/// Where a CT came from, so that it can be read again.
struct CtSource {
  std::filesystem::path path;
  CtCorrections corrections;
  std::string series;       ///< SeriesChoice::wanted
  std::uint64_t bytes = 0;  ///< of its files; 0 until somebody asked
  std::string sha256;       ///< of their content; empty likewise
};

/// A lobe's (or lung's) closed surface.
struct LobeSurface {
  Lobe lobe = Lobe::Whole;
  std::string name;  ///< file name, or the organ's name
  std::shared_ptr<const TriangleMesh> mesh;
  MeshReport health;
};

/// Where a grown tree came from and how long it took.
struct Growth {
  GrowthOptions options;
  GrowthResult result;
  Outside outside;
  Efficiency efficiency;
  double domainSeconds = 0.0;
  double growSeconds = 0.0;
};

/// One person's lungs, everything known so far. Parts are immutable and shared: a copy is cheap, a
/// worker needs no lock, undo keeps the value before.
struct LungModel {
  std::shared_ptr<const CtImage> ct;              ///< null where no CT is open
  std::shared_ptr<const CtSource> ctSource;       ///< of the CT, also where it was not found again
  std::shared_ptr<const LabelImage> labels;       ///< lungs and airways in it; null until found
  std::shared_ptr<const LungSegmentation> lungs;  ///< how they were found; null if labels were read
  std::shared_ptr<const LungCorrections> corrections;  ///< by hand, of labels and lungs; null: none
  std::shared_ptr<const std::vector<LobeSurface>> surfaces;  ///< null for a built-in organ
  std::shared_ptr<const std::vector<LobeSurface>>
      wholeLungs;                                          ///< what `surfaces` were before they
                                                           ///< were split; null if they were not
  std::shared_ptr<const LobesOfLungs> lobes;               ///< how they were split; null likewise
  std::shared_ptr<const std::vector<LobeRegion>> regions;  ///< null until growth needs them
  std::string organ;  ///< whose regions they are, by its name; empty if not of a built-in organ's
                      ///< own size
  std::shared_ptr<const AirwayTree> central;  ///< null if there are no airways yet
  std::shared_ptr<const Growth> growth;       ///< null until grown
  std::shared_ptr<const AirwayTree> opened;   ///< a tree that was opened to be looked at
  EfficiencyCubes cubes;                      ///< in which the paper's C_n is counted
  std::vector<InputFile> inputs;
  std::vector<std::string> warnings;  ///< whole sentences for the user
  double readSeconds = 0.0;
};

/// The tree to show or to measure: grown, else opened, else central; null if there is none.
std::shared_ptr<const AirwayTree> treeOf(const LungModel& model);

/// @throws InvalidInput if an examined surface is larger than 10 m: then it is in other units
void requireOrganSize(const LobeSurface& surface);

/// Reads lobe surfaces: files, or folders with files whose names carry rul, rml, rll, lul, lll; or
/// one surface of any name. Every surface is examined. Or a project alone.
/// @throws InputMissing, InvalidInput (two files for one lobe, a surface not fit to grow in, units)
LungModel openLobes(std::span<const std::filesystem::path> paths, const Progress& progress = {});

/// The same with a central tree read from `path` added.
LungModel withCentral(const LungModel& model, const std::filesystem::path& path);

/// @throws InvalidInput if the model's labels lie elsewhere than its CT
void requireSamePlace(const LungModel& model);

/// Adds a warning if the model's labels hardly fit its CT (pipeline/label_fit.h).
void warnOfMisfit(LungModel& model);

/// The same with a label image of the CT read from `path`.
/// @throws as readLabelVolume() and requireSamePlace()
LungModel withLabels(const LungModel& model, const std::filesystem::path& path,
                     const Progress& progress = {});

/// What a person drops on the window: a CT, its labels (a volume of single bytes), surfaces,
/// folders and trees in any order. Trees with grown branches become `opened`, others `central`. Or
/// a project alone.
LungModel openFiles(std::span<const std::filesystem::path> paths, const Progress& progress = {});

/// The seed of everything random in a growth.
std::uint64_t seedOf(const GrowthOptions& options);
GrowthOptions withSeed(GrowthOptions options, std::uint64_t seed);

/// The same with regions and template airways where they are missing.
/// @throws InvalidInput if there is no lobe, or a surface is not fit to grow in
LungModel readyToGrow(const LungModel& model);

/// Grows a tree: makes the model ready, leads central airways into lobes that they end before (with
/// a warning in the result), grows, checks, finds the efficiency.
/// Returns a new model with the growth replaced. @throws as growAirways()
LungModel grow(const LungModel& model, const GrowthOptions& options, const Progress& progress = {});

}  // namespace pneuma
