#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "render/baseline.h"
#include "render/generated_lungs.h"
#include "render/picture.h"

namespace pneuma {
namespace {

struct ImageCase {
  std::string name;
  std::string view;
  SceneOptions options;
};

void PrintTo(const ImageCase& image, std::ostream* out) { *out << image.name; }

class ImageTest : public testing::TestWithParam<ImageCase> {};

TEST_P(ImageTest, LooksLikeItsBaseline) {
  const ImageCase& image = GetParam();
  Scene scene;
  scene.setSurfaces(test::generatedLobes());
  scene.setTree(test::generatedTree());
  scene.setOptions(image.options);
  scene.look(viewDirection(image.view));
  const Picture picture = renderPicture(scene, 480, 360);
  test::expectLikeBaseline(picture, image.name);
}

INSTANTIATE_TEST_SUITE_P(
    Scene, ImageTest,
    testing::Values(
        ImageCase{"lobe", "A", {}}, ImageCase{"segment", "A", {.colourBy = ColourBy::Segment}},
        ImageCase{"generation", "A", {.colourBy = ColourBy::Generation}},
        ImageCase{"strahler", "A", {.colourBy = ColourBy::Strahler}},
        ImageCase{"diameter", "A", {.colourBy = ColourBy::Diameter}},
        ImageCase{"flow", "A", {.colourBy = ColourBy::Flow}},
        ImageCase{"huang_white", "A", {.palette = Palette::Huang, .background = Background::White}},
        ImageCase{"light", "-10,6", {.background = Background::Light}},
        ImageCase{"generation_light",
                  "P",
                  {.colourBy = ColourBy::Generation, .background = Background::Light}},
        ImageCase{"left", "L", {}}, ImageCase{"right", "R", {}}, ImageCase{"superior", "S", {}},
        ImageCase{"inferior", "I", {}},
        ImageCase{"three_generations", "A", {.maxGeneration = 3, .annotations = false}}),
    [](const testing::TestParamInfo<ImageCase>& each) { return each.param.name; });

}  // namespace
}  // namespace pneuma
