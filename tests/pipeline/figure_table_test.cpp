#include "pipeline/figure_table.h"

#include <gtest/gtest.h>

namespace pneuma {
namespace {

TEST(TextTable, AlignsColumnsByCharactersNotBytes) {
  EXPECT_EQ(textTable({{"a", "K\u00f6ln", "x"}, {"bcd", "1", "y"}}),
            "a    K\u00f6ln  x\n"
            "bcd  1     y\n");
}

TEST(TextTable, LeavesNoBlanksAtTheEndsOfLines) {
  EXPECT_EQ(textTable({{"a", "b"}, {"c"}}), "a  b\nc\n");
}

TEST(CsvQuoted, DoublesQuotationMarks) { EXPECT_EQ(csvQuoted("a \"b\", c"), "\"a \"\"b\"\", c\""); }

}  // namespace
}  // namespace pneuma
