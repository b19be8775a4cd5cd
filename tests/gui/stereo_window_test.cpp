#include <QAction>
#include <QImage>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "render/stereo.h"
#include "window_fixture.h"

namespace pneuma {
namespace {

using testing::WindowTest;

class StereoWindowTest : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    openChestFromFiles();
    window.view().look({});
  }

  QImage seen(const char* kind, double mm) {
    find<QAction>(("actionStereo_" + std::string(kind)).c_str()).trigger();
    find<QDoubleSpinBox>("eyeDistance").setValue(mm);
    QTest::qWait(600);  // the fine picture
    return window.view().picture().convertToFormat(QImage::Format_RGB888);
  }
};

/// The mean difference of what `of` says of the pixels of two pictures of one size.
template <class Of>
double difference(const QImage& a, const QImage& b, const Of& of) {
  EXPECT_EQ(a.size(), b.size());
  double sum = 0.0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) sum += std::abs(of(a.pixel(x, y)) - of(b.pixel(x, y)));
  }
  return sum / (a.width() * a.height());
}

double brightnessOf(QRgb c) { return 0.299 * qRed(c) + 0.587 * qGreen(c) + 0.114 * qBlue(c); }

TEST_F(StereoWindowTest, CrossedIsSideBySideWithTheHalvesSwapped) {
  const QImage beside = seen("side-by-side", 65.0);
  const QImage crossed = seen("crossed", 65.0);
  const int half = beside.width() / 2;
  ASSERT_EQ(beside.width() % 2, 0);
  const QRect left(0, 0, half, beside.height());
  const QRect right(half, 0, half, beside.height());
  // But for the last bit of where triangles end, which halves round differently.
  EXPECT_LT(difference(beside.copy(left), crossed.copy(right), brightnessOf), 0.01);
  EXPECT_LT(difference(beside.copy(right), crossed.copy(left), brightnessOf), 0.01);
  EXPECT_GT(difference(beside.copy(left), beside.copy(right), brightnessOf), 0.5)
      << "both eyes see the same";
}

// Eyes all but in one place see what one eye sees: red is its brightness, the rest its own.
TEST_F(StereoWindowTest, AnAnaglyphIsHalfColoured) {
  const QImage one = seen("none", 65.0);
  const auto redOf = [](QRgb c) { return static_cast<double>(qRed(c)); };
  const auto cyanOf = [](QRgb c) { return 0.5 * (qGreen(c) + qBlue(c)); };
  const QImage near = seen("anaglyph", 1.0);
  QImage grey = one;
  for (int y = 0; y < one.height(); ++y) {
    for (int x = 0; x < one.width(); ++x) {
      const int red = static_cast<int>(std::lround(brightnessOf(one.pixel(x, y))));
      grey.setPixel(x, y, qRgb(red, 0, 0));
    }
  }
  EXPECT_LT(difference(near, grey, redOf), 0.6);
  EXPECT_LT(difference(near, one, cyanOf), 0.6);
  const QImage far = seen("anaglyph", 65.0);
  EXPECT_GT(difference(far, one, cyanOf), 4.0 * difference(near, one, cyanOf));
  EXPECT_EQ(seen("none", 65.0), one) << "one eye sees again what it saw";
}

QImage imageOf(const Picture& picture) {
  return QImage(picture.rgb.data(), picture.width, picture.height, 3 * picture.width,
                QImage::Format_RGB888)
      .copy();
}

TEST_F(StereoWindowTest, EyesSeeWhatTheySeeInAPicture) {
  Scene scene;
  scene.setOptions(window.view().options());
  std::vector<SceneSurface> surfaces;
  for (const LobeSurface& lobe : *window.document().model().surfaces) {
    surfaces.push_back({lobe.lobe, lobe.mesh});
  }
  scene.setSurfaces(std::move(surfaces));
  scene.setTree(window.document().tree());
  scene.look({});
  const auto redOf = [](QRgb c) { return static_cast<double>(qRed(c)); };
  const auto greenOf = [](QRgb c) { return static_cast<double>(qGreen(c)); };
  for (const Stereo kind : {Stereo::Anaglyph, Stereo::Crossed}) {
    const std::string name(choices(Stereo{})[static_cast<std::size_t>(kind)]);
    const QImage image = seen(name.c_str(), 65.0);
    const auto picture = [&](double mm) {
      return imageOf(renderStereo(scene, image.width(), image.height(), {kind, mm}));
    };
    const QImage apart = picture(65.0);
    const QImage together = picture(1.0);
    // The window averages no pixels; eyes in each other's place would be off by more than in one.
    EXPECT_LT(difference(image, apart, redOf), 0.75 * difference(image, together, redOf)) << name;
    EXPECT_LT(difference(image, apart, greenOf), 0.75 * difference(image, together, greenOf))
        << name;
  }
}

TEST_F(StereoWindowTest, AClickTakesTheBranchInEitherHalf) {
  seen("side-by-side", 65.0);
  SceneView& view = window.view();
  std::vector<std::size_t> taken;
  QObject::connect(&view, &SceneView::clicked, &window, [&](std::optional<std::size_t> branch) {
    if (branch) taken.push_back(*branch);
  });
  const Branch& trachea = (*window.document().tree())[0];
  const QPoint left = view.positionOf(0.5 * (trachea.proximal + trachea.distal));
  EXPECT_LT(left.x(), view.canvas()->width() / 2);
  const QPoint right = left + QPoint(view.canvas()->width() / 2, 0);
  for (const QPoint& at : {left, right}) {
    QTest::mouseClick(view.canvas(), Qt::LeftButton, {}, at);
  }
  EXPECT_EQ(taken, (std::vector<std::size_t>{0, 0}));
}

}  // namespace
}  // namespace pneuma
