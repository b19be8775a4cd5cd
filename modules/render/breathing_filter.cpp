#include "render/breathing_filter.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include "core/error.h"
#include "core/moving_points.h"

namespace pneuma {
namespace {

/// An array as `Array`, which is itself if it is one.
template <class Array>
vtkSmartPointer<Array> as(vtkDataArray& array) {
  if (Array* same = Array::SafeDownCast(&array)) return same;
  auto copy = vtkSmartPointer<Array>::New();
  copy->DeepCopy(&array);
  return copy;
}

template <class Array>
auto numbers(Array& array) {
  return std::span(array.GetPointer(0), static_cast<std::size_t>(array.GetNumberOfValues()));
}

template <class Array>
vtkSmartPointer<Array> likeThat(vtkDataArray& array) {
  auto result = vtkSmartPointer<Array>::New();
  result->SetNumberOfComponents(3);
  result->SetNumberOfTuples(array.GetNumberOfTuples());
  return result;
}

/// In the precision of the points.
vtkSmartPointer<vtkDataArray> moved(vtkDataArray& points, vtkDataArray& displacement, double s) {
  if (points.GetDataType() == VTK_FLOAT) {
    const auto result = likeThat<vtkFloatArray>(points);
    moveAlong(numbers(*as<vtkFloatArray>(points)), numbers(*as<vtkFloatArray>(displacement)),
              static_cast<float>(s), numbers(*result));
    return result;
  }
  const auto result = likeThat<vtkDoubleArray>(points);
  moveAlong(numbers(*as<vtkDoubleArray>(points)), numbers(*as<vtkDoubleArray>(displacement)), s,
            numbers(*result));
  return result;
}

vtkSmartPointer<vtkDataArray> turned(vtkDataArray& normals, vtkDataArray& slope, double s) {
  const auto result = likeThat<vtkFloatArray>(normals);
  result->SetName(normals.GetName());
  turnAlong(numbers(*as<vtkFloatArray>(normals)), numbers(*as<vtkFloatArray>(slope)),
            static_cast<float>(s), numbers(*result));
  return result;
}

}  // namespace

vtkStandardNewMacro(BreathingFilter);

BreathingFilter::BreathingFilter() {
  this->SetDisplacementArray("displacement");
  this->SetNormalSlopeArray("normal_slope");
}

BreathingFilter::~BreathingFilter() {
  this->SetDisplacementArray(nullptr);
  this->SetNormalSlopeArray(nullptr);
}

void BreathingFilter::setBreath(std::vector<double> seconds, std::vector<double> scales) {
  const bool rising =
      std::ranges::adjacent_find(seconds, std::ranges::greater_equal{}) == seconds.end();
  if (seconds.size() < 2 || seconds.size() != scales.size() || !rising) {
    throw InvalidOption(
        "a breath needs two moments at least, in the order of time, and a scale for each");
  }
  seconds_ = std::move(seconds);
  scales_ = std::move(scales);
  this->Modified();
}

double BreathingFilter::scaleAt(double seconds) const {
  const double first = seconds_.front();
  const double period = seconds_.back() - first;
  const double at = seconds - period * std::floor((seconds - first) / period);
  const auto after = std::ranges::upper_bound(seconds_, at);
  if (after == seconds_.end()) return scales_.back();
  const auto n = static_cast<std::size_t>(std::distance(seconds_.begin(), after));
  if (n == 0) return scales_.front();
  const double share = (at - seconds_[n - 1]) / (seconds_[n] - seconds_[n - 1]);
  return (1.0 - share) * scales_[n - 1] + share * scales_[n];
}

int BreathingFilter::RequestInformation(vtkInformation*, vtkInformationVector**,
                                        vtkInformationVector* outputs) {
  if (seconds_.empty()) {
    vtkErrorMacro("there is no breath; call setBreath() first");
    return 0;
  }
  vtkInformation* info = outputs->GetInformationObject(0);
  info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), seconds_.data(),
            static_cast<int>(seconds_.size()));
  const double range[2] = {seconds_.front(), seconds_.back()};
  info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
  return 1;
}

int BreathingFilter::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                 vtkInformationVector* outputs) {
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  vtkDataArray* displacement = input->GetPointData()->GetArray(DisplacementArray);
  if (displacement == nullptr || displacement->GetNumberOfComponents() != 3) {
    vtkErrorMacro("the points have no array '" << DisplacementArray << "' of three components");
    return 0;
  }
  vtkInformation* info = outputs->GetInformationObject(0);
  const double seconds = info->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
                             ? info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
                             : seconds_.front();
  const double scale = scaleAt(seconds);
  vtkNew<vtkPoints> points;
  points->SetData(moved(*input->GetPoints()->GetData(), *displacement, scale));
  output->ShallowCopy(input);
  output->SetPoints(points);
  vtkDataArray* normals = input->GetPointData()->GetNormals();
  vtkDataArray* slope = input->GetPointData()->GetArray(NormalSlopeArray);
  output->GetPointData()->SetNormals(normals != nullptr && slope != nullptr &&
                                             slope->GetNumberOfComponents() == 3
                                         ? turned(*normals, *slope, scale)
                                         : nullptr);
  output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), seconds);
  return 1;
}

}  // namespace pneuma
