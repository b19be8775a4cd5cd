#include "io/text_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/refusal.h"
#include "io/temp_folder.h"

namespace pneuma {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class TextTables : public ::testing::Test {
 protected:
  TextTable read(const std::string& content) const {
    writeFile(folder_.path() / "t.csv", content);
    return readTextTable(folder_.path() / "t.csv");
  }

  std::string refusal(const std::string& content) const {
    return testing::refusalOf([&] { read(content); });
  }

 private:
  testing::TempFolder folder_;
};

TEST_F(TextTables, TakeEveryColumnAndKnowTheirLines) {
  const TextTable table =
      read("\xEF\xBB\xBF# mine\ncase, ct\n\na, /data/M\xC3\xBCller \r\nb,x y\n");
  EXPECT_THAT(table.columns, ElementsAre("case", "ct"));
  EXPECT_THAT(table.lines, ElementsAre(4U, 5U));
  EXPECT_THAT(table.rows[0], ElementsAre("a", "/data/M\xC3\xBCller"));
  EXPECT_THAT(table.rows[1], ElementsAre("b", "x y"));
}

TEST_F(TextTables, QuotationMarksHoldWhatPartsColumns) {
  const TextTable table = read("a;b\n\"x;y\"; \"he said \"\"ah\"\"\" \n\"\";\" z \"\n");
  EXPECT_THAT(table.rows[0], ElementsAre("x;y", "he said \"ah\""));
  EXPECT_THAT(table.rows[1], ElementsAre("", " z "));
  EXPECT_THAT(read("a,b\nx\"y\",2\n").rows[0], ElementsAre("x\"y\"", "2"));
}

TEST_F(TextTables, NameTheLineThatIsWrong) {
  EXPECT_THAT(refusal("a,b\n1,2\n1,2,3\n"),
              HasSubstr("line 3 has 3 columns, the first line has 2"));
  EXPECT_THAT(refusal("a,b\n\"1,2\n"), HasSubstr("line 2 has a quotation mark"));
  EXPECT_THAT(refusal("a,b\nM\xFCller,2\n"), HasSubstr("line 2 is not UTF-8"));
  EXPECT_THAT(refusal(std::string("a,b\n1\0,2\n", 9)), HasSubstr("line 2 holds a character that"));
  EXPECT_THAT(refusal("a,a\n"), HasSubstr("two columns \"a\""));
  EXPECT_THAT(refusal("a,,b\n"), HasSubstr("column 2 has no name"));
  EXPECT_THAT(refusal("# nothing\n\n"), HasSubstr("holds no table"));
}

}  // namespace
}  // namespace pneuma
