#include "render/breathing_filter.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include "core/error.h"
#include "core/parallel.h"

namespace pneuma {

vtkStandardNewMacro(BreathingFilter);

BreathingFilter::BreathingFilter() { this->SetDisplacementArray("displacement"); }

BreathingFilter::~BreathingFilter() { this->SetDisplacementArray(nullptr); }

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
  vtkNew<vtkDoubleArray> moved;
  moved->SetNumberOfComponents(3);
  moved->SetNumberOfTuples(input->GetNumberOfPoints());
  parallelFor(static_cast<std::size_t>(input->GetNumberOfPoints()), [&](std::size_t n) {
    double p[3];
    double u[3];
    input->GetPoint(static_cast<vtkIdType>(n), p);
    displacement->GetTuple(static_cast<vtkIdType>(n), u);
    double* to = moved->GetPointer(3 * static_cast<vtkIdType>(n));
    for (int axis = 0; axis < 3; ++axis) to[axis] = p[axis] + scale * u[axis];
  });
  vtkNew<vtkPoints> points;
  points->SetData(moved);
  output->ShallowCopy(input);
  output->SetPoints(points);
  output->GetPointData()->SetNormals(nullptr);  // those of the surface at rest
  output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), seconds);
  return 1;
}

}  // namespace pneuma
