#pragma once

#include <vector>

#include <vtkPolyDataAlgorithm.h>

namespace pneuma {

/// Moves a surface, or airways as lines or tubes, with the lungs in a VTK pipeline: a filter that
/// says which times it has and answers requests for any time, so that every VTK program can play
/// it (vtkAnimationScene, ParaView's time controls, vtkStreamingDemandDrivenPipeline). Points go
/// from x to x + s(t) u; u is an array of points of the input, s is given at some times and linear
/// between them. Normals, where the input has an array of what they change by, turn with their
/// points (float, n + s times that, of unit length); without one they are left out. Times before
/// the first and after the last go round: a breath follows a breath.
class BreathingFilter : public vtkPolyDataAlgorithm {
 public:
  static BreathingFilter* New();
  vtkTypeMacro(BreathingFilter, vtkPolyDataAlgorithm);

  /// The name of the array of u, three components, mm. "displacement" by default.
  vtkSetStringMacro(DisplacementArray);
  vtkGetStringMacro(DisplacementArray);

  /// The name of the array of what normals change by at s = 1. "normal_slope" by default.
  vtkSetStringMacro(NormalSlopeArray);
  vtkGetStringMacro(NormalSlopeArray);

  /// s at times that rise; the last time is one period after the first.
  /// @throws InvalidOption if there are fewer than two, they do not rise, or there are not as many
  /// of both
  void setBreath(std::vector<double> seconds, std::vector<double> scales);

  /// s at any time. @pre setBreath() was called
  double scaleAt(double seconds) const;

 protected:
  BreathingFilter();
  ~BreathingFilter() override;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;

  /// Errors by vtkErrorMacro if there is no breath or no such array.
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

 private:
  char* DisplacementArray = nullptr;
  char* NormalSlopeArray = nullptr;
  std::vector<double> seconds_;
  std::vector<double> scales_;
};

}  // namespace pneuma
