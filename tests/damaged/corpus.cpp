#include <algorithm>
#include <set>
#include <stdexcept>

#include "bytes.h"

namespace pneuma::damaged {
namespace fs = std::filesystem;

namespace {

/// The sound file of every format below the folder of seeds, and what commands take it for.
struct Seed {
  const char* name;
  const char* role;
  const char* file;
  const char* extension;
  const char* beside = "";
};

constexpr Seed Seeds[] = {
    {"stl", "surface", "surface/s.stl", ".stl"},
    {"stl-text", "surface", "surface/text.stl", ".stl"},
    {"obj", "surface", "surface/s.obj", ".obj"},
    {"ply", "surface", "surface/s.ply", ".ply"},
    {"ply-text", "surface", "surface/text.ply", ".ply"},
    {"vtp", "surface", "surface/s.vtp", ".vtp"},
    {"vtp-text", "surface", "surface/text.vtp", ".vtp"},
    {"tree-vtp", "tree grown", "tree/t.vtp", ".vtp"},
    {"central-vtp", "tree central", "chest/central.vtp", ".vtp"},
    {"vtu", "tree central", "tree/c.vtu", ".vtu"},
    {"swc", "tree central", "tree/c.swc", ".swc"},
    {"tree-csv", "tree central", "tree/c.csv", ".csv"},
    {"tree-json", "tree central", "tree/c.json", ".json"},
    {"nifti", "ct", "ct/ct.nii", ".nii"},
    {"nifti-gzip", "ct", "ct/ct.nii.gz", ".nii.gz"},
    {"nrrd", "ct", "ct/ct.nrrd", ".nrrd"},
    {"nrrd-header", "ct", "nhdr/ct.nhdr", ".nhdr", "nhdr"},
    {"mha", "ct", "ct/ct.mha", ".mha"},
    {"mhd", "ct", "mhd/ct.mhd", ".mhd", "mhd"},
    {"labels-nifti", "labels", "ct/labels.nii.gz", ".nii.gz"},
    {"labels-nrrd", "labels", "ct/labels.nrrd", ".nrrd"},
    {"dicom", "dicom", "chest/dicom/slice-0011.dcm", ".dcm", "chest/dicom"},
    {"dicom-zip", "zip", "", ".zip"},
    {"project", "project", "case.pneuma", ".pneuma"},
    {"pictured-project", "pictured", "picture.png", ".pneuma"},
    {"fissures-json", "fissures", "fissures/f.json", ".json"},
    {"planes", "planes", "fissures/planes.json", ".json"},
    {"markups", "fissures", "fissures/f.mrk.json", ".mrk.json"},
    {"fcsv", "fissures", "fissures/f.fcsv", ".fcsv"},
    {"cip", "fissures", "fissures/f.csv", ".csv"},
    {"recipe", "recipe", "recipe.json", ".json"},
    {"lung-edits", "lung-edits", "edits.json", ".json"},
    {"airway-table", "airway-table", "airways.json", ".json"},
    {"landmarks", "landmarks", "marks.csv", ".csv"},
    {"constants", "constants", "constants.json", ".json"},
    {"cases", "cases", "cases.csv", ".csv"},
    {"breath-table", "breath-table", "breath.csv", ".csv"},
    {"head-poses", "head-poses", "poses.csv", ".csv"},
    {"breath-frames", "breath-frames", "breath/breath.pvd", ".pvd", "breath"},
    {"reference", "reference", "picture.png", ".png"},
};

Bytes zipOfSlices(const fs::path& series) {
  std::vector<fs::path> slices;
  for (const auto& entry : fs::directory_iterator(series)) slices.push_back(entry.path());
  std::sort(slices.begin(), slices.end());
  std::vector<Member> members;
  for (const fs::path& slice : slices) {
    members.push_back({"series/" + slice.filename().string(), contentOf(slice)});
  }
  return zip(members);
}

/// As the window saves one: with a picture, first, as that is what file managers want.
Bytes pictured(const Bytes& project, const Bytes& picture) {
  std::vector<Member> members = unzip(project);
  members.insert(members.begin(), {"thumbnail.png", picture});
  return zip(members);
}

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

void damage(Corpus& corpus, const Format& format, const fs::path& seeds) {
  const std::string& name = format.name;
  const std::string& extension = format.extension;
  // Where a file may end early without anybody telling: rows, lines, values of a list.
  static const std::set<std::string> plain = {"obj",      "swc",       "tree-csv",     "fcsv",
                                              "cip",      "landmarks", "breath-table", "head-poses",
                                              "stl-text", "ply-text",  "dicom",        "cases"};
  damageAnyFile(corpus, format, plain.count(name) == 0);
  if (extension == ".json" || extension == ".mrk.json") damageJson(corpus, format);
  if (format.sound->compare(0, 2, "<V") == 0 && name != "breath-frames") damageXml(corpus, format);
  static const std::set<std::string> text = {
      "stl-text",     "obj",        "ply-text",     "vtp-text",     "vtu",       "swc",
      "tree-csv",     "tree-json",  "fcsv",         "cip",          "markups",   "fissures-json",
      "planes",       "recipe",     "lung-edits",   "airway-table", "landmarks", "constants",
      "breath-table", "head-poses", "breath-frames"};
  if (text.count(name) != 0) damageNumbers(corpus, format);
  if (name == "stl") damageStl(corpus, format);
  if (name == "obj") damageObj(corpus, format);
  if (extension == ".ply") damagePly(corpus, format);
  if (name == "swc") damageSwc(corpus, format);
  if (endsWith(extension, "csv")) damageTable(corpus, format);
  if (name.compare(0, 5, "nifti") == 0) damageNifti(corpus, format);
  for (const char* end : {".nrrd", ".nhdr", ".mha", ".mhd"}) {
    if (extension == end && format.role == "ct") damageHeaderLines(corpus, format);
  }
  if (name == "dicom") damageDicom(corpus, format, seeds / "chest/dicom");
  if (extension == ".zip" || extension == ".pneuma") damageZip(corpus, format);
  if (name == "project") damageProject(corpus, format);
}

}  // namespace

Corpus corpusOf(const fs::path& seeds) {
  Corpus corpus;
  for (const Seed& seed : Seeds) {
    Format format{seed.name, seed.role, seed.extension, nullptr, {}};
    if (*seed.file == '\0') {
      format.sound = std::make_shared<const Bytes>(zipOfSlices(seeds / "chest/dicom"));
    } else if (fs::exists(seeds / seed.file)) {
      format.sound = std::make_shared<const Bytes>(contentOf(seeds / seed.file));
    } else if (format.role == "reference" || format.role == "pictured") {
      continue;  // no display, no picture
    } else {
      throw std::runtime_error("there is no seed " + (seeds / seed.file).string());
    }
    if (format.role == "pictured") {
      format.sound =
          std::make_shared<const Bytes>(pictured(contentOf(seeds / "case.pneuma"), *format.sound));
    }
    if (*seed.beside != '\0') format.beside = fs::absolute(seeds / seed.beside);
    damage(corpus, format, seeds);
  }
  return corpus;
}

}  // namespace pneuma::damaged
