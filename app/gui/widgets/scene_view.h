#pragma once

#include <QElapsedTimer>
#include <QImage>
#include <QTimer>
#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include "document/tree_figures.h"
#include "render/scene.h"
#include "render/stereo.h"

class QLabel;
class QVTKOpenGLNativeWidget;
class vtkCamera;

namespace pneuma {

class StereoWindow;

/// "anterior, 10° left": in words, where one looks from.
QString viewText(ViewDirection direction);

/// The 3-D view: a render::Scene in a widget. Left drag turns, middle or Shift+left drag moves,
/// right drag or wheel zooms, a click takes the branch under the pointer. With the keyboard: A P L
/// R S I look along an axis, Home frames everything, Shift+arrows turn, arrows walk along the tree.
/// Marks of fissures that are edited follow the left button.
class SceneView : public QWidget {
  Q_OBJECT

 public:
  explicit SceneView(QWidget* parent = nullptr);
  ~SceneView() override;

  void setSurfaces(std::vector<SceneSurface> surfaces);
  void setSurfaceVisible(std::size_t index, bool visible);
  void setSurfaceDensity(std::size_t index, double density);

  /// Lungs whose fissures are edited, in place of the surfaces; none: the surfaces again.
  void setFissures(const FissureScene& fissures);

  /// While it sets points, a click goes to the lung's surface, and marks move along it.
  void setPlacing(bool placing) { placing_ = placing; }

  /// While it picks surfaces, a click goes to the lung's surface as it stands.
  void setPicking(bool picking);

  void setTree(std::shared_ptr<const AirwayTree> tree);
  void setOptions(const SceneOptions& options);

  /// Lets everything move with the lungs, or stand (null); after setSurfaces() and setTree().
  void setBreathing(std::shared_ptr<const BreathingScene> breathing);

  /// The moment of the breath that is shown.
  void setBreath(const BreathScale& scale);

  /// Shows the ends of expiration and inspiration, too.
  void setOnionSkin(bool on);

  /// Balls in the lungs that are stiffer or softer.
  void setBalls(std::vector<SceneBall> balls);

  /// Coarse while the lungs breathe, fine once they stand.
  void setPlaying(bool playing);

  /// How many frames were drawn so far.
  int framesDrawn() const { return frames_; }

  /// How many frames were drawn in the last whole second in which some were.
  double framesPerSecond() const { return framesPerSecond_; }

  /// True if the last frame had every triangle and branch.
  bool detailed() const { return detailed_; }

  /// Shows what a growth has placed since the last time (Scene::addPreview()). After a frame it
  /// waits as long as that took: however slow the graphics, half of the time stays for the user.
  void addPreview(const std::vector<Vec3>& points);
  void clearPreview();

  std::size_t previewed() const { return scene_->previewed(); }

  const SceneOptions& options() const { return scene_->options(); }

  /// Trees that are shown beside this one's, at the same scale (Scene::setPeers()).
  void setPeers(std::vector<std::shared_ptr<const AirwayTree>> peers);

  /// Draws before long, coarsely for now or not, because somebody else moved the camera.
  void follow(bool coarse);

  vtkCamera* camera() const;

  void select(std::optional<std::size_t> branch);
  void look(ViewDirection direction);

  ViewDirection lookingFrom() const { return scene_->lookingFrom(); }

  /// Draws for one eye or for two. Clicks count in either half of two pictures side by side.
  void setStereo(const StereoOptions& stereo);

  /// Puts a point (LPS, mm) in the middle and the axis of turning through it.
  void centreOn(const Vec3& point);

  /// Frames everything again, seen from where one stands.
  void resetView();

  /// Why the view is empty and what to do about it; empty if it can draw. Everything else of it
  /// works without drawing.
  const QString& obstacle() const;

  /// What the view shows, in device pixels; null if it cannot draw.
  QImage picture();

  /// The pixel of this widget at which a point (LPS, mm) is drawn.
  QPoint positionOf(const Vec3& point) const;

  /// The widget that takes the mouse, for scripts.
  QWidget* canvas() const;

 signals:
  void clicked(std::optional<std::size_t> branch);
  void hovered(std::optional<std::size_t> branch);
  void walked(pneuma::Neighbour where);

  /// The keys of the timeline: to play or to stand, and by one frame to either side.
  void playToggled();
  void stepped(int frames);

  /// A click on a lung while points are set.
  void lungClicked(const pneuma::Vec3& point);

  /// A click on a surface, by its place in setSurfaces(), while surfaces are picked.
  /// @param place on it, at rest
  void surfaceClicked(std::size_t surface, const pneuma::Vec3& place);

  /// A mark of the fissures is dragged there; by its place in the list.
  void markDragged(std::size_t mark, const pneuma::Vec3& to);
  void markReleased();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void render();
  void countFrame();
  void clickedAt(const QPoint& position);
  void renderSoon();
  void turn(double azimuthDeg, double elevationDeg);
  bool keyPressed(int key, Qt::KeyboardModifiers modifiers);
  void dragging(bool on);
  /// True if the event was for the marks of the fissures.
  bool mouseOnMark(QEvent& event);
  QPointF onWindow(const QPoint& position) const;
  std::optional<std::size_t> branchAt(const QPoint& position) const;
  StereoWindow& stereoWindow() const;

  void makeCanvas();
  /// A sentence in place of the canvas.
  void makeNotice();

  std::unique_ptr<Scene> scene_;
  StereoWindow* window_;                  ///< counted as VTK does
  QVTKOpenGLNativeWidget* gl_ = nullptr;  ///< null where there is no OpenGL to draw with
  QWidget* canvas_ = nullptr;
  QLabel* title_;
  QTimer renderTimer_;
  QTimer previewTimer_;
  QElapsedTimer sinceFrame_;
  qint64 frameMs_ = 0;  ///< what the last frame took
  QTimer settleTimer_;
  QTimer hoverTimer_;
  bool placing_ = false;
  bool picking_ = false;
  bool playing_ = false;
  int frames_ = 0;
  QElapsedTimer second_;  ///< since framesInSecond_ was 0
  int framesInSecond_ = 0;
  bool coarse_ = false;
  bool detailed_ = false;
  double framesPerSecond_ = 0.0;
  std::optional<std::size_t> mark_;  ///< that is dragged
  Vec3 markPlace_ = Vec3::Zero();    ///< where it was
  QPoint pressedAt_;
  QPoint pointer_;
};

}  // namespace pneuma
