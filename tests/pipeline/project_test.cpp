// Projects: everything that was saved comes back to the bit; what cannot be opened is said.
#include "pipeline/project.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/temp_folder.h"
#include "io/volume_file.h"
#include "pipeline/ct_model.h"
#include "pipeline/lobes_model.h"
#include "pipeline/organs.h"
#include "pipeline/sample_chest.h"
#include "pipeline/whole_lungs.h"

namespace pneuma {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::TempFolder;

CtImage smallCt() {
  CtImage ct;
  ct.geometry.size = {7, 6, 5};
  ct.geometry.spacing = {0.7, 0.7, 1.0 / 3.0};
  ct.geometry.origin = {-100.1, 0.3, 7.0};
  for (int i = 0; i < 7 * 6 * 5; ++i) ct.voxels.push_back(static_cast<std::int16_t>(13 * i - 1000));
  return ct;
}

/// The sample's lungs in lobes, fissures that were edited by every method, a grown tree, a breath.
Project everything() {
  static const LungModel grown = [] {
    const SampleChest sample = sampleChest(6.0);
    LungModel model;
    model.surfaces = std::make_shared<const std::vector<LobeSurface>>(sample.lobes);
    model = withLobes(withWholeLungs(model, {}, 6.0), {});
    model.central = std::make_shared<const AirwayTree>(sample.central);
    DlaOptions options;
    options.terminals = 150;
    model = grow(model, options);
    auto lungs = std::make_shared<LungSegmentation>();
    lungs->labels.geometry = smallCt().geometry;
    lungs->labels.voxels.assign(7 * 6 * 5, 10);
    lungs->central = sample.central;
    lungs->right.volumeMl = 0.1 + 0.2;
    lungs->airways.leaksUndone = 3;
    lungs->names.carina = Vec3(0.1, 0.2, 0.3);
    lungs->names.rightMain = 1;
    lungs->checks = {{"LUNG-R-VOLUME", "volume", 1.0, 2.0, INFINITY, "ml", "look"}};
    model.lungs = lungs;
    model.labels = {model.lungs, &model.lungs->labels};
    model.central = {model.lungs, &model.lungs->central};
    model.inputs = {{"/data/DOE^JANE/lobes/rul.stl", "abc"}};
    model.warnings = {"One \"warning\" with \xc3\xa4."};
    model.readSeconds = 0.3;
    return model;
  }();
  Project project;
  ProjectState& state = project.state;
  state.name = "rul.stl";
  state.model = grown;
  state.lungOptions.thresholdHu = -432.1;
  auto given = std::make_shared<GivenFissure>();
  given->equation = FissureEquation{{1, 2, 3}, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}};
  given->patch = FissurePatch{"/data/DOE^JANE/patch.vtp", grown.surfaces->front().mesh, {}};
  FissureEdit& points = state.lobeEdits.fissures[Fissure::RightOblique];
  points.points = {{0.1, 0.2, 0.3}, {1e-17, -5.5, 7}};
  points.weights = {1.0, 2.5};
  FissureEdit& plane = state.lobeEdits.fissures[Fissure::LeftOblique];
  plane.method = FissureMethod::Plane;
  plane.handles = {{Vec3(1, 2, 3), Vec3(4, 5, 6.1), Vec3(7, 8, 9)}};
  plane.read = given;
  state.lobeEdits.options.smoothness = 0.37;
  state.lobeEdits.shares[Side::Left] = {0.45, 0.55};
  state.splitEdits = state.lobeEdits;
  state.reviews[Fissure::LeftOblique] = {state.lobeEdits, true};
  state.grownIn = grown.surfaces;
  state.breath.emplace();
  state.breath->scenario = Breathing::Copd;
  state.breath->tidalMl = 512.3;
  state.breath->regions = {{Lobe::Whole, {1, 2, 3}, 15.5, 5.0}};
  auto fit = std::make_shared<BreathFit>();
  fit->compliance = 0.1234567890123456789;
  fit->cycle.samples = {{0.1, 0.2, 0.3, 0.4}};
  state.breath->fit = fit;
  auto person = std::make_shared<PersonMotion>();
  person->name = "'/people/doe/person.json'";
  person->kind = FormKind::Quiet;
  std::vector<double> constants(constantCount(FormKind::Quiet), 0.1);
  constants[3] = -0.25;
  person->form = formOf(FormKind::Quiet, constants);
  person->strain = {{Side::Left, 0.1}};
  state.breath->person = person;
  for (const GrowthMethod& method : growthMethods()) project.next.growth.push_back(method.defaults);
  project.next.method = 1;
  project.next.breathe.frames = 33;
  project.view["camera"]["azimuth"] = 0.1;
  project.thumbnail = "PNG";
  ProjectStep before{"grow airways", state};
  before.state.model.growth = nullptr;
  project.undo.push_back(before);
  return project;
}

void expectSame(const std::vector<ArchiveMember>& a, const std::vector<ArchiveMember>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_TRUE(a[i].content == b[i].content) << a[i].name;
  }
}

void expectSame(const AirwayTree& a, const AirwayTree& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].parent, b[i].parent);
    EXPECT_EQ(a[i].proximal, b[i].proximal);
    EXPECT_EQ(a[i].distal, b[i].distal);
    EXPECT_EQ(a[i].radiusMm, b[i].radiusMm);
    EXPECT_EQ(a[i].lobe, b[i].lobe);
    EXPECT_EQ(a[i].origin, b[i].origin);
    EXPECT_EQ(a[i].ending, b[i].ending);
    EXPECT_EQ(a[i].suppliedMl, b[i].suppliedMl);
    EXPECT_EQ(a[i].via.size(), b[i].via.size());
  }
}

void expectSame(const std::vector<LobeSurface>& a, const std::vector<LobeSurface>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].lobe, b[i].lobe);
    EXPECT_EQ(a[i].mesh->points, b[i].mesh->points);
    EXPECT_EQ(a[i].mesh->triangles, b[i].mesh->triangles);
    EXPECT_EQ(a[i].health.volumeMl, b[i].health.volumeMl);
    EXPECT_EQ(a[i].health.box.max(), b[i].health.box.max());
  }
}

Json jsonIn(const std::filesystem::path& path) {
  return Json::parse(readArchive(path).front().content);
}

std::string sentenceOf(const std::filesystem::path& path, ExitCode code) {
  try {
    readProject(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  return "was opened";
}

TEST(Project, ComesBackAsItWas) {
  const TempFolder folder;
  const Project saved = everything();
  writeProject(folder / "case.pneuma", saved);
  const Project opened = readProject(folder / "case.pneuma");
  EXPECT_TRUE(opened.notes.empty());
  const LungModel& a = saved.state.model;
  const LungModel& b = opened.state.model;
  expectSame(*a.surfaces, *b.surfaces);
  expectSame(*a.wholeLungs, *b.wholeLungs);
  expectSame(*treeOf(a), *treeOf(b));
  expectSame(*a.central, *b.central);
  EXPECT_EQ(a.labels->voxels, b.labels->voxels);
  EXPECT_EQ(a.labels->geometry, b.labels->geometry);
  ASSERT_EQ(a.lobes->lungs.size(), b.lobes->lungs.size());
  EXPECT_EQ(a.lobes->lungs[0].complex.points, b.lobes->lungs[0].complex.points);
  EXPECT_EQ(a.lobes->lobeMm3, b.lobes->lobeMm3);
  EXPECT_EQ(a.growth->result.aggregate.size(), b.growth->result.aggregate.size());
  EXPECT_EQ(a.growth->result.figures, b.growth->result.figures);
  EXPECT_TRUE(a.growth->options == b.growth->options);
  EXPECT_EQ(b.lungs->right.volumeMl, 0.1 + 0.2);
  EXPECT_EQ(b.lungs->names.rightMain, 1U);
  EXPECT_EQ(b.lungs->checks[0].high, INFINITY);
  EXPECT_EQ(a.warnings, b.warnings);
  // What was one thing is one thing, and so counts as unchanged.
  EXPECT_EQ(b.labels.get(), &b.lungs->labels);
  EXPECT_EQ(b.central.get(), &b.lungs->central);
  EXPECT_EQ(opened.state.grownIn, b.surfaces);
  EXPECT_TRUE(opened.state.splitEdits == opened.state.lobeEdits);
  EXPECT_EQ(opened.undo[0].state.model.surfaces, b.surfaces);
  EXPECT_EQ(opened.undo[0].state.model.growth, nullptr);
  EXPECT_EQ(opened.state.reviews.at(Fissure::LeftOblique),
            (FissureReview{opened.state.lobeEdits, true}));
  const auto& edit = opened.state.lobeEdits.fissures.at(Fissure::LeftOblique);
  EXPECT_EQ(edit.handles, saved.state.lobeEdits.fissures.at(Fissure::LeftOblique).handles);
  EXPECT_EQ(edit.read->equation->coefficients[5], 0.6);
  EXPECT_EQ(edit.read->patch->mesh, b.surfaces->front().mesh);
  EXPECT_EQ(opened.state.lungOptions, saved.state.lungOptions);
  EXPECT_EQ(opened.state.breath->tidalMl, 512.3);
  EXPECT_EQ(opened.state.breath->regions, saved.state.breath->regions);
  EXPECT_EQ(opened.state.breath->fit->compliance, saved.state.breath->fit->compliance);
  const PersonMotion& person = *opened.state.breath->person;
  EXPECT_EQ(person.name, "'person.json'") << "folders may carry names of people";
  EXPECT_EQ(constantsOf(person.form, person.kind),
            constantsOf(saved.state.breath->person->form, FormKind::Quiet));
  EXPECT_EQ(person.strain, saved.state.breath->person->strain);
  EXPECT_EQ(opened.next.breathe, saved.next.breathe);
  EXPECT_EQ(opened.next.growth, saved.next.growth);
  EXPECT_EQ(opened.view, saved.view);
  EXPECT_EQ(opened.thumbnail, "PNG");
  // And to the last field: it is saved as the same bytes again.
  expectSame(projectMembers(opened, folder.path()), projectMembers(saved, folder.path()));
}

TEST(Project, KeepsWhatCanBeDoneAgain) {
  const TempFolder folder;
  Project saved = everything();
  ProjectStep next{"breathe", saved.state};
  next.state.breath->tidalMl = 612.5;
  ProjectStep afterThat{"grow airways", next.state};
  afterThat.state.model.growth = nullptr;
  saved.redo = {next, afterThat};
  writeProject(folder / "case.pneuma", saved);
  EXPECT_EQ(jsonIn(folder / "case.pneuma")["schema"], "pneuma/project/2")
      << "programs that would misread it must not open it";
  const Project opened = readProject(folder / "case.pneuma");
  ASSERT_EQ(opened.redo.size(), 2U);
  EXPECT_EQ(opened.redo[0].name, "breathe");
  EXPECT_EQ(opened.redo[0].state.breath->tidalMl, 612.5);
  EXPECT_EQ(opened.redo[0].state.model.growth, opened.state.model.growth);
  EXPECT_EQ(opened.redo[1].name, "grow airways");
  EXPECT_EQ(opened.redo[1].state.model.growth, nullptr);
  expectSame(projectMembers(opened, folder.path()), projectMembers(saved, folder.path()));
  // Without it the file is one of before.
  saved.redo.clear();
  writeProject(folder / "other.pneuma", saved);
  EXPECT_EQ(jsonIn(folder / "other.pneuma")["schema"], "pneuma/project/1");
}

TEST(Project, KeepsAHundredStepsNearestToNow) {
  Project saved;
  saved.state.name = "now";
  for (int i = 0; i < 70; ++i) saved.undo.push_back({"undo " + std::to_string(i), saved.state});
  for (int i = 0; i < 70; ++i) saved.redo.push_back({"redo " + std::to_string(i), saved.state});
  const TempFolder folder;
  const auto kept = [&] {
    return projectOf(projectMembers(saved, folder.path()), folder.path(), "'case.pneuma'");
  };
  Project opened = kept();
  EXPECT_EQ(opened.undo.size(), 70U);
  ASSERT_EQ(opened.redo.size(), 30U);
  EXPECT_EQ(opened.redo.front().name, "redo 0");
  for (int i = 70; i < 140; ++i) saved.undo.push_back({"undo " + std::to_string(i), saved.state});
  opened = kept();
  ASSERT_EQ(opened.undo.size(), 100U);
  EXPECT_EQ(opened.undo.front().name, "undo 40");
  EXPECT_EQ(opened.undo.back().name, "undo 139");
  EXPECT_TRUE(opened.redo.empty());
}

TEST(Project, HoldsWhatIsAlikeOnce) {
  const TempFolder folder;
  Project saved = everything();
  const std::size_t before = projectMembers(saved, folder.path()).size();
  // The same lobes and the same tree made anew, as growing again with the same options does.
  ProjectStep again{"split into lobes", saved.state};
  LungModel& model = again.state.model;
  model.lobes = std::make_shared<const LobesOfLungs>(*model.lobes);
  model.growth = std::make_shared<const Growth>(*model.growth);
  std::vector<LobeSurface> copies = *model.surfaces;
  for (LobeSurface& copy : copies) copy.mesh = std::make_shared<const TriangleMesh>(*copy.mesh);
  model.surfaces = std::make_shared<const std::vector<LobeSurface>>(copies);
  saved.undo.push_back(again);
  const auto members = projectMembers(saved, folder.path());
  EXPECT_EQ(members.size(), before);
  const Project opened = projectOf(members, folder.path(), "'case.pneuma'");
  EXPECT_EQ(opened.undo.back().state.model.growth, opened.state.model.growth);
  EXPECT_EQ(opened.undo.back().state.model.surfaces, opened.state.model.surfaces);
  // A point that is another makes another surface, and of that one surface alone.
  auto moved = std::make_shared<TriangleMesh>(*copies[0].mesh);
  moved->points[0].x() = std::nextafter(moved->points[0].x(), 1e9);
  copies[0].mesh = moved;
  saved.undo.back().state.model.surfaces = std::make_shared<const std::vector<LobeSurface>>(copies);
  const auto more = projectMembers(saved, folder.path());
  EXPECT_EQ(more.size(), before + 1);
  const Project other = projectOf(more, folder.path(), "'case.pneuma'");
  EXPECT_EQ(other.undo.back().state.model.surfaces->front().mesh->points, moved->points);
  EXPECT_EQ(other.state.model.surfaces->front().mesh->points,
            saved.state.model.surfaces->front().mesh->points);
}

TEST(Project, OpensWhatVersion1Saved) {
  const std::filesystem::path file = PNEUMA_DATA_OF_TESTS "/project_version_1.pneuma";
  EXPECT_EQ(jsonIn(file)["schema"], "pneuma/project/1");
  const Project opened = readProject(file);
  EXPECT_TRUE(opened.notes.empty());
  EXPECT_TRUE(opened.redo.empty());
  EXPECT_EQ(opened.state.name, "Sphere (built in)");
  ASSERT_EQ(opened.undo.size(), 3U);
  EXPECT_EQ(opened.undo[0].name, "open the organ Sphere");
  EXPECT_EQ(opened.undo[1].name, "grow airways");
  EXPECT_EQ(opened.undo[2].name, "grow airways");
  EXPECT_EQ(opened.undo[0].state.model.organ, "");
  ASSERT_NE(opened.undo[2].state.model.growth, nullptr);
  EXPECT_LT(treeOf(opened.undo[2].state.model)->size(), treeOf(opened.state.model)->size());
  EXPECT_FALSE(opened.thumbnail.empty());
  // And back: to the same trees, in a file that programs of version 1 open.
  const TempFolder folder;
  writeProject(folder / "case.pneuma", opened);
  const auto before = readArchive(file);
  const auto after = readArchive(folder / "case.pneuma");
  EXPECT_EQ(jsonIn(folder / "case.pneuma")["schema"], "pneuma/project/1");
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 1; i < before.size(); ++i) {
    EXPECT_EQ(after[i].name, before[i].name);
    EXPECT_TRUE(after[i].content == before[i].content) << before[i].name;
  }
}

TEST(Project, HoldsNoFolders) {
  const TempFolder folder;
  for (const ArchiveMember& member : projectMembers(everything(), folder.path())) {
    EXPECT_THAT(member.content, Not(HasSubstr("DOE^JANE"))) << member.name;
  }
}

TEST(Project, OfABuiltInOrganHasItsRegions) {
  const TempFolder folder;
  Project project;
  CentroidSplittingOptions options;
  options.terminals = 100;
  project.state.model = grow(openOrgan("sphere"), options);
  writeProject(folder / "sphere.pneuma", project);
  const Project opened = readProject(folder / "sphere.pneuma");
  ASSERT_NE(opened.state.model.regions, nullptr);
  expectSame(*treeOf(grow(opened.state.model, opened.state.model.growth->options)),
             *treeOf(project.state.model));
  project.state.model = openOrgan("sphere", {.sizeMl = 500.0});
  EXPECT_THROW(writeProject(folder / "other.pneuma", project), Unsupported);
}

class ProjectCtTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder / "a/cts");
    writeVolume(folder / "a/cts/ct.nrrd", smallCt());
    project.state.model = openCt(folder / "a/cts/ct.nrrd");
    writeProject(file(), project);
  }

  std::filesystem::path file() const { return folder / "a/case.pneuma"; }

  TempFolder folder;
  Project project;
};

TEST_F(ProjectCtTest, LinksTheCtAndFindsItBesideTheProject) {
  const Json ct = jsonIn(file())["ct"];
  EXPECT_EQ(ct["relative"], "cts/ct.nrrd");
  EXPECT_EQ(ct["sha256"], sha256(readFile(folder / "a/cts/ct.nrrd")));
  EXPECT_EQ(ct["bytes"], std::filesystem::file_size(folder / "a/cts/ct.nrrd"));
  std::filesystem::rename(folder / "a", folder / "b");
  const Project opened = readProject(folder / "b/case.pneuma");
  ASSERT_NE(opened.state.model.ct, nullptr);
  EXPECT_EQ(opened.state.model.ct->voxels, smallCt().voxels);
  EXPECT_EQ(opened.state.model.ctSource->path, folder / "b/cts/ct.nrrd");
}

TEST_F(ProjectCtTest, OpensWithoutAMissingOrChangedCtAndKeepsTheLink) {
  CtImage other = smallCt();
  other.voxels[0] = 5;
  writeVolume(folder / "a/cts/ct.nrrd", other);
  Project opened = readProject(file());
  ASSERT_EQ(opened.notes.size(), 1U);
  EXPECT_THAT(opened.notes[0], HasSubstr("content has changed"));
  EXPECT_EQ(opened.state.model.ct, nullptr);
  std::filesystem::remove(folder / "a/cts/ct.nrrd");
  opened = readProject(file());
  ASSERT_EQ(opened.notes.size(), 1U);
  EXPECT_THAT(opened.notes[0], HasSubstr("not where it was"));
  writeProject(file(), opened);
  writeVolume(folder / "a/cts/ct.nrrd", smallCt());
  opened = readProject(file());
  EXPECT_TRUE(opened.notes.empty());
  EXPECT_NE(opened.state.model.ct, nullptr);
}

TEST_F(ProjectCtTest, PacksTheCtIfAsked) {
  project.ctStorage = CtStorage::Packed;
  writeProject(file(), project);
  std::filesystem::remove_all(folder / "a/cts");
  const Project opened = readProject(file());
  EXPECT_TRUE(opened.notes.empty());
  ASSERT_NE(opened.state.model.ct, nullptr);
  EXPECT_EQ(opened.state.model.ct->voxels, smallCt().voxels);
  EXPECT_EQ(opened.state.model.ct->geometry, project.state.model.ct->geometry);
  writeProject(file(), opened);  // it stays packed
  EXPECT_NE(readProject(file()).state.model.ct, nullptr);
}

TEST_F(ProjectCtTest, KeepsWhatANewerVersionAdded) {
  auto members = readArchive(file());
  Json json = Json::parse(members[0].content);
  json["future"] = {{"colour", "blue"}, {"object", "thing"}};
  json["state"]["model"]["future"] = {1, 2, 3};
  json["view"]["future"] = true;
  json["next"]["lungs"]["future"] = 0.5;
  json["objects"]["thing"] = {{"file", "future/thing.bin"}};
  members[0].content = json.dump();
  members.push_back({"future/thing.bin", std::string("\0\1\2", 3), true});
  writeArchive(file(), members);
  writeProject(file(), readProject(file()));
  writeProject(file(), readProject(file()));
  const Json back = jsonIn(file());
  EXPECT_EQ(back["future"], json["future"]);
  EXPECT_EQ(back["state"]["model"]["future"], json["state"]["model"]["future"]);
  EXPECT_EQ(back["view"]["future"], true);
  EXPECT_EQ(back["next"]["lungs"]["future"], 0.5);
  EXPECT_EQ(back["objects"]["thing"], json["objects"]["thing"]);
  EXPECT_EQ(readArchive(file()).back().content, members.back().content);
}

TEST_F(ProjectCtTest, RefusesWhatItCannotOpen) {
  auto members = readArchive(file());
  const Json json = Json::parse(members[0].content);
  const auto refused = [&](const Json& changed, ExitCode code) {
    members[0].content = changed.dump();
    writeArchive(file(), members);
    return sentenceOf(file(), code);
  };
  Json changed = json;
  changed["schema"] = "pneuma/project/3";
  EXPECT_THAT(refused(changed, ExitCode::Unsupported), HasSubstr("newer Pneuma"));
  changed["schema"] = "pneuma/recipe/1";
  EXPECT_THAT(refused(changed, ExitCode::InputInvalid), HasSubstr("no project"));
  EXPECT_THAT(refused(Json::array(), ExitCode::InputInvalid), HasSubstr("no project"));
  changed = json;
  changed["state"]["model"]["surfaces"] = "absent";
  EXPECT_THAT(refused(changed, ExitCode::InputInvalid), HasSubstr("state/model/surfaces"));
  changed = json;
  changed["state"]["lungs_found_with"]["threshold"] = 5000;
  EXPECT_THAT(refused(changed, ExitCode::InputInvalid), HasSubstr("threshold"));
  changed = json;
  changed["next"]["method"] = -1;
  EXPECT_THAT(refused(changed, ExitCode::InputInvalid), HasSubstr("next/method"));
  members[0].content = "{";
  writeArchive(file(), members);
  EXPECT_THAT(sentenceOf(file(), ExitCode::InputInvalid), HasSubstr("cannot be read"));
  writeArchive(file(), {{"readme", "x", true}});
  EXPECT_THAT(sentenceOf(file(), ExitCode::InputInvalid), HasSubstr("no project"));
}

}  // namespace
}  // namespace pneuma
