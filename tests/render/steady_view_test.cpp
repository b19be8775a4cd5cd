#include "render/steady_view.h"

#include <memory>

#include <gtest/gtest.h>

#include "core/error.h"

namespace pneuma {
namespace {

/// A tetrahedron that moves to the patient's left.
void showMoving(Scene& scene) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {40, 0, 0}, {0, 40, 0}, {0, 0, 40}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  scene.setSurfaces({{Lobe::LeftUpper, std::make_shared<const TriangleMesh>(mesh)}});
  auto breathing = std::make_shared<BreathingScene>();
  breathing->surfaces.push_back({Side::Left, std::vector<Vec3>(4, Vec3(20, 0, 0)), {}});
  scene.setBreathing(std::move(breathing));
  scene.look({});
}

TEST(SteadyView, DrawsWhatSinglePicturesShow) {
  constexpr int Width = 160;
  constexpr int Height = 120;
  Scene scene;
  showMoving(scene);
  std::vector<Picture> steady;
  {
    SteadyView view(scene, Width, Height);
    for (const double s : {0.0, 0.5, 1.0, 0.0}) {
      scene.setBreath({0.0, s, 0.0});
      steady.push_back(view.draw());
    }
  }
  EXPECT_EQ(steady[0].rgb, steady[3].rgb);
  for (const std::size_t n : {0U, 1U, 2U}) {
    scene.setBreath({0.0, 0.5 * static_cast<double>(n), 0.0});
    EXPECT_EQ(renderPicture(scene, Width, Height).rgb, steady[n].rgb) << n;
    if (n == 0) continue;
    EXPECT_NE(steady[n].rgb, steady[n - 1].rgb) << n;
  }
}

TEST(SteadyView, RefusesASizeThatCannotBeDrawn) {
  Scene scene;
  EXPECT_THROW(SteadyView(scene, 8, 120), InvalidOption);
}

}  // namespace
}  // namespace pneuma
