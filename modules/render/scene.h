#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "anatomy/airway_tree.h"
#include "core/options.h"
#include "core/triangle_mesh.h"
#include "render/breathing_scene.h"
#include "render/fissure_scene.h"

class vtkRenderWindow;
class vtkRenderer;

namespace pneuma {

enum class ColourBy { Lobe, Segment, Generation, Strahler, Diameter, Flow };

constexpr std::array<std::string_view, 6> choices(ColourBy) {
  return {"lobe", "segment", "generation", "strahler", "diameter", "flow"};
}

enum class Palette { Pneuma, Huang };

constexpr std::array<std::string_view, 2> choices(Palette) { return {"pneuma", "huang"}; }

enum class Background { Dark, Light, White };

constexpr std::array<std::string_view, 3> choices(Background) { return {"dark", "light", "white"}; }

/// From where one looks: angles about the patient. Azimuth 0 is from the front, 90 from the
/// patient's left; elevation 90 is from above, degrees.
struct ViewDirection {
  double azimuthDeg = 0.0;
  double elevationDeg = 0.0;
};

/// "anterior", "posterior", "left", "right", "superior", "inferior", their letters A P L R S I, or
/// "AZ,EL" in degrees. @throws InvalidOption
ViewDirection viewDirection(std::string_view text);

/// How a scene looks; the same for `pneuma render`, the window and image tests.
struct SceneOptions {
  ColourBy colourBy = ColourBy::Lobe;
  Palette palette = Palette::Pneuma;
  Background background = Background::Dark;
  int maxGeneration = 1000;
  double lobeOpacity = 0.26;  ///< on the dark background; light ones take a third more
  double radiusScale = 1.0;
  bool annotations = true;  ///< scale bar, orientation letters, legend
  bool legend = true;       ///< one of the annotations

  bool operator==(const SceneOptions&) const = default;
};

/// A lobe's surface with the colour it takes.
struct SceneSurface {
  Lobe lobe = Lobe::Whole;
  std::shared_ptr<const TriangleMesh> mesh;
  bool visible = true;
  double density = 1.0;  ///< times SceneOptions::lobeOpacity
};

/// A part of the lungs that is stiffer or softer than the rest.
struct SceneBall {
  Vec3 centre = Vec3::Zero();
  double radiusMm = 0.0;
  bool stiff = true;
  bool chosen = false;  ///< stands out
  Side side = Side::None;
  Vec3 displacement = Vec3::Zero();  ///< of its centre at s = 1, mm

  bool operator==(const SceneBall&) const = default;
};

/// A point of a surface.
struct SurfaceHit {
  std::size_t surface = 0;    ///< in the order of setSurfaces()
  Vec3 place = Vec3::Zero();  ///< as the surface was given, before it breathed
};

/// Lobes, tree, light, camera and annotations in one VTK renderer (plus an overlay for text).
/// Used from one thread, the one that renders.
class Scene {
 public:
  Scene();
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Moves the scene's renderers to a window: an offscreen one, a widget's, or none (null).
  void attachTo(vtkRenderWindow* window);

  /// Which columns of its window the scene fills, as shares of the width; all to begin with. Two
  /// halves hold the pictures of two eyes. Pixels are told and asked for as if `from` were 0.
  void setColumns(double from, double to);

  void setSurfaces(std::vector<SceneSurface> surfaces);
  void setSurfaceVisible(std::size_t index, bool visible);

  /// Draws one surface denser or fainter than the others, by a factor of how dense they are.
  void setSurfaceDensity(std::size_t index, double density);

  /// Lungs whose fissures are edited, in place of the surfaces; none: the surfaces again.
  void setFissures(const FissureScene& fissures);

  /// The mark at a pixel of the window (origin at the lower left), nearest to the viewer, by its
  /// place in the list.
  std::optional<std::size_t> markAt(double x, double y) const;

  Vec3 markPlace(std::size_t mark) const;

  /// The point of a lung whose fissures are edited under a pixel.
  std::optional<Vec3> lungPointAt(double x, double y) const;

  /// The point of a visible surface under a pixel, where the lungs stand at the moment.
  std::optional<SurfaceHit> surfaceAt(double x, double y) const;

  /// The point under a pixel that is as far from the viewer as another point.
  Vec3 pointBeside(double x, double y, const Vec3& other) const;

  /// Null for no tree. The tree is kept, not copied.
  void setTree(std::shared_ptr<const AirwayTree> tree);

  /// Trees whose pictures stand beside this one's, none of them null. They are not drawn, but
  /// look() frames them too, and scales and legend are of all of them: pictures of equal scale.
  void setPeers(std::vector<std::shared_ptr<const AirwayTree>> peers);

  /// Shows points that a running growth has placed, LPS, mm, as dots beside those that it placed
  /// before; the grown branches of the tree give way to them. Of very many only a part is drawn.
  void addPreview(std::span<const Vec3> points);

  /// Shows the tree again, and no dots.
  void clearPreview();

  /// How many points the preview has been given.
  std::size_t previewed() const;

  void setOptions(const SceneOptions& options);
  const SceneOptions& options() const;

  /// Lets surfaces and tree move with the lungs, or stand (null): on the graphics card, so that a
  /// moment costs a frame. Kept, not copied; gone with the next setSurfaces() or setTree(). One
  /// that was made for others is not taken.
  void setBreathing(std::shared_ptr<const BreathingScene> breathing);

  /// The moment of the breath that is shown. s = 0 is how everything was given.
  void setBreath(const BreathScale& scale);

  /// Shows where the lungs are at the ends of expiration and inspiration, if the breathing tells.
  void setOnionSkin(bool on);

  /// Balls in the lungs, which move with them.
  void setBalls(std::vector<SceneBall> balls);

  /// Coarse tubes while the user drags or lungs breathe, fine ones afterwards.
  void setInteractive(bool interactive);

  /// Highlights a branch, or none.
  void select(std::optional<std::size_t> branch);

  /// Points the camera and frames everything that is visible now. When the picture's size changes
  /// the same is framed again, until somebody else moves the camera.
  void look(ViewDirection direction);

  /// Moves the camera so that a point (LPS, mm) is in the middle and turning is about it.
  void centreOn(const Vec3& point);

  /// Where the camera stands now, for the legend of a screenshot and for saving.
  ViewDirection lookingFrom() const;

  /// Pixels at the right edge of the last picture that hold the legend alone; 0 if it had none.
  int legendWidth() const;

  /// The branch under a pixel of the window (origin at the lower left), nearest to the viewer.
  std::optional<std::size_t> branchAt(double x, double y) const;

  /// Brings scale bar and letters up to date with the camera. Called by renderPicture(); a window
  /// calls it before each frame.
  void updateAnnotations();

  vtkRenderer* renderer() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pneuma
