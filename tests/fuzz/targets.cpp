#include "targets.h"

#include <cstdlib>
#include <fstream>

#include "core/error.h"
#include "io/airway_table.h"
#include "io/ct_file.h"
#include "io/fissure_file.h"
#include "io/head_pose_file.h"
#include "io/landmark_file.h"
#include "io/member_archive.h"
#include "io/multiblock_file.h"
#include "io/surface_file.h"
#include "io/text_table.h"
#include "io/tree_file.h"
#include "io/volume_file.h"
#include "pipeline/lung_edits_file.h"
#include "pipeline/measured_breath.h"
#include "pipeline/person_motion.h"
#include "pipeline/picture_list.h"
#include "pipeline/project.h"
#include "pipeline/recipe.h"

namespace pneuma::fuzz {
namespace {

namespace fs = std::filesystem;

/// A refusal that is documented is no fault; an error that says it is ours is one.
template <class Read>
void unlessRefused(const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    if (error.code() == ExitCode::Internal) throw;
  }
}

/// As intensities and as labels.
void readAsVolume(const fs::path& path) {
  unlessRefused([&] { readCt(path); });
  unlessRefused([&] { readLabelVolume(path); });
}

void readAsSurface(const fs::path& path) {
  unlessRefused([&] { readSurface(path); });
}

void readAsTree(const fs::path& path) {
  unlessRefused([&] { readTree(path); });
}

void readAsTable(const fs::path& path) {
  unlessRefused([&] { readLandmarkPairs(path); });
  unlessRefused([&] { readMeasuredBreath(path); });
  unlessRefused([&] { readHeadPoses(path); });
  unlessRefused([&] { readFissures(path); });
  unlessRefused([&] { readTextTable(path); });
}

void readAsJson(const fs::path& path) {
  unlessRefused([&] { readRecipe(path); });
  unlessRefused([&] { readFissures(path); });
  unlessRefused([&] { readPlanes(path); });
  unlessRefused([&] { readLungEdits(path); });
  unlessRefused([&] { readPersonMotion(path); });
  unlessRefused([&] { readAirwayTable(path); });
  unlessRefused([&] { readPictureList(path); });
}

/// The bytes are one member of a project that is sound otherwise: the first tells which, by its
/// place. So the archive's sums are right, and what is inside is looked at.
void readAsMember(const fs::path& path) {
  static const std::vector<ArchiveMember> sound = [] {
    const char* project = std::getenv("PNEUMA_FUZZ_PROJECT");
    if (project == nullptr) throw std::runtime_error("PNEUMA_FUZZ_PROJECT has to name a project");
    return readArchive(project);
  }();
  std::ifstream file(path, std::ios::binary);
  const int which = file.get();
  if (which == std::ifstream::traits_type::eof()) return;
  std::vector<ArchiveMember> members = sound;
  members[static_cast<std::size_t>(which) % members.size()].content.assign(
      std::istreambuf_iterator<char>(file), {});
  const fs::path archive = path.parent_path() / "member.pneuma";
  fs::remove(archive);
  writeArchive(archive, members);
  unlessRefused([&] { readProject(archive); });
}

}  // namespace

const std::vector<Target>& targets() {
  static const std::vector<Target> all = {
      {"dicom", "slice.dcm", [](const fs::path& path) { unlessRefused([&] { readCt(path); }); }},
      {"nifti", "ct.nii", readAsVolume},
      {"nrrd", "ct.nrrd", readAsVolume},
      {"mha", "ct.mha", readAsVolume},
      {"zip", "series.zip", [](const fs::path& path) { unlessRefused([&] { readCt(path); }); }},
      {"stl", "s.stl", readAsSurface},
      {"obj", "s.obj", readAsSurface},
      {"ply", "s.ply", readAsSurface},
      {"vtp", "s.vtp",
       [](const fs::path& path) {
         readAsSurface(path);
         readAsTree(path);
       }},
      {"vtu", "t.vtu", readAsTree},
      {"pvd", "breath.pvd",
       [](const fs::path& path) { unlessRefused([&] { readTimeCollection(path); }); }},
      {"swc", "t.swc", readAsTree},
      {"tree-csv", "t.csv", readAsTree},
      {"tree-json", "t.json", readAsTree},
      {"csv", "table.csv", readAsTable},
      {"json", "any.json", readAsJson},
      {"markups", "f.mrk.json",
       [](const fs::path& path) { unlessRefused([&] { readFissures(path); }); }},
      {"fcsv", "f.fcsv", [](const fs::path& path) { unlessRefused([&] { readFissures(path); }); }},
      {"pneuma", "case.pneuma",
       [](const fs::path& path) { unlessRefused([&] { readProject(path); }); }},
      {"project-member", "member", readAsMember},
  };
  return all;
}

void tryBytes(const Target& target, const fs::path& folder, std::span<const std::uint8_t> bytes) {
  const fs::path path = folder / target.file;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path.string());
  target.read(path);
}

}  // namespace pneuma::fuzz
