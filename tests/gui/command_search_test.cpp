#include "document/command_search.h"

#include <gtest/gtest.h>

namespace pneuma {
namespace {

std::vector<QString> found(const QString& typed, const std::vector<QString>& texts) {
  std::vector<QString> answers;
  for (const std::size_t index : bestCommands(typed, texts)) answers.push_back(texts[index]);
  return answers;
}

TEST(CommandSearch, NothingTypedFindsEverythingInItsOrder) {
  const std::vector<QString> texts = {"Undo", "Grow airways", "Find lungs"};
  EXPECT_EQ(found("", texts), texts);
  EXPECT_EQ(found("  ", texts), texts);
  EXPECT_TRUE(matchCommand("", "Undo")->hits.empty());
}

TEST(CommandSearch, TakesWordsInAnyOrderWhateverTheCase) {
  EXPECT_TRUE(matchCommand("AIRWAYS grow", "Grow airways"));
  EXPECT_TRUE(matchCommand("lob spl", "Split into lobes"));
  EXPECT_FALSE(matchCommand("grow lobes", "Grow airways"));
}

TEST(CommandSearch, TakesAccentsForTheirLetters) {
  const auto match = matchCommand("coro", QString::fromUtf8("Vue c\u00f4rnale c\u00f4ronale"));
  ASSERT_TRUE(match);
  EXPECT_EQ(match->hits, (std::vector<int>{12, 13, 14, 15}));
  EXPECT_TRUE(matchCommand(QString::fromUtf8("\u00fcndo"), "Undo"));
}

TEST(CommandSearch, ABeginningIsBetterThanAnInside) {
  // "Save tree" has it at the beginning of a word, "Retreat" inside of one.
  EXPECT_EQ(found("tree", {"Overtrees", "Save tree"}).front(), "Save tree");
  // A whole word is better than the beginning of a longer one.
  EXPECT_EQ(found("lung", {"Lungs of the CT", "Lung window"}).front(), "Lung window");
}

TEST(CommandSearch, TakesFirstLettersOfWords) {
  const auto match = matchCommand("fl", "Find lungs");
  ASSERT_TRUE(match);
  EXPECT_EQ(match->hits, (std::vector<int>{0, 5}));
  EXPECT_EQ(found("sl", {"Slices: fainter", "Split lobes"}).front(), "Slices: fainter");
}

TEST(CommandSearch, TakesLettersThatFollowClosely) {
  const auto match = matchCommand("brth", "Breathe");
  ASSERT_TRUE(match);
  EXPECT_EQ(match->hits, (std::vector<int>{0, 1, 4, 5}));
  // But not letters from anywhere, or every text would have them.
  EXPECT_FALSE(matchCommand("brth", "Batch of recipes into the hub"));
  EXPECT_FALSE(matchCommand("rth", "Breathe"));
}

TEST(CommandSearch, SaysWhichLettersWereMeant) {
  EXPECT_EQ(matchCommand("lobe", "Hide: Right upper lobe")->hits,
            (std::vector<int>{18, 19, 20, 21}));
  EXPECT_EQ(matchCommand("hi up", "Hide: Right upper lobe")->hits,
            (std::vector<int>{0, 1, 12, 13}));
}

TEST(CommandSearch, EquallyGoodOnesKeepTheirOrder) {
  EXPECT_EQ(found("window", {"Window: bone", "Window: lung"}),
            (std::vector<QString>{"Window: bone", "Window: lung"}));
}

}  // namespace
}  // namespace pneuma
