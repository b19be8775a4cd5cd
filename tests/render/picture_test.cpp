#include "render/picture.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.h"
#include "core/triangle_mesh.h"
#include "render/generated_lungs.h"
#include "render/small_picture.h"

namespace pneuma {
namespace {

Picture gradient(int width, int height) {
  Picture picture{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (const int value : {x * 5, y * 7, x + y}) {
        picture.rgb.push_back(static_cast<std::uint8_t>(value));
      }
    }
  }
  return picture;
}

/// A file that is gone at the end of the test.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content)
      : path_(std::filesystem::temp_directory_path() /
              ("pneuma_picture_test_" + std::to_string(::getpid()) + ".png")) {
    std::ofstream(path_, std::ios::binary) << content;
  }

  ~TemporaryFile() { std::filesystem::remove(path_); }

  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Changes $DISPLAY for the length of a test.
class Display {
 public:
  explicit Display(const char* name) {
    if (const char* before = std::getenv("DISPLAY"); before != nullptr) before_ = before;
    setenv("DISPLAY", name, 1);
  }

  ~Display() { before_ ? setenv("DISPLAY", before_->c_str(), 1) : unsetenv("DISPLAY"); }

  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

 private:
  std::optional<std::string> before_;
};

TEST(Png, ReadsBackWhatItWrote) {
  const Picture picture = gradient(37, 23);
  const TemporaryFile file(pngText(picture));
  const Picture back = readPng(file.path());
  EXPECT_EQ(back.width, 37);
  EXPECT_EQ(back.height, 23);
  EXPECT_EQ(back.rgb, picture.rgb);
}

TEST(Png, MissingFileIsMissing) { EXPECT_THROW(readPng("no/such/picture.png"), InputMissing); }

TEST(Png, DamagedFilesAreRefused) {
  const std::string whole = pngText(gradient(64, 48));
  std::string flipped = whole;
  flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 0x10);
  std::string huge = whole;
  huge[16] = 0x7f;
  for (const std::string& content :
       {std::string(), std::string("not a picture at all"), whole.substr(0, 20),
        whole.substr(0, whole.size() / 2), whole.substr(0, whole.size() - 5), flipped, huge}) {
    const TemporaryFile file(content);
    EXPECT_THROW(readPng(file.path()), InvalidInput) << content.size() << " bytes";
  }
}

TEST(Png, ThatIsLargerThanAskedForIsNotDecoded) {
  const std::string content = pngText(gradient(64, 48));
  EXPECT_EQ(pngPicture(content, "the picture", 64).width, 64);
  EXPECT_THROW(pngPicture(content, "the picture", 63), InvalidInput);
}

TEST(Png, KeepsPixelsAndNoText) {
  std::string content = pngText(gradient(64, 48));
  // What other programs leave in a picture, before its first pixels: a title, as PNG has it.
  const std::string title(
      "\0\0\0\x0e"
      "tEXtTitle\0"
      "DOE_JANE"
      "\xd1\x2b\x8a\x97",
      26);
  content.insert(33, title);
  const Picture back = pngPicture(content, "the picture");
  EXPECT_EQ(back.rgb, gradient(64, 48).rgb);
  EXPECT_EQ(pngText(back).find("DOE"), std::string::npos);
}

TEST(FittedPicture, IsTheMeanOfWhatEachPixelCovers) {
  Picture picture{8, 4, std::vector<std::uint8_t>(8 * 4 * 3, 0)};
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 8; ++column) {
      picture.rgb[static_cast<std::size_t>((row * 8 + column) * 3)] =
          static_cast<std::uint8_t>(column < 4 ? 40 : 200);
      picture.rgb[static_cast<std::size_t>((row * 8 + column) * 3 + 2)] =
          static_cast<std::uint8_t>(row % 2 == 0 ? 100 : 200);
    }
  }
  const Picture half = fitted(picture, 4);
  EXPECT_EQ(half.width, 4);
  EXPECT_EQ(half.height, 2);
  EXPECT_EQ(half.rgb,
            (std::vector<std::uint8_t>{40, 0, 150, 40, 0, 150, 200, 0, 150, 200, 0, 150,
                                       40, 0, 150, 40, 0, 150, 200, 0, 150, 200, 0, 150}));
  EXPECT_EQ(fitted(picture, 8).rgb, picture.rgb);
  EXPECT_EQ(fitted(picture, 100).width, 8);
  const Picture line = fitted(Picture{1000, 2, std::vector<std::uint8_t>(6000, 7)}, 16);
  EXPECT_EQ(line.height, 1);
  EXPECT_EQ(line.rgb, std::vector<std::uint8_t>(48, 7));
}

TEST(ContactSheet, HoldsThePicturesInRows) {
  const Picture dark{60, 40, std::vector<std::uint8_t>(60 * 40 * 3, 10)};
  const Picture bright{60, 40, std::vector<std::uint8_t>(60 * 40 * 3, 250)};
  const Picture sheet = contactSheet({dark, bright, dark}, 2, {"one", "two", "three"});
  EXPECT_EQ(sheet.width, 120);
  EXPECT_GT(sheet.height, 80);
  EXPECT_EQ(sheet.rgb[3 * (10 * 120 + 10)], 10);
  EXPECT_EQ(sheet.rgb[3 * (10 * 120 + 70)], 250);
  int captionPixels = 0;
  for (int y = 40; y < sheet.height / 2; ++y) {
    for (int x = 0; x < 60; ++x) {
      captionPixels += sheet.rgb[static_cast<std::size_t>(3 * (y * 120 + x))] > 120 ? 1 : 0;
    }
  }
  EXPECT_GT(captionPixels, 10);
}

/// Pixels of a dark sheet in columns [left, right) and rows [top, bottom) that are bright.
int brightPixels(const Picture& sheet, int left, int right, int top, int bottom) {
  int count = 0;
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      count += sheet.rgb[static_cast<std::size_t>(3 * (y * sheet.width + x))] > 60 ? 1 : 0;
    }
  }
  return count;
}

TEST(ContactSheet, WritesCaptionsOfSeveralLines) {
  const Picture dark{200, 100, std::vector<std::uint8_t>(200 * 100 * 3, 10)};
  const Picture oneLine = contactSheet({dark}, 1, {"one"});
  const Picture twoLines = contactSheet({dark}, 1, {"one\ntwo"});
  EXPECT_GT(twoLines.height, oneLine.height + 10);
  EXPECT_GT(brightPixels(twoLines, 0, 200, oneLine.height, twoLines.height), 5);
}

TEST(ContactSheet, LongCaptionsStayBelowTheirPicture) {
  const Picture dark{200, 100, std::vector<std::uint8_t>(200 * 100 * 3, 10)};
  for (const std::size_t length : {30U, 300U}) {
    const Picture sheet = contactSheet({dark, dark, dark}, 3, {"", std::string(length, 'W'), "x"});
    EXPECT_EQ(brightPixels(sheet, 0, 203, 100, sheet.height), 0) << length;
    EXPECT_EQ(brightPixels(sheet, 397, 490, 100, sheet.height), 0) << length;
    EXPECT_GT(brightPixels(sheet, 210, 390, 100, sheet.height), 100) << length;
  }
}

TEST(ContactSheet, PutsTheLegendAtTheEndOfEveryRow) {
  const Picture dark{60, 40, std::vector<std::uint8_t>(60 * 40 * 3, 10)};
  const Picture legend{20, 40, std::vector<std::uint8_t>(20 * 40 * 3, 250)};
  const Picture sheet = contactSheet({dark, dark, dark}, 2, {"", "", ""}, legend);
  EXPECT_EQ(sheet.width, 140);
  const int cell = sheet.height / 2;
  EXPECT_EQ(brightPixels(sheet, 120, 140, 0, 40), 20 * 40);
  EXPECT_EQ(brightPixels(sheet, 120, 140, cell, cell + 40), 20 * 40);
  EXPECT_EQ(brightPixels(sheet, 0, 120, 0, sheet.height), 0);
  EXPECT_EQ(brightPixels(sheet, 120, 140, 40, cell), 0);
}

TEST(ContactSheet, NeedsPicturesOfOneSizeAndACaptionEach) {
  EXPECT_THROW(contactSheet({}, 2, {}), InvalidInput);
  EXPECT_THROW(contactSheet({gradient(4, 4)}, 1, {}), InvalidInput);
  EXPECT_THROW(contactSheet({gradient(4, 4), gradient(5, 4)}, 2, {"a", "b"}), InvalidInput);
  EXPECT_THROW(contactSheet({gradient(4, 4)}, 1, {"a"}, gradient(4, 5)), InvalidInput);
}

TEST(RenderPicture, SaysHowToGetADisplayWhereThereIsNone) {
  Scene scene;
  for (const char* name : {"", ":987", "nonsense"}) {
    const Display display(name);
    EXPECT_FALSE(canRender());
    try {
      renderPicture(scene, 100, 100);
      FAIL() << name;
    } catch (const NoRendering& error) {
      EXPECT_NE(std::string(error.what()).find("xvfb-run -a"), std::string::npos);
    }
  }
  EXPECT_TRUE(canRender());
}

TEST(RenderPicture, RefusesSizesThatCannotBe) {
  Scene scene;
  EXPECT_THROW(renderPicture(scene, 15, 100), InvalidOption);
  EXPECT_THROW(renderPicture(scene, 100, 8193), InvalidOption);
}

TEST(RenderPicture, DrawsAnEmptyScene) {
  Scene scene;
  const Picture picture = renderPicture(scene, 64, 48);
  EXPECT_EQ(picture.rgb.size(), 64U * 48 * 3);
}

TEST(RenderPicture, DrawsTheSceneFilledAndUncut) {
  Scene scene;
  scene.setSurfaces(test::generatedLobes());
  scene.setOptions({.background = Background::White, .annotations = false});
  for (const auto& [width, height] : {std::pair{300, 200}, std::pair{150, 300}}) {
    scene.look(viewDirection("30,10"));
    const Picture picture = renderPicture(scene, width, height);
    int left = width;
    int right = 0;
    int top = height;
    int bottom = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const std::size_t at = static_cast<std::size_t>(3 * (y * width + x));
        if (picture.rgb[at] > 245 && picture.rgb[at + 1] > 245) continue;
        left = std::min(left, x);
        right = std::max(right, x);
        top = std::min(top, y);
        bottom = std::max(bottom, y);
      }
    }
    EXPECT_GT(left, 0);
    EXPECT_GT(top, 0);
    EXPECT_LT(right, width - 1);
    EXPECT_LT(bottom, height - 1);
    EXPECT_TRUE(right - left > 0.88 * width || bottom - top > 0.88 * height);
  }
}

TEST(RenderPicture, DrawsCopiesOfATriangleOnce) {
  TriangleMesh flap{{{0, 0, 0}, {50, 0, 10}, {0, 0, 60}, {-40, 10, 5}}, {{0, 1, 2}, {0, 2, 3}}};
  const auto drawn = [&] {
    Scene scene;
    scene.setSurfaces({{Lobe::Whole, std::make_shared<const TriangleMesh>(flap)}});
    return renderPicture(scene, 80, 60).rgb;
  };
  const auto once = drawn();
  for (int copy = 0; copy < 30; ++copy) {
    flap.triangles.push_back({1, 2, 0});
    flap.triangles.push_back({0, 2, 3});
  }
  EXPECT_EQ(drawn(), once);
}

}  // namespace
}  // namespace pneuma
