#include "core/options.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pneuma {

enum class Mode { Fast, Exact };

constexpr std::array<std::string_view, 2> choices(Mode) { return {"fast", "exact"}; }

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct SampleOptions {
  double lengthMm = 1.2;
  int count = 5;
  std::uint64_t seed = 1;
  Mode mode = Mode::Fast;

  static constexpr auto fields() {
    return std::tuple{
        Field{"min-length", &SampleOptions::lengthMm, "mm", Range{0.1, 10.0}, "Shortest branch."},
        Field{"count", &SampleOptions::count, "", Range{1, 100}, "How many."},
        Field{"seed", &SampleOptions::seed, "", Range{0, 9007199254740991.0}, "Seed."},
        Field{"mode", &SampleOptions::mode, "", Range{}, "How."},
    };
  }

  bool operator==(const SampleOptions&) const = default;
};

/// The message of the InvalidOption that `action` throws, "" if it throws none.
template <class Action>
std::string complaint(Action action) {
  try {
    action();
  } catch (const InvalidOption& error) {
    EXPECT_EQ(error.code(), ExitCode::Usage);
    return error.what();
  }
  return "";
}

std::string complaintAbout(std::string_view key, std::string_view text) {
  SampleOptions options;
  const std::string message = complaint([&] { setOption(options, key, text); });
  EXPECT_EQ(options, SampleOptions{}) << "a refused value was set";
  return message;
}

TEST(Options, AreListedInOrder) {
  std::vector<std::string> names;
  forEachField<SampleOptions>([&](const auto& field) { names.emplace_back(field.name); });
  EXPECT_THAT(names, ElementsAre("min-length", "count", "seed", "mode"));
}

TEST(SetOption, ReadsNumbersChoicesAndUnits) {
  SampleOptions options;
  setOption(options, "min-length", "0.41");
  EXPECT_EQ(options.lengthMm, 0.41);
  setOption(options, "min-length", "2.5mm");
  EXPECT_EQ(options.lengthMm, 2.5);
  setOption(options, "min-length", "3 mm");
  EXPECT_EQ(options.lengthMm, 3.0);
  setOption(options, "count", "1e1");
  EXPECT_EQ(options.count, 10);
  setOption(options, "seed", "9007199254740991");
  EXPECT_EQ(options.seed, 9007199254740991U);
  setOption(options, "mode", "exact");
  EXPECT_EQ(options.mode, Mode::Exact);
}

TEST(SetOption, KeepsTheLimitsThemselves) {
  SampleOptions options;
  setOption(options, "min-length", "0.1");
  EXPECT_EQ(options.lengthMm, 0.1);
  setOption(options, "min-length", "10");
  EXPECT_EQ(options.lengthMm, 10.0);
}

TEST(SetOption, NamesFieldRangeUnitAndValue) {
  EXPECT_EQ(complaintAbout("min-length", "-1"), "min-length must lie in [0.1, 10] mm, but is -1");
  EXPECT_THAT(complaintAbout("min-length", "10.001"), HasSubstr("[0.1, 10] mm"));
  EXPECT_THAT(complaintAbout("count", "0"), HasSubstr("[1, 100]"));
  EXPECT_THAT(complaintAbout("seed", "-1"), HasSubstr("seed"));
}

TEST(SetOption, RefusesWhatIsNoNumber) {
  for (const char* text : {"", "wide", "nan", "inf", "1e999", "mm", "--2"}) {
    EXPECT_THAT(complaintAbout("min-length", text), HasSubstr("min-length needs a number")) << text;
  }
}

TEST(SetOption, RefusesAnotherUnit) {
  EXPECT_THAT(complaintAbout("min-length", "1.2cm"), HasSubstr("is measured in mm"));
  EXPECT_THAT(complaintAbout("count", "3mm"), HasSubstr("has no unit"));
}

TEST(SetOption, RefusesAPartOfAWholeNumber) {
  EXPECT_THAT(complaintAbout("count", "2.5"), HasSubstr("count"));
}

TEST(SetOption, SuggestsTheNearestNameOrListsAll) {
  EXPECT_THAT(complaintAbout("min-lenght", "1"), HasSubstr("did you mean 'min-length'?"));
  EXPECT_THAT(complaintAbout("temperature", "1"), HasSubstr("min-length, count, seed, mode"));
}

TEST(SetOption, ListsTheChoices) {
  EXPECT_EQ(complaintAbout("mode", "slow"), "mode is one of fast, exact, but 'slow' was given");
}

TEST(RequireValid, NamesTheFirstFieldOutOfRange) {
  EXPECT_EQ(complaint([] { requireValid(SampleOptions{}); }), "");
  EXPECT_THAT(complaint([] { requireValid(SampleOptions{.lengthMm = 11.0, .count = 0}); }),
              HasSubstr("min-length must lie in [0.1, 10] mm, but is 11"));
  EXPECT_THAT(complaint([] {
                requireValid(SampleOptions{.lengthMm = std::numeric_limits<double>::quiet_NaN()});
              }),
              HasSubstr("min-length"));
}

TEST(TextOf, ReadsBackAsItIs) {
  EXPECT_EQ(textOf(0.1), "0.1");
  EXPECT_EQ(textOf(3), "3");
  EXPECT_EQ(textOf(Mode::Exact), "exact");
  EXPECT_EQ(std::stod(textOf(1.0 / 3.0)), 1.0 / 3.0);
}

TEST(NearestWord, FindsTheClosestOrNothing) {
  const std::vector<std::string_view> words = {"ratio", "rotation", "seed"};
  EXPECT_EQ(nearestWord("ration", words), "ratio");
  EXPECT_EQ(nearestWord("sede", words), "seed");
  EXPECT_EQ(nearestWord("diameter", words), "");
  EXPECT_EQ(nearestWord("x", {}), "");
}

}  // namespace
}  // namespace pneuma
