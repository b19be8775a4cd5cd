#include "pipeline/project.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/ct_file.h"
#include "pipeline/ct_source.h"
#include "pipeline/detail/project_steps.h"
#include "pipeline/organs.h"
#include "pipeline/report.h"

namespace pneuma {

std::string fileName(const std::filesystem::path& path) {
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

std::string textOfAggregate(const std::vector<AggregatePoint>& points) {
  MarkedMesh marked;
  for (const AggregatePoint& point : points) {
    marked.mesh.points.push_back(point.position);
    marked.ofPoints["lobe"].push_back(static_cast<std::uint8_t>(point.lobe));
  }
  return exactPly(marked);
}

std::vector<AggregatePoint> aggregateOfText(const std::string& text, const std::string& name) {
  const MarkedMesh marked = meshOfExactPly(text, name);
  const auto lobes = marked.ofPoints.find("lobe");
  if (lobes == marked.ofPoints.end()) throw InvalidInput(name + " has points of no lobe");
  std::vector<AggregatePoint> points(marked.mesh.points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = {marked.mesh.points[i], static_cast<Lobe>(lobes->second[i])};
  }
  return points;
}

namespace {

namespace fs = std::filesystem;

constexpr const char* JsonMember = "project.json";
constexpr const char* ThumbnailMember = "thumbnail.png";
constexpr std::string_view SchemaStem = "pneuma/project/";

/// The CT of a project as it stands in project.json.
struct StoredCt {
  std::string path;      ///< absolute
  std::string relative;  ///< to the folder of the project
  CtSource source;
  ImageGeometry geometry;  ///< where it is packed
  bool packed = false;
};

template <class Archive, class T>
requires Is<T, StoredCt>

void describe(Archive& archive, T& ct) {
  archive("path", ct.path);
  archive("relative", ct.relative);
  archive("series", ct.source.series);
  archive("corrections", ct.source.corrections);
  archive("bytes", ct.source.bytes);
  archive("sha256", ct.source.sha256);
  archive("packed", ct.packed);
  archive("geometry", ct.geometry);
}

StoredCt storedCt(const LungModel& model, const fs::path& folder, bool pack,
                  const Progress& progress) {
  StoredCt stored;
  stored.packed = pack;
  if (pack) stored.geometry = model.ct->geometry;
  if (!model.ctSource) return stored;
  stored.source = *model.ctSource;
  std::error_code error;
  const fs::path path = fs::absolute(stored.source.path, error);
  // One that was not found again keeps what was known of it.
  if (model.ct && (!pack || fs::exists(path, error))) {
    stored.source = hashed(std::move(stored.source), progress);
  }
  stored.path = path.string();
  stored.relative = path.lexically_proximate(fs::absolute(folder, error)).generic_string();
  return stored;
}

/// What this version does not know goes back where it was, unless that place is gone.
void addUnknown(Json& json, const Json& unknown) {
  for (const auto& [key, value] : unknown.items()) {
    if (!json.contains(key)) {
      json[key] = value;
    } else if (json[key].is_object() && value.is_object()) {
      addUnknown(json[key], value);
    }
  }
}

/// Steps up to where another CT was open, or to one that cannot be saved.
/// @param first of the steps, which is the nearest to now
template <class Iterator>
std::vector<ProjectStep> savedSteps(Iterator first, Iterator last, const CtSource* source,
                                    std::size_t most) {
  std::vector<ProjectStep> steps;
  for (auto step = first; step != last; ++step) {
    const LungModel& model = step->state.model;
    const bool otherCt = model.ctSource && model.ctSource.get() != source;
    const bool unsaved = model.regions && !model.surfaces && model.organ.empty();
    if (otherCt || unsaved || steps.size() == most) break;
    steps.push_back(*step);
  }
  return steps;
}

/// Calls edit(model) for every moment.
template <class Edit>
void everyModel(Project& project, const Edit& edit) {
  edit(project.state.model);
  for (auto* steps : {&project.undo, &project.redo}) {
    for (ProjectStep& step : *steps) edit(step.state.model);
  }
}

void requireSaved(const LungModel& model) {
  if (!model.regions || model.surfaces || !model.organ.empty()) return;
  throw Unsupported(
      "a project holds built-in organs of their own size only; save the tree as a file instead");
}

int versionOf(const Json& json, const std::string& name) {
  const std::string schema =
      json.is_object() && json.contains("schema") && json.at("schema").is_string()
          ? json.at("schema").get<std::string>()
          : "";
  const std::string number = schema.starts_with(SchemaStem) ? schema.substr(SchemaStem.size()) : "";
  const bool digits = !number.empty() && number.size() < 6 &&
                      std::ranges::all_of(number, [](char c) { return c >= '0' && c <= '9'; });
  if (!digits) throw InvalidInput(name + " is no project of Pneuma: its project.json says so");
  return std::stoi(number);
}

Json parsed(const std::string& text, const std::string& name) {
  try {
    return Json::parse(text);
  } catch (const Json::exception&) {
    throw InvalidInput(name +
                       " is damaged: its project.json cannot be read; take the one before, " +
                       "whose name ends in ~");
  }
}

/// Where the CT is now: beside the project where it was before, or where it was.
fs::path placeOf(const StoredCt& stored, const fs::path& folder) {
  std::error_code error;
  const fs::path beside = (folder / stored.relative).lexically_normal();
  return !stored.relative.empty() && fs::exists(beside, error) ? beside : fs::path(stored.path);
}

/// Reads the linked CT. Null, and says why, if it is gone or another.
std::shared_ptr<const CtImage> linkedCt(CtSource& source, std::vector<std::string>& notes,
                                        const Progress& progress) {
  const std::string named = "The CT '" + fileName(source.path) + "'";
  const std::string without = " The project was opened without it; put it ";
  std::error_code error;
  if (!fs::exists(source.path, error)) {
    notes.push_back(named + " is not where it was." + without + "back, or beside the project.");
    return nullptr;
  }
  try {
    CtSource now = source;
    now.sha256.clear();
    now = hashed(std::move(now), progress.part(0.0, 0.4, "looking whether the CT is the same"));
    if (now.sha256 != source.sha256) {
      notes.push_back(named + " is not the one that the project was made with: its content has " +
                      "changed." + without + "back as it was.");
      return nullptr;
    }
    CtFile file = readCt(source.path, source.corrections, progress.part(0.4, 1.0, "reading the CT"),
                         {source.series});
    return std::make_shared<const CtImage>(std::move(file.image));
  } catch (const Error& problem) {
    notes.push_back(named + " cannot be read: " + problem.what() + "." + without + "right.");
    return nullptr;
  }
}

/// Gives every state that had it the CT.
void putCt(Project& project, const std::shared_ptr<const CtImage>& ct,
           const std::shared_ptr<const CtSource>& source) {
  everyModel(project, [&](LungModel& model) {
    if (!model.ctSource) return;
    model.ct = ct;
    model.ctSource = source;
  });
}

fs::path absoluteFolderOf(const fs::path& path) {
  std::error_code error;
  return fs::absolute(path, error).parent_path();
}

void putRegions(LungModel& model) {
  if (!model.organ.empty()) model.regions = openOrgan(model.organ).regions;
}

}  // namespace

std::vector<ArchiveMember> projectMembers(const Project& project, const fs::path& folder,
                                          const Progress& progress) {
  const LungModel& model = project.state.model;
  requireSaved(model);
  ProjectWriter writer;
  for (const ArchiveMember& member : project.unknown.members) writer.reserve(member.name);
  if (project.unknown.fields.contains("objects")) {
    for (const auto& [id, object] : project.unknown.fields["objects"].items()) writer.reserve(id);
  }
  const Json app = {{"name", "pneuma"}, {"version", versionText()}, {"commit", commitText()}};
  const CtSource* source = model.ctSource.get();
  std::vector<ProjectStep> undo =
      savedSteps(project.undo.rbegin(), project.undo.rend(), source, MostSavedSteps);
  std::ranges::reverse(undo);
  const std::vector<ProjectStep> redo =
      savedSteps(project.redo.begin(), project.redo.end(), source, MostSavedSteps - undo.size());
  // Programs of version 1 would take what can be done again for something to keep as it is, while
  // what it refers to changes.
  writer("schema", std::string(SchemaStem) + (redo.empty() ? "1" : "2"));
  writer("app", app);
  writer("frame", std::string("LPS"));
  writer("units", std::string("mm"));
  // Where nothing tells how to read it again, its voxels are all that there is.
  const bool pack = model.ct && (project.ctStorage == CtStorage::Packed || !model.ctSource);
  std::optional<StoredCt> ct;
  if (model.ct || model.ctSource) {
    ct = storedCt(model, folder, pack, progress.part(0.0, 0.5, "hashing the CT"));
  }
  writer("ct", ct);
  if (pack) writer.file("ct_file", "ct", ".nrrd", exactNrrd(*model.ct));
  progress.report(0.6);
  writer("state", project.state);
  progress.report(0.8);
  writer("undo", undo);
  if (!redo.empty()) writer("redo", redo);
  writer("next", project.next);
  writer("view", project.view);
  std::vector<ArchiveMember> members = std::move(writer.members());
  Json json = writer.take();
  addUnknown(json, project.unknown.fields);
  members.insert(members.begin(),
                 {JsonMember, json.dump(1, ' ', false, Json::error_handler_t::replace), true});
  if (!project.thumbnail.empty()) members.push_back({ThumbnailMember, project.thumbnail, false});
  for (const ArchiveMember& member : project.unknown.members) members.push_back(member);
  progress.report(1.0);
  return members;
}

Project projectOf(std::vector<ArchiveMember> members, const fs::path& folder,
                  const std::string& name, const Progress& progress) {
  const auto named = [&](const char* wanted) {
    return std::ranges::find(members, wanted, &ArchiveMember::name);
  };
  const auto jsonMember = named(JsonMember);
  if (jsonMember == members.end()) {
    throw InvalidInput(name + " is no project of Pneuma: it holds no project.json");
  }
  Json json = parsed(jsonMember->content, name);
  members.erase(jsonMember);
  if (versionOf(json, name) > ProjectVersion) {
    throw Unsupported(name + " was saved by a newer Pneuma (its format is " +
                      std::to_string(versionOf(json, name)) + ", this program reads " +
                      std::to_string(ProjectVersion) + "); update Pneuma to open it");
  }
  Project project;
  if (const auto thumbnail = named(ThumbnailMember); thumbnail != members.end()) {
    project.thumbnail = std::move(thumbnail->content);
    members.erase(thumbnail);
  }
  for (const char* told : {"schema", "app", "frame", "units"}) json.erase(told);

  ProjectReader reader(std::move(json), std::move(members), name);
  std::optional<StoredCt> stored;
  reader("ct", stored);
  reader("state", project.state);
  reader("undo", project.undo);
  reader("redo", project.redo);
  reader("next", project.next);
  reader("view", project.view);
  progress.report(0.4);
  std::shared_ptr<const CtImage> ct;
  std::shared_ptr<const CtSource> source;
  if (stored) {
    CtSource from = stored->source;
    from.series = keptSeries(from.series);  // projects of before hold the UID
    if (!stored->path.empty()) from.path = placeOf(*stored, folder);
    if (stored->packed) {
      ct = std::make_shared<const CtImage>(
          ctOfExactNrrd(reader.file("ct_file"), stored->geometry, name));
    } else {
      ct = linkedCt(from, project.notes, progress.part(0.4, 1.0, "reading the CT"));
    }
    if (!stored->path.empty()) source = std::make_shared<const CtSource>(std::move(from));
  }
  putCt(project, ct, source);
  everyModel(project, putRegions);
  if (stored && stored->packed) project.ctStorage = CtStorage::Packed;
  project.unknown.members = reader.restOfMembers();
  project.unknown.fields = reader.rest();
  progress.report(1.0);
  return project;
}

void replaceCtSource(Project& project, const std::shared_ptr<const CtSource>& before,
                     const std::shared_ptr<const CtSource>& after) {
  everyModel(project, [&](LungModel& model) {
    if (model.ctSource == before) model.ctSource = after;
  });
}

void writeProject(const fs::path& path, const Project& project, const Progress& progress) {
  requireWritable(path);
  const auto members =
      projectMembers(project, absoluteFolderOf(path), progress.part(0.0, 0.5, "gathering"));
  writeArchive(path, members, progress.part(0.5, 1.0, "writing"));
}

Project readProject(const fs::path& path, const Progress& progress) {
  return projectOf(readArchive(path, progress.part(0.0, 0.5, "reading")), absoluteFolderOf(path),
                   "'" + path.string() + "'", progress.part(0.5, 1.0, "putting together"));
}

}  // namespace pneuma
