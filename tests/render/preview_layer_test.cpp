#include "render/preview_layer.h"

#include <vector>

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkMapper.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>

namespace pneuma {
namespace {

constexpr std::size_t Most = 200'000;

/// Points first, first + 1 ... on the x axis.
std::vector<Vec3> row(std::size_t first, std::size_t count) {
  std::vector<Vec3> points;
  for (std::size_t i = first; i < first + count; ++i) {
    points.emplace_back(static_cast<double>(i), 0.0, 0.0);
  }
  return points;
}

class Preview : public testing::Test {
 protected:
  /// The x of all dots, as the renderer finds them.
  std::vector<double> drawn() const {
    std::vector<double> result;
    vtkActorCollection* actors = renderer_->GetActors();
    actors->InitTraversal();
    while (vtkActor* actor = actors->GetNextActor()) {
      auto* data = vtkPolyData::SafeDownCast(actor->GetMapper()->GetInput());
      EXPECT_EQ(data->GetNumberOfVerts(), data->GetNumberOfPoints());
      for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
        result.push_back(data->GetPoint(i)[0]);
      }
    }
    return result;
  }

  vtkNew<vtkRenderer> renderer_;
  PreviewLayer preview_{renderer_};
};

TEST_F(Preview, DrawsEveryPointOfAFew) {
  preview_.add(row(0, 15'000));
  preview_.add(row(15'000, 7));
  EXPECT_EQ(preview_.points(), 15'007U);
  EXPECT_EQ(preview_.dots(), 15'007U);
  const std::vector<double> x = drawn();
  ASSERT_EQ(x.size(), 15'007U);
  for (std::size_t i = 0; i < x.size(); ++i) ASSERT_EQ(x[i], static_cast<double>(i));
}

TEST_F(Preview, OfManyPointsDrawsEveryNthHoweverTheyCome) {
  std::vector<double> atOnce;
  preview_.add(row(0, 1'000'000));
  atOnce = drawn();
  EXPECT_EQ(preview_.points(), 1'000'000U);
  EXPECT_EQ(preview_.dots(), atOnce.size());
  EXPECT_LE(atOnce.size(), Most);
  EXPECT_GT(atOnce.size(), Most / 2);
  for (std::size_t i = 0; i < atOnce.size(); ++i)
    ASSERT_EQ(atOnce[i], 8.0 * static_cast<double>(i));
  preview_.clear();
  for (std::size_t i = 0; i < 1'000'000; i += 777) {
    preview_.add(row(i, std::min<std::size_t>(777, 1'000'000 - i)));
    ASSERT_LE(preview_.dots(), Most);
  }
  EXPECT_EQ(drawn(), atOnce);
}

TEST_F(Preview, KnowsTheBoxOfAllPointsAndForgetsIt) {
  EXPECT_TRUE(preview_.box().isEmpty());
  preview_.add(row(0, Most + 2));
  EXPECT_EQ(preview_.box().max().x(), static_cast<double>(Most + 1));  // which is no dot
  preview_.clear();
  EXPECT_TRUE(preview_.box().isEmpty());
  EXPECT_EQ(preview_.points(), 0U);
  EXPECT_EQ(renderer_->GetActors()->GetNumberOfItems(), 0);
}

}  // namespace
}  // namespace pneuma
