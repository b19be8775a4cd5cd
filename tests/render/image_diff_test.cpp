#include <algorithm>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "render/generated_lungs.h"
#include "render/picture.h"

namespace pneuma {
namespace {

constexpr double Threshold = 0.03;
constexpr int ComparedWidth = 480;
constexpr int ComparedHeight = 360;

/// The same lungs drawn once right, and then with one thing wrong.
class ImageDifference : public testing::TestWithParam<Background> {
 protected:
  ImageDifference() {
    options_.background = GetParam();
    options_.lobeOpacity = 0.26;
    scene_.setSurfaces(test::generatedLobes());
    scene_.setTree(test::generatedTree());
    scene_.setOptions(options_);
    scene_.look({});
    reference_ = picture();
  }

  Picture picture() { return renderPicture(scene_, ComparedWidth, ComparedHeight); }

  double error(const Picture& other) const { return compare(other, reference_).error; }

  SceneOptions options_;
  Scene scene_;
  Picture reference_;
};

TEST_P(ImageDifference, IsZeroForThePictureDrawnAgain) { EXPECT_EQ(error(picture()), 0.0); }

TEST_P(ImageDifference, NoticesAHiddenLobe) {
  for (std::size_t lobe = 0; lobe < 5; ++lobe) {
    scene_.setSurfaceVisible(lobe, false);
    // The legend stays as it was: airways of the lobe are still there.
    EXPECT_GT(error(picture()), Threshold) << "lobe " << lobe;
    scene_.setSurfaceVisible(lobe, true);
  }
}

TEST_P(ImageDifference, NoticesAMirroredPicture) {
  Picture mirrored = reference_;
  for (int y = 0; y < ComparedHeight; ++y) {
    for (int x = 0; x < ComparedWidth; ++x) {
      const auto from = reference_.rgb.begin() + 3 * (y * ComparedWidth + x);
      std::copy_n(from, 3, mirrored.rgb.begin() + 3 * (y * ComparedWidth + ComparedWidth - 1 - x));
    }
  }
  EXPECT_GT(error(mirrored), Threshold);
}

TEST_P(ImageDifference, NoticesSwappedColourChannels) {
  Picture swapped = reference_;
  for (std::size_t i = 0; i < swapped.rgb.size(); i += 3) {
    std::swap(swapped.rgb[i], swapped.rgb[i + 2]);
  }
  EXPECT_GT(error(swapped), Threshold);
}

TEST_P(ImageDifference, NoticesSwappedLobeColours) {
  std::vector<SceneSurface> surfaces = test::generatedLobes();
  std::swap(surfaces[3].lobe, surfaces[4].lobe);
  scene_.setSurfaces(surfaces);
  EXPECT_GT(error(picture()), Threshold);
}

TEST_P(ImageDifference, NoticesACameraTurnedByTwoDegrees) {
  scene_.look({2.0, 0.0});
  EXPECT_GT(error(picture()), Threshold);
  scene_.look({0.0, 2.0});
  EXPECT_GT(error(picture()), Threshold);
}

TEST_P(ImageDifference, NoticesOpacityChangedByFivePercent) {
  options_.lobeOpacity = 1.05 * 0.26;
  scene_.setOptions(options_);
  EXPECT_GT(error(picture()), Threshold);
  options_.lobeOpacity = 0.95 * 0.26;
  scene_.setOptions(options_);
  EXPECT_GT(error(picture()), Threshold);
}

TEST_P(ImageDifference, OverlooksGrainOfTwoGreyLevels) {
  Random random(1);
  Picture grainy = reference_;
  for (std::uint8_t& value : grainy.rgb) {
    const int moved = value + static_cast<int>(random.below(5)) - 2;
    value = static_cast<std::uint8_t>(std::clamp(moved, 0, 255));
  }
  EXPECT_LT(error(grainy), Threshold);
  EXPECT_GT(error(grainy), 0.0);
}

TEST_P(ImageDifference, ShowsWhereThePicturesDiffer) {
  Picture marked = reference_;
  for (int y = 100; y < 120; ++y) {
    std::fill_n(marked.rgb.begin() + 3 * (y * ComparedWidth + 50), 60, std::uint8_t{255});
  }
  const Picture difference = compare(marked, reference_).difference;
  const auto at = [&](int x, int y) {
    return difference.rgb[static_cast<std::size_t>(3 * (y * ComparedWidth + x))];
  };
  EXPECT_GT(at(60, 110), 50);
  EXPECT_EQ(at(300, 250), 0);
}

INSTANTIATE_TEST_SUITE_P(Grounds, ImageDifference,
                         testing::Values(Background::Dark, Background::Light),
                         [](const testing::TestParamInfo<Background>& each) {
                           return each.param == Background::Dark ? "Dark" : "Light";
                         });

TEST(PictureComparison, NeedsPicturesOfOneSize) {
  const Picture small{2, 2, std::vector<std::uint8_t>(12)};
  const Picture large{2, 3, std::vector<std::uint8_t>(18)};
  EXPECT_THROW(compare(small, large), InvalidInput);
}

}  // namespace
}  // namespace pneuma
