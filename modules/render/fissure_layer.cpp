#include "render/fissure_layer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataObject.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPropCollection.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>
#include <vtkUnsignedCharArray.h>

#include "render/colour_map.h"
#include "render/convert.h"
#include "render/ray.h"
#include "render/surface_layer.h"
#include "render/tube_mesh.h"

namespace pneuma {
namespace {

constexpr const char* HeightsName = "fissureHeights";
constexpr Rgb SheetColour = rgbOfHex(0xf2f5fa);
constexpr Rgb CurrentColour = rgbOfHex(0x4aa8ff);
constexpr Rgb SuspectColour = rgbOfHex(0xf2b544);
constexpr Rgb MissingColour = rgbOfHex(0xff7033);  ///< like none of the lobes
constexpr Rgb LightGroundSheet = rgbOfHex(0x4b5565);
constexpr double SheetOpacity = 0.22;
constexpr double CurrentSheetOpacity = 0.38;
constexpr double DashMm = 5.0;
constexpr double GapMm = 4.0;
constexpr float MarkPixels = 10.0F;

// The sign of the heights decides in every pixel, so that the border is as sharp as the screen:
// colours at the points would make it a saw.
constexpr const char* VertexDec = R"(//VTK::Normal::Dec
in vec2 fissureHeights;
out vec2 heightsOverFissures;
)";
constexpr const char* VertexImpl = R"(//VTK::Normal::Impl
heightsOverFissures = fissureHeights;
)";
constexpr const char* FragmentDec = R"(//VTK::Normal::Dec
in vec2 heightsOverFissures;
)";
constexpr const char* FragmentColour = R"(//VTK::Color::Impl
  vec3 lobe = heightsOverFissures.x < 0.0 ? lowerLobe
            : heightsOverFissures.y < 0.0 ? middleLobe : upperLobe;
  ambientColor = 0.12 * lobe;
  diffuseColor = 0.88 * lobe;
)";

Rgb sheetColour(bool current, Background background) {
  if (current) return CurrentColour;
  return background == Background::Dark ? SheetColour : LightGroundSheet;
}

/// What shows in the sheet's colour, what does not in another.
void colourCells(vtkPolyData& data, const std::vector<std::uint8_t>& shows, const Rgb& shown) {
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  colours->Allocate(3 * static_cast<vtkIdType>(shows.size()));
  for (const std::uint8_t there : shows) {
    colours->InsertNextTypedTuple(bytesOf(there != 0 ? shown : MissingColour).data());
  }
  data.GetCellData()->SetScalars(colours);
}

vtkSmartPointer<vtkActor> patchActor(const FissureScene::Sheet& sheet, Background background) {
  vtkNew<vtkPolyDataMapper> mapper;
  const auto data = polyDataOf(*sheet.patch);
  const Rgb colour = sheetColour(sheet.current, background);
  if (sheet.shows) colourCells(*data, *sheet.shows, colour);
  mapper->SetInputData(data);
  mapper->SetScalarVisibility(sheet.shows ? 1 : 0);
  mapper->SetScalarModeToUseCellData();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->PickableOff();
  actor->ForceTranslucentOn();
  vtkProperty* property = actor->GetProperty();
  property->SetColor(colour.r, colour.g, colour.b);
  property->SetOpacity(sheet.current ? CurrentSheetOpacity : SheetOpacity);
  property->SetAmbient(0.25);
  property->SetDiffuse(0.75);
  property->SetInterpolationToPhong();
  return actor;
}

/// Segments of the lines; of dashed ones those that lie in a dash.
vtkSmartPointer<vtkPolyData> segmentsOf(const std::vector<std::vector<Vec3>>& lines, bool dashed) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const std::vector<Vec3>& line : lines) {
    double along = 0.0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const vtkIdType id = points->InsertNextPoint(line[i].data());
      if (i == 0) continue;
      along += (line[i] - line[i - 1]).norm();
      if (dashed && std::fmod(along, DashMm + GapMm) > DashMm) continue;
      const std::array<vtkIdType, 2> ends = {id - 1, id};
      cells->InsertNextCell(2, ends.data());
    }
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(cells);
  return data;
}

vtkSmartPointer<vtkActor> rimActor(const FissureScene::Sheet& sheet, Background background) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(segmentsOf(*sheet.rim, sheet.proposed));
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->PickableOff();
  const Rgb colour = sheetColour(sheet.current, background);
  actor->GetProperty()->SetColor(colour.r, colour.g, colour.b);
  actor->GetProperty()->SetLineWidth(sheet.current ? 2.6F : 1.8F);
  actor->GetProperty()->LightingOff();
  return actor;
}

}  // namespace

void FissureLayer::show(const FissureScene& scene, const SceneOptions& options) {
  options_ = options;
  const bool otherLungs = !std::ranges::equal(scene.lungs, scene_.lungs, {},
                                              &FissureScene::Lung::mesh, &FissureScene::Lung::mesh);
  if (otherLungs) {
    for (const Lung& lung : lungs_) renderer_->RemoveActor(lung.actor);
    lungs_.clear();
    for (const FissureScene::Lung& lung : scene.lungs) {
      lungs_.push_back(lungOf(lung));
      renderer_->AddActor(lungs_.back().actor);
    }
  }
  if (otherLungs || scene.sheets != scene_.sheets) showSheets(scene.sheets);
  for (std::size_t i = 0; i < lungs_.size(); ++i) {
    const bool moved = otherLungs || scene.lungs[i].oblique != scene_.lungs[i].oblique ||
                       scene.lungs[i].horizontal != scene_.lungs[i].horizontal;
    if (moved) fill(lungs_[i], scene.lungs[i]);
    lungs_[i].actor->SetVisibility(scene.lungs[i].visible);
  }
  showMarks(scene.marks);
  scene_ = scene;
}

void FissureLayer::setOptions(const SceneOptions& options) {
  const bool ground = options.background != options_.background;
  options_ = options;
  for (std::size_t i = 0; i < lungs_.size(); ++i) colour(lungs_[i], scene_.lungs[i].side);
  if (ground) showSheets(scene_.sheets);
}

FissureLayer::Lung FissureLayer::lungOf(const FissureScene::Lung& lung) const {
  Lung made{veilOf(*lung.mesh), vtkSmartPointer<vtkFloatArray>::New()};
  made.heights->SetName(HeightsName);
  made.heights->SetNumberOfComponents(2);
  made.heights->SetNumberOfTuples(static_cast<vtkIdType>(lung.mesh->points.size()));
  auto* mapper = vtkPolyDataMapper::SafeDownCast(made.actor->GetMapper());
  mapper->GetInput()->GetPointData()->AddArray(made.heights);
  mapper->MapDataArrayToVertexAttribute(HeightsName, HeightsName,
                                        vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
  vtkShaderProperty* shader = made.actor->GetShaderProperty();
  shader->AddVertexShaderReplacement("//VTK::Normal::Dec", true, VertexDec, false);
  shader->AddVertexShaderReplacement("//VTK::Normal::Impl", true, VertexImpl, false);
  shader->AddFragmentShaderReplacement("//VTK::Normal::Dec", true, FragmentDec, false);
  shader->AddFragmentShaderReplacement("//VTK::Color::Impl", true, FragmentColour, false);
  colour(made, lung.side);
  return made;
}

void FissureLayer::fill(const Lung& made, const FissureScene::Lung& lung) const {
  float* to = made.heights->GetPointer(0);
  for (std::size_t i = 0; i < lung.oblique->size(); ++i) {
    *to++ = (*lung.oblique)[i];
    *to++ = lung.horizontal ? (*lung.horizontal)[i] : 1.0F;
  }
  made.heights->Modified();
  vtkPolyDataMapper::SafeDownCast(made.actor->GetMapper())->GetInput()->Modified();
}

void FissureLayer::colour(const Lung& made, Side side) const {
  vtkUniforms* uniforms = made.actor->GetShaderProperty()->GetFragmentCustomUniforms();
  const auto set = [&](const char* name, Lobe lobe) {
    const Rgb rgb = lobeColour(lobe, options_.palette);
    const Eigen::Vector3f values = Vec3(rgb.r, rgb.g, rgb.b).cast<float>();
    uniforms->SetUniform3f(name, values.data());
  };
  const bool right = side == Side::Right;
  set("upperLobe", right ? Lobe::RightUpper : Lobe::LeftUpper);
  set("middleLobe", right ? Lobe::RightMiddle : Lobe::LeftUpper);
  set("lowerLobe", right ? Lobe::RightLower : Lobe::LeftLower);
  made.actor->GetProperty()->SetOpacity(veilOpacity(options_));
}

void FissureLayer::showSheets(const std::vector<FissureScene::Sheet>& sheets) {
  for (const auto& actor : sheets_) renderer_->RemoveActor(actor);
  sheets_.clear();
  for (const FissureScene::Sheet& sheet : sheets) {
    for (const auto& actor :
         {patchActor(sheet, options_.background), rimActor(sheet, options_.background)}) {
      actor->SetVisibility(sheet.visible);
      renderer_->AddActor(actor);
      sheets_.push_back(actor);
    }
  }
  // What is translucent is drawn in the order of the actors: the sheets before the lungs in front
  // of them.
  for (const Lung& lung : lungs_) {
    renderer_->GetViewProps()->RemoveItem(lung.actor);
    renderer_->GetViewProps()->AddItem(lung.actor);
  }
}

void FissureLayer::showMarks(const std::vector<FissureMark>& marks) {
  if (marks_) renderer_->RemoveActor(marks_);
  marks_ = nullptr;
  if (marks.empty()) return;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  for (const FissureMark& mark : marks) {
    const vtkIdType id = points->InsertNextPoint(mark.place.data());
    vertices->InsertNextCell(1, &id);
    const Rgb rgb = mark.suspect ? SuspectColour : sheetColour(mark.current, options_.background);
    colours->InsertNextTypedTuple(bytesOf(rgb).data());
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(vertices);
  data->GetPointData()->SetScalars(colours);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  marks_ = vtkSmartPointer<vtkActor>::New();
  marks_->SetMapper(mapper);
  marks_->PickableOff();
  marks_->GetProperty()->SetPointSize(MarkPixels);
  marks_->GetProperty()->RenderPointsAsSpheresOn();
  renderer_->AddActor(marks_);
}

std::optional<double> FissureLayer::firstHit(const Vec3& from, const Vec3& to) const {
  std::optional<double> first;
  for (const FissureScene::Lung& lung : scene_.lungs) {
    if (!lung.visible) continue;
    const std::vector<Vec3>& p = lung.mesh->points;
    for (const auto& [a, b, c] : lung.mesh->triangles) {
      const std::optional<RayHit> met = hit(from, to - from, p[a], p[b], p[c]);
      if (met && (!first || met->share < *first)) first = met->share;
    }
  }
  return first;
}

}  // namespace pneuma
