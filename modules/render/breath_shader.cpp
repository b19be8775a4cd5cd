#include "render/breath_shader.h"

#include <algorithm>

#include <vtkActor.h>
#include <vtkDataObject.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>

namespace pneuma {
namespace {

constexpr const char* Displacement = "breathDisplacement";
constexpr const char* NormalSlope = "breathNormalSlope";
constexpr const char* Scales = "breathScales";

constexpr const char* Declarations = R"(//VTK::ValuePass::Dec
in vec4 breathDisplacement;
in vec3 breathNormalSlope;
)";

constexpr const char* Moved = R"(//VTK::CustomBegin::Impl
  float breath = mix(breathScales.x, breathScales.y, breathDisplacement.w);
  vec4 breathing = vec4(vertexMC.xyz + breath * breathDisplacement.xyz, 1.0);
)";

constexpr const char* Position = R"(vertexVCVSOutput = MCVCMatrix * breathing;
  gl_Position = MCDCMatrix * breathing;
)";

constexpr const char* PositionUnlit = R"(gl_Position = MCDCMatrix * breathing;
)";

constexpr const char* Normal = R"(normalVCVSOutput =
      normalMatrix * normalize(normalMC + breath * breathNormalSlope);
)";

void addArray(vtkPolyData* data, const char* name, const std::vector<float>& values,
              int components) {
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  data->GetPointData()->AddArray(array);
}

}  // namespace

void letBreathe(vtkActor* actor, vtkPolyData* data, const BreathAttributes& attributes) {
  addArray(data, Displacement, attributes.displacement, 4);
  addArray(data, NormalSlope, attributes.normalSlope, 3);
  auto* mapper = vtkOpenGLPolyDataMapper::SafeDownCast(actor->GetMapper());
  // Otherwise VTK moves and scales points as it sees fit before the shader gets them.
  mapper->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
  for (const char* name : {Displacement, NormalSlope}) {
    mapper->MapDataArrayToVertexAttribute(name, name, vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
  }
  vtkShaderProperty* shader = actor->GetShaderProperty();
  shader->AddVertexShaderReplacement("//VTK::ValuePass::Dec", true, Declarations, false);
  shader->AddVertexShaderReplacement("//VTK::CustomBegin::Impl", true, Moved, false);
  const bool lit = actor->GetProperty()->GetLighting();
  shader->AddVertexShaderReplacement("//VTK::PositionVC::Impl", true,
                                     lit ? Position : PositionUnlit, false);
  if (data->GetPointData()->GetNormals() != nullptr) {
    shader->AddVertexShaderReplacement("//VTK::Normal::Impl", true, Normal, false);
  }
  setBreath(actor, {});
}

void setBreath(vtkActor* actor, const BreathScale& scale) {
  const float scales[2] = {static_cast<float>(scale.right), static_cast<float>(scale.left)};
  actor->GetShaderProperty()->GetVertexCustomUniforms()->SetUniform2f(Scales, scales);
}

}  // namespace pneuma
