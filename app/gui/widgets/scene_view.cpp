#include "widgets/scene_view.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>
#include <QVariant>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <QVTKOpenGLNativeWidget.h>
#include <vtkCallbackCommand.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include "widgets/open_gl.h"
#include "widgets/stereo_window.h"

namespace pneuma {

namespace {

constexpr int SettleMs = 180;  ///< after the last movement the picture becomes fine again
constexpr int HoverMs = 60;
constexpr int TitleGap = 12;      ///< pixels
constexpr int NoticeWidth = 460;  ///< pixels

/// The usual camera, without VTK's keys (e ends the program, w turns surfaces into wires ...).
class CameraStyle : public vtkInteractorStyleTrackballCamera {
 public:
  static CameraStyle* New();
  vtkTypeMacro(CameraStyle, vtkInteractorStyleTrackballCamera);

  void OnChar() override {}
};

vtkStandardNewMacro(CameraStyle);

}  // namespace

QString viewText(ViewDirection direction) {
  if (direction.elevationDeg > 80.0) return QStringLiteral("superior");
  if (direction.elevationDeg < -80.0) return QStringLiteral("inferior");
  static const std::array<const char*, 4> sides = {"anterior", "left", "posterior", "right"};
  const double azimuth = std::fmod(std::fmod(direction.azimuthDeg, 360.0) + 360.0, 360.0);
  const int quarter = static_cast<int>(std::lround(azimuth / 90.0));
  QString text = QString::fromUtf8(sides[static_cast<std::size_t>(quarter % 4)]);
  const int beside = static_cast<int>(std::lround(azimuth - 90.0 * quarter));
  if (beside != 0) {
    const int towards = (quarter + (beside > 0 ? 1 : 3)) % 4;
    text += QStringLiteral(", %1° %2")
                .arg(std::abs(beside))
                .arg(QString::fromUtf8(sides[static_cast<std::size_t>(towards)]));
  }
  const int up = static_cast<int>(std::lround(direction.elevationDeg));
  if (up != 0) {
    text += QStringLiteral(", %1° %2").arg(std::abs(up)).arg(up > 0 ? "superior" : "inferior");
  }
  return text;
}

void SceneView::makeCanvas() {
  gl_ = new QVTKOpenGLNativeWidget(this);
  canvas_ = gl_;
  window_->SetMultiSamples(0);
  gl_->setRenderWindow(window_);
  scene_->attachTo(window_);
  vtkNew<CameraStyle> style;
  window_->GetInteractor()->SetInteractorStyle(style);
}

void SceneView::makeNotice() {
  canvas_ = new QWidget(this);
  scene_->attachTo(window_);
  auto* notice = new QLabel(obstacle());
  notice->setObjectName(QStringLiteral("sceneNotice"));
  notice->setTextFormat(Qt::PlainText);
  notice->setWordWrap(true);
  notice->setAlignment(Qt::AlignCenter);
  notice->setTextInteractionFlags(Qt::TextSelectableByMouse);
  notice->setMaximumWidth(NoticeWidth);
  auto* row = new QHBoxLayout(canvas_);
  row->setContentsMargins(24, 24, 24, 24);
  row->addWidget(notice);
}

const QString& SceneView::obstacle() const { return openGlObstacle(); }

SceneView::SceneView(QWidget* parent)
    : QWidget(parent), scene_(std::make_unique<Scene>()), window_(StereoWindow::New()) {
  setObjectName(QStringLiteral("sceneView"));
  if (obstacle().isEmpty()) {
    makeCanvas();
  } else {
    makeNotice();
  }
  canvas_->setObjectName(QStringLiteral("canvas"));
  canvas_->setAccessibleName(tr("3-D view of lobes and airways"));
  canvas_->setFocusPolicy(Qt::StrongFocus);
  canvas_->setMouseTracking(true);
  canvas_->installEventFilter(this);

  // Scale bar, letters and the title follow the camera, whatever moved it.
  vtkNew<vtkCallbackCommand> beforeFrame;
  beforeFrame->SetClientData(this);
  beforeFrame->SetCallback([](vtkObject*, unsigned long, void* self, void*) {
    auto* view = static_cast<SceneView*>(self);
    view->scene_->updateAnnotations();
    QString text = tr("3D   %1").arg(viewText(view->scene_->lookingFrom()));
    // Short of the letter in the middle of the upper side.
    const int width = view->stereoWindow().halved() ? view->width() / 2 : view->width();
    const int middle = (width - view->scene_->legendWidth()) / 2;
    const int room = middle - view->title_->x() - TitleGap;
    if (view->title_->fontMetrics().horizontalAdvance(text) > room) text = tr("3D");
    if (view->title_->text() != text) {
      view->title_->setText(text);
      view->title_->adjustSize();
    }
  });
  window_->AddObserver(vtkCommand::StartEvent, beforeFrame);

  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(canvas_);

  title_ = new QLabel(this);
  title_->setObjectName(QStringLiteral("viewTitle"));
  title_->setProperty("role", "viewTitle");
  title_->setAttribute(Qt::WA_TransparentForMouseEvents);
  title_->move(12, 10);
  title_->setText(tr("3D"));

  renderTimer_.setSingleShot(true);
  renderTimer_.setInterval(0);
  connect(&renderTimer_, &QTimer::timeout, this, &SceneView::render);
  sinceFrame_.start();
  previewTimer_.setSingleShot(true);
  connect(&previewTimer_, &QTimer::timeout, this, &SceneView::renderSoon);
  settleTimer_.setSingleShot(true);
  settleTimer_.setInterval(SettleMs);
  connect(&settleTimer_, &QTimer::timeout, this, [this] { dragging(false); });
  hoverTimer_.setSingleShot(true);
  hoverTimer_.setInterval(HoverMs);
  connect(&hoverTimer_, &QTimer::timeout, this, [this] { emit hovered(branchAt(pointer_)); });
}

SceneView::~SceneView() {
  // The scene frees what it holds on the graphics card: before the canvas takes the context away.
  canvas_->removeEventFilter(this);
  stereoWindow().setStereo(*scene_, {});
  scene_.reset();
  window_->Delete();
}

void SceneView::setSurfaces(std::vector<SceneSurface> surfaces) {
  scene_->setSurfaces(std::move(surfaces));
  renderSoon();
}

void SceneView::setSurfaceVisible(std::size_t index, bool visible) {
  scene_->setSurfaceVisible(index, visible);
  renderSoon();
}

void SceneView::setSurfaceDensity(std::size_t index, double density) {
  scene_->setSurfaceDensity(index, density);
  renderSoon();
}

void SceneView::setFissures(const FissureScene& fissures) {
  scene_->setFissures(fissures);
  renderSoon();
}

void SceneView::setTree(std::shared_ptr<const AirwayTree> tree) {
  scene_->setTree(std::move(tree));
  renderSoon();
}

void SceneView::addPreview(const std::vector<Vec3>& points) {
  if (scene_->previewed() == 0) frameMs_ = 0;  // with the tree, it tells nothing about the dots
  scene_->addPreview(points);
  if (previewTimer_.isActive()) return;
  previewTimer_.start(static_cast<int>(std::max<qint64>(0, frameMs_ - sinceFrame_.elapsed())));
}

void SceneView::clearPreview() {
  if (scene_->previewed() == 0) return;
  previewTimer_.stop();
  scene_->clearPreview();
  renderSoon();
}

void SceneView::setOptions(const SceneOptions& options) {
  scene_->setOptions(options);
  renderSoon();
}

void SceneView::setBreathing(std::shared_ptr<const BreathingScene> breathing) {
  scene_->setBreathing(std::move(breathing));
  renderSoon();
}

void SceneView::setBreath(const BreathScale& scale) {
  scene_->setBreath(scale);
  if (!playing_) {
    dragging(true);  // the slider may go on
    settleTimer_.start();
  }
  renderSoon();
}

void SceneView::setOnionSkin(bool on) {
  scene_->setOnionSkin(on);
  renderSoon();
}

void SceneView::setBalls(std::vector<SceneBall> balls) {
  scene_->setBalls(std::move(balls));
  renderSoon();
}

void SceneView::setPicking(bool picking) {
  picking_ = picking;
  canvas_->setCursor(picking ? Qt::CrossCursor : Qt::ArrowCursor);
}

void SceneView::setPlaying(bool playing) {
  if (playing == playing_) return;
  playing_ = playing;
  if (playing) {
    dragging(true);
  } else {
    dragging(false);
  }
}

void SceneView::select(std::optional<std::size_t> branch) {
  scene_->select(branch);
  renderSoon();
}

void SceneView::look(ViewDirection direction) {
  scene_->look(direction);
  renderSoon();
}

StereoWindow& SceneView::stereoWindow() const { return *window_; }

void SceneView::setStereo(const StereoOptions& stereo) {
  stereoWindow().setStereo(*scene_, stereo);
  renderSoon();
}

void SceneView::centreOn(const Vec3& point) {
  scene_->centreOn(point);
  renderSoon();
}

void SceneView::resetView() { look(scene_->lookingFrom()); }

void SceneView::turn(double azimuthDeg, double elevationDeg) {
  ViewDirection direction = scene_->lookingFrom();
  direction.azimuthDeg += azimuthDeg;
  direction.elevationDeg = std::clamp(direction.elevationDeg + elevationDeg, -90.0, 90.0);
  look(direction);
}

QImage SceneView::picture() {
  if (gl_ == nullptr) return {};
  window_->Render();
  return gl_->grabFramebuffer();
}

QPoint SceneView::positionOf(const Vec3& point) const {
  vtkRenderer* renderer = scene_->renderer();
  renderer->SetWorldPoint(point.x(), point.y(), point.z(), 1.0);
  renderer->WorldToDisplay();
  const double* display = renderer->GetDisplayPoint();
  const double ratio = canvas_->devicePixelRatioF();
  return {static_cast<int>(display[0] / ratio),
          canvas_->height() - 1 - static_cast<int>(display[1] / ratio)};
}

QWidget* SceneView::canvas() const { return canvas_; }

QPointF SceneView::onWindow(const QPoint& position) const {
  const double ratio = canvas_->devicePixelRatioF();
  const int half = stereoWindow().halved() ? canvas_->width() / 2 : canvas_->width();
  const int x = position.x() >= half ? position.x() - half : position.x();
  return {x * ratio, (canvas_->height() - 1 - position.y()) * ratio};
}

std::optional<std::size_t> SceneView::branchAt(const QPoint& position) const {
  const QPointF at = onWindow(position);
  return scene_->branchAt(at.x(), at.y());
}

void SceneView::render() {
  if (gl_ == nullptr) {
    detailed_ = true;
    return;
  }
  sinceFrame_.start();
  window_->Render();
  frameMs_ = sinceFrame_.restart();
  detailed_ = !coarse_;
  countFrame();
}

void SceneView::countFrame() {
  constexpr qint64 SecondMs = 1000;
  ++frames_;
  ++framesInSecond_;
  if (!second_.isValid()) second_.start();
  const qint64 passed = second_.elapsed();
  if (passed < SecondMs) return;
  framesPerSecond_ = 1000.0 * framesInSecond_ / static_cast<double>(passed);
  framesInSecond_ = 0;
  second_.start();
}

void SceneView::renderSoon() { renderTimer_.start(); }

void SceneView::dragging(bool on) {
  coarse_ = on || playing_;
  scene_->setInteractive(coarse_);
  if (!on) renderSoon();
}

}  // namespace pneuma
