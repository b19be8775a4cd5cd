#include "io/number_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/refusal.h"
#include "io/temp_folder.h"

namespace pneuma {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::vector<std::vector<std::string_view>> Wanted = {{"seconds", "time_s"}, {"volume_ml"}};

class NumberTables : public ::testing::Test {
 protected:
  NumberTable read(const std::string& content) const {
    writeFile(folder_.path() / "t.csv", content);
    return readNumberTable(folder_.path() / "t.csv", Wanted);
  }

  std::string refusal(const std::string& content) const {
    return testing::refusalOf([&] { read(content); });
  }

 private:
  testing::TempFolder folder_;
};

TEST_F(NumberTables, TakeTheWantedColumnsAndKnowTheirLines) {
  const NumberTable table =
      read("\xEF\xBB\xBF# of a spirometer\nNote,Volume_mL,TIME_S\n\na,1.5,0\n\"b\", 2 ,0.1\r\n");
  EXPECT_THAT(table.columns, ElementsAre("time_s", "volume_ml"));
  EXPECT_THAT(table.values[0], ElementsAre(0.0, 0.1));
  EXPECT_THAT(table.values[1], ElementsAre(1.5, 2.0));
  EXPECT_THAT(table.lines, ElementsAre(4U, 5U));
  EXPECT_THAT(read("seconds;volume_ml\n1;2\n").values[1], ElementsAre(2.0));
  EXPECT_THAT(read("seconds\tvolume_ml\n1\t2\n").values[0], ElementsAre(1.0));
}

TEST_F(NumberTables, NameTheLineThatIsWrong) {
  EXPECT_THAT(refusal("seconds,volume_ml\n0,1\n1,x\n"),
              AllOf(HasSubstr("line 3, column volume_ml"), HasSubstr("\"x\"")));
  EXPECT_THAT(refusal("seconds,volume_ml\n0,nan\n"), HasSubstr("line 2, column volume_ml"));
  EXPECT_THAT(refusal("seconds,volume_ml\n0,\n"), HasSubstr("\"\" is not a number"));
  EXPECT_THAT(refusal("seconds,volume_ml\n0,1\n2\n"), HasSubstr("line 3 has 1 columns"));
  EXPECT_THAT(refusal("seconds,pressure\n"), HasSubstr("no column \"volume_ml\""));
  EXPECT_THAT(refusal("t,volume_ml\n"), HasSubstr("\"seconds\" or \"time_s\""));
  EXPECT_THAT(refusal("seconds,time_s,volume_ml\n"), HasSubstr("two columns"));
  EXPECT_THAT(refusal("\n# nothing\n"), HasSubstr("no table"));
  EXPECT_THROW(readNumberTable("gone.csv", Wanted), InputMissing);
}

}  // namespace
}  // namespace pneuma
