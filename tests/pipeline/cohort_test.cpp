#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "io/temp_folder.h"
#include "io/volume_file.h"
#include "pipeline/cohort_folder.h"
#include "pipeline/recipe_arguments.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Cohorts : public ::testing::Test {
 protected:
  Cohorts() {
    // What a CT holds is looked at when its turn comes.
    for (const char* name : {"one.nii", "M\xC3\xBCller 2.nii", "three.nii"}) write(name, "");
  }

  void write(const std::string& name, const std::string& content) const {
    writeFile(path(name), content);
  }

  fs::path path(const std::string& name) const { return folder_.path() / name; }

  Cohort read(const std::string& table, const std::string& recipe = "") const {
    write("cases.csv", table);
    return readCohort({path("cases.csv"), recipe.empty() ? fs::path() : path(recipe), false});
  }

  std::string refusal(const std::string& table, ExitCode code) const {
    try {
      read(table);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code) << error.what();
      return error.what();
    }
    return "";
  }

  void writeRecipes() const {
    write("dla.json",
          R"({"schema":"pneuma/recipe/1","airways":{"method":"dla","particles":5000,"seed":3}})");
    write("thick.json",
          R"({"schema":"pneuma/recipe/1","open":{"resample":1.5},"lungs":{"threshold":-600},)"
          R"("lobes":{"fractions":"usual"}})");
    write("wrong.json", R"({"schema":"pneuma/recipe/1","airways":{"method":"weibel"}})");
  }

 private:
  testing::TempFolder folder_;
};

TEST_F(Cohorts, HaveNamesPathsAndFurtherColumns) {
  const Cohort cohort =
      read("group,path,case,series\nwell,one.nii,a b,\nCOPD,M\xC3\xBCller 2.nii,\xC3\xA4,2\n");
  ASSERT_EQ(cohort.cases.size(), 2U);
  EXPECT_EQ(cohort.cases[0].name, "a b");
  EXPECT_EQ(cohort.cases[0].ct, path("one.nii"));
  EXPECT_THAT(cohort.cases[1].columns, ElementsAre(std::pair("group", "COPD")));
  EXPECT_EQ(cohort.cases[1].recipe.series.wanted, "2");
  EXPECT_THAT(cohort.methods, ElementsAre("kitaoka"));
}

TEST_F(Cohorts, NumberCasesWithoutNames) {
  const Cohort cohort = read("ct\none.nii\nthree.nii\n");
  EXPECT_EQ(cohort.cases[0].name, "case-001");
  EXPECT_EQ(cohort.cases[1].name, "case-002");
}

TEST_F(Cohorts, TakeTheRecipeOfTheCaseOrThatOfAll) {
  writeRecipes();
  const Cohort cohort = read("ct,recipe\none.nii,dla.json\nthree.nii,\n", "thick.json");
  EXPECT_THAT(cohort.methods, ElementsAre("dla", "kitaoka"));
  EXPECT_THAT(read("ct,recipe\none.nii,dla.json\n").methods, ElementsAre("dla"));
  const Json json = toJson(cohort);
  const Json& options = json.at("cases").at(0).at("options");
  EXPECT_EQ(options.at("segment"), Json::array());
  EXPECT_EQ(options.at("grow").at("dla"), Json({"--set=particles=5000", "--set=seed=3"}));
  EXPECT_EQ(options.at("grow").at("centroid"), Json({"--set=seed=3"}));
  const Json& ofAll = json.at("cases").at(1).at("options");
  EXPECT_EQ(json.at("methods"), Json({"dla", "kitaoka"}));
  EXPECT_EQ(ofAll.at("info"), Json({"--resample=1.5"}));
  EXPECT_EQ(ofAll.at("import"), Json({"--resample=1.5"}));
  EXPECT_EQ(ofAll.at("segment"), Json({"--threshold=-600"}));
  EXPECT_EQ(ofAll.at("lobes"), Json({"--fractions=usual"}));
  EXPECT_EQ(ofAll.at("grow").at("kitaoka"), Json::array());
}

TEST_F(Cohorts, TellWhatIsWrongWithTheTable) {
  EXPECT_THAT(refusal("case\na\n", ExitCode::InputInvalid), HasSubstr("no column \"ct\""));
  EXPECT_THAT(refusal("ct,path\none.nii,one.nii\n", ExitCode::InputInvalid), HasSubstr("both"));
  EXPECT_THAT(refusal("ct\n", ExitCode::InputInvalid), HasSubstr("lists no case"));
}

TEST_F(Cohorts, TellWhatIsWrongWithItsLines) {
  writeRecipes();
  EXPECT_THAT(refusal("case,ct\na,one.nii\nb,three.nii\na,one.nii\n", ExitCode::InputInvalid),
              HasSubstr("line 4 names its case 'a', as line 2 does"));
  EXPECT_THAT(refusal("case,ct\na,no.nii\nb,nor.nii\n", ExitCode::InputMissing),
              AllOf(HasSubstr("line 2 names 'no.nii' under \"ct\", which does not exist"),
                    HasSubstr("; line 3 names 'nor.nii'")));
  EXPECT_THAT(refusal("ct,recipe\none.nii,wrong.json\n", ExitCode::Usage),
              AllOf(HasSubstr("line 2"), HasSubstr("weibel")));
  EXPECT_THAT(refusal("ct,fissures\none.nii,no.json\n", ExitCode::InputMissing),
              HasSubstr("line 2 names 'no.json' under \"fissures\""));
  std::string many = "ct\n";
  for (int i = 0; i < 9; ++i) many += "no.nii\n";
  EXPECT_THAT(refusal(many, ExitCode::InputMissing), HasSubstr("; and 4 more"));
}

TEST_F(Cohorts, RefuseNamesThatAreNoFolders) {
  for (const char* name :
       {"", "..", ".hidden", "-o", "a/b", "a\\b", "a{b}", "a\tb", "a,b", "a'b", "a$b",
        "a\xC2\xA0"
        "b",
        "a\xE2\x80\x8B"}) {
    EXPECT_THAT(refusal("ct,case\none.nii,\"" + std::string(name) + "\"\n", ExitCode::InputInvalid),
                HasSubstr("line 2"))
        << name;
  }
}

TEST_F(Cohorts, TakeTheScansOfAFolder) {
  fs::create_directory(path("scans"));
  // The beginning of a NIfTI file is enough to be taken for one.
  for (const char* name : {"scans/Meier.nii", "scans/Abel.nii"}) write(name, "");
  write("scans/notes.txt", "x");
  const Cohort cohort = readCohort({path("scans"), {}, false});
  ASSERT_EQ(cohort.cases.size(), 2U);
  EXPECT_EQ(cohort.cases[0].name, "case-001");
  EXPECT_EQ(cohort.cases[0].ct, path("scans/Abel.nii"));
  EXPECT_THAT(cohort.notes, ElementsAre(HasSubstr("1 of 3 entries")));
  EXPECT_EQ(readCohort({path("scans"), {}, true}).cases[0].name, "Abel.nii");
  fs::create_directory(path("empty"));
  EXPECT_THROW(readCohort({path("empty"), {}, false}), InputMissing);
}

TEST_F(Cohorts, PassOverTheLabelsOfAScan) {
  fs::create_directory(path("scans"));
  const ImageGeometry geometry{.size = {4, 4, 4}};
  writeVolume(path("scans/a.nii.gz"), CtImage{geometry, std::vector<std::int16_t>(64)});
  for (const char* name : {"scans/a-lobes.nii.gz", "scans/a.mha", "scans/a.nrrd"}) {
    writeVolume(path(name), LabelImage{geometry, std::vector<std::uint8_t>(64)});
  }
  const Cohort cohort = readCohort({path("scans"), {}, false});
  ASSERT_EQ(cohort.cases.size(), 1U);
  EXPECT_EQ(cohort.cases[0].ct, path("scans/a.nii.gz"));
  EXPECT_THAT(cohort.notes, ElementsAre(HasSubstr("3 of 4 entries")));
}

TEST_F(Cohorts, WriteAWorkflowThatKeepsWhatPeopleEdit) {
  CohortWorkflow workflow{read("ct\none.nii\n"), "'/a b/pneuma'", "again --force"};
  const fs::path to = path("study");
  const WrittenCohort first = writeCohort(to, workflow, Existing::Refuse);
  EXPECT_THAT(first.kept, IsEmpty());
  EXPECT_EQ(first.files.size(), 13U);
  EXPECT_THAT(readFile(to / "config.yaml"),
              AllOf(HasSubstr("pneuma: \"'/a b/pneuma'\"\n"), HasSubstr("methods: []\n")));
  EXPECT_THAT(readFile(to / "README.md"), HasSubstr("    again --force\n"));
  for (const std::string& file : first.files) {
    EXPECT_THAT(readFile(to / file), ::testing::Not(HasSubstr("@PNEUMA@"))) << file;
  }
  EXPECT_THROW(writeCohort(to, workflow, Existing::Refuse), OutputFailed);

  writeFile(to / "config.yaml", "mine");
  fs::create_directory(to / "cases");
  const WrittenCohort second = writeCohort(to, workflow, Existing::Replace);
  EXPECT_THAT(second.kept, ElementsAre("config.yaml", "profiles/local/config.yaml",
                                       "profiles/slurm/config.yaml"));
  EXPECT_EQ(readFile(to / "config.yaml"), "mine");
  EXPECT_TRUE(fs::is_directory(to / "cases"));
}

}  // namespace
}  // namespace pneuma
