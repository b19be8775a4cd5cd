#include "render/overlay.h"

#include <vtkCellArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkUnsignedCharArray.h>

#include "render/font.h"
#include "render/tube_mesh.h"
#include "render/vtk_globals.h"

namespace pneuma {
namespace {

void setAnchor(vtkTextProperty* property, const Overlay::Place& place) {
  using Anchor = Overlay::Anchor;
  property->SetJustification(place.horizontal == Anchor::Low      ? VTK_TEXT_LEFT
                             : place.horizontal == Anchor::Middle ? VTK_TEXT_CENTERED
                                                                  : VTK_TEXT_RIGHT);
  property->SetVerticalJustification(place.vertical == Anchor::Low      ? VTK_TEXT_BOTTOM
                                     : place.vertical == Anchor::Middle ? VTK_TEXT_CENTERED
                                                                        : VTK_TEXT_TOP);
}

}  // namespace

Overlay::Overlay(vtkRenderer* renderer) : renderer_(renderer) {
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(boxData_);
  boxActor_->SetMapper(mapper);
  boxActor_->PickableOff();
  renderer_->AddActor2D(boxActor_);
}

void Overlay::begin(double pixelRatio) {
  pixelRatio_ = pixelRatio;
  usedTexts_ = 0;
  boxes_.clear();
}

void Overlay::text(const std::string& text, const Place& place, int fontPixels, const Rgb& colour,
                   bool shadow) {
  if (usedTexts_ == texts_.size()) {
    texts_.push_back(vtkSmartPointer<vtkTextActor>::New());
    texts_.back()->PickableOff();
    renderer_->AddActor2D(texts_.back());
  }
  vtkTextActor* actor = texts_[usedTexts_++];
  actor->SetInput(text.c_str());
  actor->SetPosition(place.x * pixelRatio_, place.y * pixelRatio_);
  actor->VisibilityOn();
  vtkTextProperty* property = actor->GetTextProperty();
  setFont(property, fontPixels);
  setAnchor(property, place);
  property->SetColor(colour.r, colour.g, colour.b);
  property->SetShadow(shadow);
}

void Overlay::box(double left, double bottom, double right, double top, const Rgb& colour) {
  boxes_.push_back({{left, bottom, right, top}, colour});
}

void Overlay::end() {
  for (std::size_t i = usedTexts_; i < texts_.size(); ++i) texts_[i]->VisibilityOff();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> quads;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  for (const auto& [sides, colour] : boxes_) {
    const auto [left, bottom, right, top] = sides;
    const vtkIdType first = points->GetNumberOfPoints();
    points->InsertNextPoint(left * pixelRatio_, bottom * pixelRatio_, 0.0);
    points->InsertNextPoint(right * pixelRatio_, bottom * pixelRatio_, 0.0);
    points->InsertNextPoint(right * pixelRatio_, top * pixelRatio_, 0.0);
    points->InsertNextPoint(left * pixelRatio_, top * pixelRatio_, 0.0);
    quads->InsertNextCell({first, first + 1, first + 2, first + 3});
    for (int corner = 0; corner < 4; ++corner) {
      colours->InsertNextTypedTuple(bytesOf(colour).data());
    }
  }
  boxData_->SetPoints(points);
  boxData_->SetPolys(quads);
  boxData_->GetPointData()->SetScalars(colours);
  boxActor_->SetVisibility(!boxes_.empty());
}

double Overlay::textWidth(const std::string& text, int fontPixels) {
  vtkNew<vtkTextProperty> property;
  setFont(property, fontPixels);
  std::array<int, 4> box{};
  constexpr int LogicalDpi = 72;
  prepareVtk();
  vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
  if (renderer == nullptr || !renderer->GetBoundingBox(property, text, box.data(), LogicalDpi)) {
    return 0.6 * fontPixels * static_cast<double>(text.size());
  }
  return box[1] - box[0] + 1;
}

}  // namespace pneuma
