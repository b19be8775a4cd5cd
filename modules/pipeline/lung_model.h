#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "anatomy/airway_tree.h"
#include "anatomy/validation.h"
#include "core/progress.h"
#include "core/triangle_mesh.h"
#include "geometry/mesh_doctor.h"
#include "growth/growth.h"

namespace pneuma {

/// A file that was read, for the record.
struct InputFile {
  std::string path;
  std::string sha256;
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
  double domainSeconds = 0.0;
  double growSeconds = 0.0;
};

/// One person's lungs, everything known so far. Parts are immutable and shared: a copy is cheap, a
/// worker needs no lock, undo keeps the value before.
struct LungModel {
  std::shared_ptr<const std::vector<LobeSurface>> surfaces;  ///< null for a built-in organ
  std::shared_ptr<const std::vector<LobeRegion>> regions;    ///< null until growth needs them
  std::shared_ptr<const AirwayTree> central;                 ///< null if there are no airways yet
  std::shared_ptr<const Growth> growth;                      ///< null until grown
  std::shared_ptr<const AirwayTree> opened;  ///< a tree that was opened to be looked at
  std::vector<InputFile> inputs;
  std::vector<std::string> warnings;  ///< whole sentences for the user
  double readSeconds = 0.0;
};

/// The tree to show or to measure: grown, else opened, else central; null if there is none.
std::shared_ptr<const AirwayTree> treeOf(const LungModel& model);

/// Reads lobe surfaces: files, or folders with files whose names carry rul, rml, rll, lul, lll; or
/// one surface of any name. Every surface is examined.
/// @throws InputMissing, InvalidInput (two files for one lobe, a surface not fit to grow in, units)
LungModel openLobes(std::span<const std::filesystem::path> paths, const Progress& progress = {});

/// The same with a central tree read from `path` added.
LungModel withCentral(const LungModel& model, const std::filesystem::path& path);

/// What a person drops on the window: surfaces, folders and trees in any order. Trees with grown
/// branches become `opened`, others `central`.
LungModel openFiles(std::span<const std::filesystem::path> paths, const Progress& progress = {});

/// Names of the built-in organs ("right-lung").
std::span<const std::string_view> organNames();

/// A built-in organ as a model that can be grown in. @throws InvalidOption for an unknown name
LungModel openOrgan(std::string_view name);

/// Grows a tree: builds regions and template airways where they are missing, grows, checks.
/// Returns a new model with the growth replaced. @throws as growAirways()
LungModel grow(const LungModel& model, const GrowthOptions& options, const Progress& progress = {});

}  // namespace pneuma
