#include "pipeline/estimate.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "breathing/made_lungs.h"
#include "core/error.h"
#include "core/parallel.h"
#include "io/atomic_file.h"
#include "pipeline/breathe.h"
#include "support/json_schema.h"

namespace pneuma {
namespace {

using testing::fieldOf;
using ::testing::HasSubstr;
using testing::madeLandmarks;
using testing::madeLung;
using testing::madeLungs;

const PublishedForm Truth{{0.3, 0.6, 1.0}, {1.1, 0.8, 1.6}, 0.1, {0.3, 0.2, 0.8}};
const Vec3 Shift(-1.5, 12.0, 4.0);

/// Both lungs at rest, widened by the strain of madeLungs(), and landmarks that a form moved.
EstimateInput madePerson(std::size_t landmarks = 60, double noiseMm = 0.0) {
  EstimateInput input;
  input.later.emplace_back();
  for (const Side side : {Side::Right, Side::Left}) {
    TriangleMesh wall = madeLung(side, 4);
    input.rest.emplace(side, wall);
    for (Vec3& p : wall.points) p *= 1.17;
    input.later.back().emplace(side, std::move(wall));
  }
  input.landmarks = madeLandmarks(landmarks, fieldOf(Truth), Shift, noiseMm, 8);
  for (LandmarkPair& pair : input.landmarks) pair.side = Side::None;
  return input;
}

EstimateOptions published(double holdOut = 0.25) {
  EstimateOptions options;
  options.form = FormKind::Published;
  options.surfaceWeight = 0.0;
  options.holdOut = holdOut;
  return options;
}

const MotionErrors& row(const MotionEstimate& estimate, const std::string& motion) {
  return *std::ranges::find(estimate.errors, motion, &MotionErrors::motion);
}

std::string refusal(const EstimateInput& input, const EstimateOptions& options) {
  try {
    estimateMotion(input, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(EstimateMotion, FindsTheConstantsThatLandmarksWereMadeBy) {
  const MotionEstimate estimate = estimateMotion(madePerson(), published());
  EXPECT_EQ(estimate.fittedCount, 45U);
  EXPECT_EQ(estimate.heldOutCount, 15U);
  EXPECT_NEAR(estimate.lungs.at(Side::Left).strain, 0.17, 1e-9);
  const auto found = constantsOf(estimate.fit.form, FormKind::Published);
  const auto wanted = constantsOf(Truth, FormKind::Published);
  for (std::size_t n = 0; n < wanted.size(); ++n) EXPECT_NEAR(found[n], wanted[n], 1e-3) << n;
  EXPECT_LT((estimate.fit.shift - Shift).norm(), 1e-3);
  EXPECT_LT(row(estimate, "these constants").heldOut->raw.meanMm, 1e-3);
  EXPECT_GT(row(estimate, "no motion").heldOut->raw.meanMm, 10.0);
  // The shift is no motion of the lungs: what is left without it is.
  EXPECT_NEAR(row(estimate, "a shift alone").fitted.raw.meanMm,
              row(estimate, "no motion").fitted.shifted.meanMm, 1e-9);
}

TEST(EstimateMotion, TellsTheErrorOfLandmarksThatWereNotFitted) {
  // With 2 mm of noise and 12 landmarks, the fitted ones flatter.
  EstimateOptions options = published(0.9);
  const MotionEstimate few = estimateMotion(madePerson(120, 2.0), options);
  ASSERT_EQ(few.fittedCount, 12U);
  const MotionErrors& errors = row(few, "these constants");
  EXPECT_GT(errors.heldOut->raw.meanMm, 1.1 * errors.fitted.raw.meanMm);
  options.seed = 2;
  EXPECT_NE(row(estimateMotion(madePerson(120, 2.0), options), "no motion").heldOut->raw.meanMm,
            row(few, "no motion").heldOut->raw.meanMm);
  options.every = 4;
  EXPECT_EQ(estimateMotion(madePerson(120, 2.0), options).heldOutCount, 30U);
}

TEST(EstimateMotion, IsTheSameForAnyNumberOfThreads) {
  EstimateOptions options;
  const auto estimatedOn = [&](unsigned threads) {
    const ThreadLimit limit(threads);
    return estimateMotion(madePerson(60, 1.0), options);
  };
  const MotionEstimate one = estimatedOn(1);
  const MotionEstimate four = estimatedOn(4);
  EXPECT_EQ(one.fit.form, four.fit.form);
  EXPECT_EQ(estimateReport({}, options, one), estimateReport({}, options, four));
}

TEST(EstimateMotion, TakesVolumesFromWhatThereIs) {
  EstimateInput input = madePerson();
  input.later.clear();
  EstimateOptions options = published();
  double rest = 0.0;
  for (const auto& [side, wall] : input.rest) rest += signedVolumeMm3(wall) / 1000.0;
  options.gainMl = rest * (std::pow(1.17, 3.0) - 1.0);
  EXPECT_NEAR(estimateMotion(input, options).lungs.at(Side::Right).strain, 0.17, 1e-9);
  options.gainMl = 0.0;
  const MotionEstimate guessed = estimateMotion(input, options);
  EXPECT_GT(guessed.lungs.at(Side::Right).strain, 0.05);
  EXPECT_THAT(guessed.warnings, ::testing::Contains(HasSubstr("Volumes are not known")));
  input.rest.clear();
  const MotionEstimate bare = estimateMotion(input, options);
  EXPECT_THAT(bare.warnings, ::testing::Contains(HasSubstr("boxes are those of the landmarks")));
  EXPECT_LT(row(bare, "these constants").heldOut->raw.meanMm, 2.0);
}

TEST(EstimateMotion, RefusesWhatTellsNothing) {
  EstimateInput blind = madePerson();
  blind.landmarks.clear();
  EXPECT_THAT(refusal(blind, {}), HasSubstr("surfaces alone do not tell"));
  EstimateInput half = madePerson();
  half.later.back().erase(Side::Left);
  EXPECT_THAT(refusal(half, {}), HasSubstr("later surface 1 holds no left lung"));
  EstimateInput backwards = madePerson();
  std::swap(backwards.rest, backwards.later.back());
  EXPECT_THAT(refusal(backwards, {}), HasSubstr("has to be the larger one"));
  EstimateInput elsewhere = madePerson();
  elsewhere.landmarks[6].rest.z() = 900.0;
  EXPECT_THAT(refusal(elsewhere, {}), HasSubstr("landmark 7 lies"));
  EXPECT_THAT(refusal(madePerson(14), {}), HasSubstr("12 at least"));
  EstimateOptions two;
  two.every = 30;
  EXPECT_THAT(refusal(madePerson(60), two), HasSubstr("hold out three or more"));
}

TEST(EstimateReport, KeepsItsSchemaAndIsReadBack) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "person.json";
  for (const FormKind kind : {FormKind::Deep, FormKind::Quiet, FormKind::Published}) {
    EstimateOptions options;
    options.form = kind;
    const MotionEstimate estimate = estimateMotion(madePerson(60, 1.0), options);
    const Json report = estimateReport({}, options, estimate);
    const test::JsonSchema schema(
        nlohmann::json::parse(readFile(PNEUMA_SCHEMAS "/estimate.schema.json")));
    EXPECT_EQ(schema.faults(nlohmann::json::parse(report.dump())), std::vector<std::string>{});
    writeFile(path, report.dump());
    const PersonMotion person = readPersonMotion(path);
    EXPECT_EQ(person.kind, kind);
    EXPECT_EQ(person.form, estimate.fit.form);
    EXPECT_EQ(person.heldOut, 12U);
    EXPECT_NEAR(person.restMl.at(Side::Left), 3103.0, 20.0);
    EXPECT_EQ(person.errorMm, row(estimate, "these constants").heldOut->raw.meanMm);
  }
  std::filesystem::remove(path);
}

class PersonFile : public ::testing::Test {
 protected:
  std::string refusalOf(const std::string& content) const {
    writeFile(path_, content);
    try {
      readPersonMotion(path_);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  }

  void TearDown() override { std::filesystem::remove(path_); }

  std::filesystem::path path_ = std::filesystem::path(::testing::TempDir()) / "damaged.json";
};

TEST_F(PersonFile, IsRefusedIfItIsNoneOrDamaged) {
  EXPECT_THAT(refusalOf("no JSON"), HasSubstr("holds no constants of a person"));
  EXPECT_THAT(refusalOf(R"({"schema": "pneuma/breathe/1"})"), HasSubstr("holds no constants"));
  EXPECT_THAT(refusalOf(R"({"schema": "pneuma/estimate/1"})"), HasSubstr("something is missing"));
  Json report = estimateReport({}, published(), estimateMotion(madePerson(), published()));
  Json broken = report;
  broken["constants"].erase(0);
  EXPECT_THAT(refusalOf(broken.dump()), HasSubstr("it has 8 constants where its form has 9"));
  broken = report;
  broken["constants"][0]["value"] = -1.0;
  EXPECT_THAT(refusalOf(broken.dump()), HasSubstr("a weight is below 0"));
  broken = report;
  broken["constants"][5]["value"] = 1e9;
  EXPECT_THAT(refusalOf(broken.dump()), HasSubstr("too large"));
  broken = report;
  broken["form"] = "cubic";
  EXPECT_THAT(refusalOf(broken.dump()), HasSubstr("no form 'cubic'"));
}

/// The right lung breathes in by a strain of 0.1, by a person's constants.
BreathingLungs personBreathes(const PersonMotion& person, BreatheOptions options = {}) {
  LungModel model;
  auto wall = std::make_shared<const TriangleMesh>(madeLung(Side::Right, 4));
  model.surfaces = std::make_shared<const std::vector<LobeSurface>>(
      std::vector<LobeSurface>{{Lobe::RightLung, "right", wall, {}}});
  options.tidalMl = 0.331 * signedVolumeMm3(*wall) / 1000.0;
  options.frames = 2;
  options.person = std::make_shared<const PersonMotion>(person);
  BreathingLungs lungs = breathe(model, options);
  const std::string basis = breatheReport(model, lungs, options).at("basis").get<std::string>();
  EXPECT_THAT(basis, HasSubstr("landmarks of this person"));
  return lungs;
}

PersonMotion evenPerson() {
  PersonMotion person;
  person.name = "'person.json'";
  person.form = evenForm();
  person.strain = {{Side::Right, 0.1}};
  person.restMl = {{Side::Right, 3103.0}};
  return person;
}

TEST(BreatheByConstants, MovesPointsByThem) {
  const PersonMotion person = evenPerson();
  const BreathingLungs lungs = personBreathes(person);
  EXPECT_TRUE(lungs.warnings.empty());
  const LungMotion& motion = lungs.motion.at(Side::Right);
  // Deep within, where the layer at the wall has faded to a hundredth.
  const Vec3 centre(-75.0, 10.0, 30.0);
  const FormField field(person.form, {Side::Right, bounds(motion.wall())}, 0.1);
  EXPECT_LT((motion.at(centre) - field.at(centre)).norm(), 0.1);
  EXPECT_GT(motion.at(centre).norm(), 5.0);
}

TEST(BreatheByConstants, DoubtsOtherLungsAndOtherBreaths) {
  PersonMotion person = evenPerson();
  person.restMl[Side::Right] = 2000.0;
  person.strain[Side::Right] = 0.03;
  EXPECT_THAT(personBreathes(person).warnings,
              ::testing::ElementsAre(HasSubstr("are they of the same person"),
                                     HasSubstr("quiet and deep breathing")));
  person.strain.clear();
  EXPECT_THAT(personBreathes(person).warnings,
              ::testing::ElementsAre(HasSubstr("without landmarks in the right lung")));
  BreatheOptions options;
  options.motion = MotionChoice::Deep;
  EXPECT_THROW(personBreathes(person, options), InvalidOption);
  options.motion = MotionChoice::Scenario;
  options.model = MotionModel::Continuous;
  EXPECT_THROW(personBreathes(person, options), InvalidOption);
}

}  // namespace
}  // namespace pneuma
