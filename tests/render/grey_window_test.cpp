#include "render/grey_window.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace pneuma {
namespace {

TEST(GreyWindow, RunsFromBlackToWhiteOverItsWidth) {
  const GreyWindow lung{1500.0, -600.0};
  EXPECT_EQ(lung.grey(-1350.0), 0);
  EXPECT_EQ(lung.grey(-3000.0), 0);
  EXPECT_EQ(lung.grey(-600.0), 128);
  EXPECT_EQ(lung.grey(150.0), 255);
  EXPECT_EQ(lung.grey(3000.0), 255);
}

TEST(GreyWindow, IsGivenByNameOrByWidthAndLevel) {
  EXPECT_EQ(greyWindow("lung"), (GreyWindow{1500.0, -600.0}));
  EXPECT_EQ(greyWindow("lung-soft"), (GreyWindow{1400.0, -500.0}));
  EXPECT_EQ(greyWindow("mediastinum"), (GreyWindow{350.0, 40.0}));
  EXPECT_EQ(greyWindow("bone"), (GreyWindow{2000.0, 300.0}));
  EXPECT_EQ(greyWindow("emphysema"), (GreyWindow{500.0, -850.0}));
  EXPECT_EQ(greyWindow("1200/-450.5"), (GreyWindow{1200.0, -450.5}));
  EXPECT_EQ(greyWindows().front().window, GreyWindow{});
}

TEST(GreyWindow, RefusesWhatIsNone) {
  for (const char* text : {"", "lungs", "1500", "/", "1500/", "/-600", "0/-600", "-5/0", "nan/0",
                           "1500/-600/3", "1e9/0", "1500/1e9"}) {
    EXPECT_THROW(greyWindow(text), InvalidOption) << text;
  }
  try {
    greyWindow("medistinum");
    FAIL();
  } catch (const InvalidOption& error) {
    EXPECT_NE(std::string(error.what()).find("'mediastinum'"), std::string::npos);
  }
}

TEST(GreyWindow, IsToldWithItsName) {
  EXPECT_EQ(textOf(GreyWindow{}), "Lung   W 1500   L -600");
  EXPECT_EQ(textOf(GreyWindow{900.0, -333.0}), "W 900   L -333");
}

}  // namespace
}  // namespace pneuma
