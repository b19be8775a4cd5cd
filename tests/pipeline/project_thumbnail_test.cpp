// The picture that a project shows itself by, without opening it.
#include "pipeline/project_thumbnail.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "io/member_archive.h"
#include "io/temp_folder.h"
#include "pipeline/project.h"

namespace pneuma {
namespace {

TEST(ProjectThumbnail, IsThereWithoutOpeningTheProject) {
  const std::filesystem::path file = PNEUMA_DATA_OF_TESTS "/project_version_1.pneuma";
  EXPECT_EQ(projectThumbnail(file), readProject(file).thumbnail);
  const testing::TempFolder folder;
  writeArchive(folder / "bare.pneuma", {{"project.json", "{}", true}});
  EXPECT_EQ(projectThumbnail(folder / "bare.pneuma"), "");
  writeArchive(folder / "other.zip", {{"letter.txt", "hello", true}});
  EXPECT_THROW(projectThumbnail(folder / "other.zip"), InvalidInput);
}

}  // namespace
}  // namespace pneuma
