#include "render/breathing_filter.h"

#include <cmath>

#include <gtest/gtest.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include "core/error.h"

namespace pneuma {
namespace {

/// Three points, each displaced by its own number along z.
vtkSmartPointer<vtkPolyData> triangle(const char* array) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> displacement;
  displacement->SetName(array);
  displacement->SetNumberOfComponents(3);
  for (int n = 0; n < 3; ++n) {
    points->InsertNextPoint(10.0 * n, 5.0, 0.0);
    displacement->InsertNextTuple3(0.0, 0.0, n + 1.0);
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(displacement);
  return data;
}

TEST(BreathingFilter, AnswersRequestsForAnyTime) {
  vtkNew<BreathingFilter> filter;
  filter->SetInputData(triangle("displacement"));
  filter->setBreath({0.0, 2.0, 5.0}, {0.0, 1.0, 0.0});
  filter->UpdateInformation();
  vtkInformation* info = filter->GetOutputInformation(0);
  ASSERT_EQ(info->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()), 3);
  EXPECT_EQ(info->Get(vtkStreamingDemandDrivenPipeline::TIME_RANGE())[1], 5.0);
  const auto heightAt = [&](double seconds) {
    filter->UpdateTimeStep(seconds);
    EXPECT_EQ(filter->GetOutput()->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), seconds);
    return filter->GetOutput()->GetPoint(2)[2];
  };
  EXPECT_DOUBLE_EQ(heightAt(0.0), 0.0);
  EXPECT_DOUBLE_EQ(heightAt(1.0), 1.5);
  EXPECT_DOUBLE_EQ(heightAt(2.0), 3.0);
  EXPECT_DOUBLE_EQ(heightAt(3.5), 1.5);
  EXPECT_DOUBLE_EQ(heightAt(6.0), 1.5) << "the next breath";
  EXPECT_DOUBLE_EQ(filter->GetOutput()->GetPoint(2)[0], 20.0);
  EXPECT_EQ(filter->GetInput()->GetNumberOfElements(vtkDataObject::POINT), 3);
}

TEST(BreathingFilter, TurnsNormalsIfItKnowsHow) {
  const auto data = triangle("displacement");
  vtkNew<vtkFloatArray> normals;
  vtkNew<vtkFloatArray> slope;
  for (vtkFloatArray* array : {normals.Get(), slope.Get()}) array->SetNumberOfComponents(3);
  normals->SetName("Normals");
  slope->SetName("normal_slope");
  for (int n = 0; n < 3; ++n) {
    normals->InsertNextTuple3(1.0, 0.0, 0.0);
    slope->InsertNextTuple3(0.0, 2.0, 0.0);
  }
  data->GetPointData()->SetNormals(normals);
  vtkNew<BreathingFilter> filter;
  filter->SetInputData(data);
  filter->setBreath({0.0, 1.0}, {0.0, 1.0});
  filter->UpdateTimeStep(0.5);
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetNormals(), nullptr) << "of the lungs at rest";
  data->GetPointData()->AddArray(slope);
  data->Modified();
  filter->UpdateTimeStep(0.5);
  vtkDataArray* turned = filter->GetOutput()->GetPointData()->GetNormals();
  ASSERT_NE(turned, nullptr);
  EXPECT_NEAR(turned->GetComponent(1, 0), std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(turned->GetComponent(1, 1), std::sqrt(0.5), 1e-6);
  EXPECT_EQ(normals->GetComponent(1, 1), 0.0) << "the input stays";
}

TEST(BreathingFilter, MovesPointsOfSinglePrecisionToo) {
  const auto data = triangle("displacement");
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  for (int n = 0; n < 3; ++n) points->InsertNextPoint(10.0 * n, 5.0, 0.0);
  data->SetPoints(points);
  vtkNew<BreathingFilter> filter;
  filter->SetInputData(data);
  filter->setBreath({0.0, 1.0}, {0.0, 1.0});
  filter->UpdateTimeStep(0.5);
  EXPECT_EQ(filter->GetOutput()->GetPoints()->GetDataType(), VTK_FLOAT);
  EXPECT_DOUBLE_EQ(filter->GetOutput()->GetPoint(2)[2], 1.5);
  EXPECT_DOUBLE_EQ(filter->GetOutput()->GetPoint(2)[0], 20.0);
}

TEST(BreathingFilter, TakesItsArrayByName) {
  vtkNew<BreathingFilter> filter;
  filter->SetInputData(triangle("u"));
  filter->SetDisplacementArray("u");
  filter->setBreath({0.0, 1.0}, {0.0, 2.0});
  filter->UpdateTimeStep(0.5);
  EXPECT_DOUBLE_EQ(filter->GetOutput()->GetPoint(0)[2], 1.0);
}

TEST(BreathingFilter, RefusesABreathThatIsNone) {
  vtkNew<BreathingFilter> filter;
  EXPECT_THROW(filter->setBreath({0.0}, {0.0}), InvalidOption);
  EXPECT_THROW(filter->setBreath({0.0, 1.0}, {0.0}), InvalidOption);
  EXPECT_THROW(filter->setBreath({0.0, 1.0, 1.0}, {0.0, 1.0, 0.0}), InvalidOption);
}

}  // namespace
}  // namespace pneuma
