#include "io/multiblock_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "temp_folder.h"

namespace pneuma {
namespace {

using ::testing::HasSubstr;
using testing::TempFolder;

TEST(TimeCollection, ReadsBackInTheOrderOfTime) {
  const TempFolder folder;
  writeTimeCollection(folder / "b.pvd",
                      {{2.5, 0, "late & \"odd\".vtp"}, {0.25, 0, "a.vtp"}, {0.25, 1, "t.vtp"}});
  const std::vector<TimedFile> files = readTimeCollection(folder / "b.pvd");
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(files[0].file, "a.vtp");
  EXPECT_EQ(files[0].seconds, 0.25);
  EXPECT_EQ(files[1].file, "t.vtp");
  EXPECT_EQ(files[1].part, 1);
  EXPECT_EQ(files[2].file, "late & \"odd\".vtp");
  EXPECT_EQ(files[2].seconds, 2.5);
}

void expectRefused(const std::string& content, const std::string& reason) {
  const TempFolder folder;
  try {
    readTimeCollection(folder.put("bad.pvd", content));
    ADD_FAILURE() << "accepted, though: " << reason;
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr(reason));
    EXPECT_THAT(error.what(), HasSubstr("bad.pvd"));
  }
}

TEST(TimeCollection, RefusesWhatIsNone) {
  const auto with = [](const std::string& entry) {
    return "<VTKFile type=\"Collection\"><Collection>" + entry + "</Collection></VTKFile>";
  };
  expectRefused("", "no ParaView collection");
  expectRefused("<VTKFile><Coll", "no ParaView collection");
  expectRefused("<VTKFile type=\"PolyData\"></VTKFile>", "no ParaView collection");
  expectRefused(with(""), "names no file");
  expectRefused(with("<DataSet timestep=\"0\"/>"), "without a file or a moment");
  expectRefused(with("<DataSet timestep=\"soon\" file=\"a.vtp\"/>"), "without a file or a moment");
  expectRefused(with("<DataSet timestep=\"nan\" file=\"a.vtp\"/>"), "without a file or a moment");
  expectRefused(with("<DataSet timestep=\"0\" file=\"/etc/a.vtp\"/>"), "outside its folder");
  expectRefused(with("<DataSet timestep=\"0\" file=\"b/../../a.vtp\"/>"), "outside its folder");
  std::string deep;
  for (int n = 0; n < 100000; ++n) deep += "<a>";
  expectRefused(deep, "nested too deeply");
}

TEST(TimeCollection, SaysWhichIsMissing) {
  EXPECT_THROW(readTimeCollection("gone.pvd"), InputMissing);
}

}  // namespace
}  // namespace pneuma
