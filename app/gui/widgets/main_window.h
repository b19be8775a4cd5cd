#pragma once

#include <QMainWindow>
#include <QStringList>
#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "document/breath_player.h"
#include "document/document.h"
#include "document/fissure_editor.h"
#include "document/lung_editor.h"
#include "document/region_editor.h"
#include "document/review_walk.h"
#include "document/slice_views.h"
#include "document/structure_model.h"
#include "widgets/actions.h"
#include "widgets/commands.h"
#include "widgets/mouse_profile.h"
#include "widgets/theme.h"

class QLabel;
class QStackedWidget;
class QToolButton;

namespace pneuma {

class BreathBar;
class BreathChart;
class CommandPalette;
class ComparisonPage;
class CtViews;
class ErrorCard;
class ExportPanel;
struct ShellCommand;
class FissureViews;
class GenerationChart;
class KeysOverlay;
class LungsPanel;
class OpenPanel;
class SceneView;
class SeriesPage;
struct SeriesList;
class SheetCard;
class SliceBar;
class StatusStrip;
class StepButton;
class StructureView;
class ViewBar;

/// The shell: header, steps and their panels, the 3-D view, structures and properties, status. It
/// shows the Document and hands it what the user wants; it keeps no data but the selection.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  MainWindow();
  ~MainWindow() override;

  Document& document() { return document_; }

  SceneView& view() { return *view_; }

  SliceViews& slices() { return sliceViews_; }

  LungEditor& lungEditor() { return lungEditor_; }

  FissureEditor& fissures() { return fissures_; }

  ReviewWalk& review() { return review_; }

  BreathPlayer& player() { return player_; }

  RegionEditor& regions() { return regions_; }

  /// A project replaces everything: if work would be lost, asks first.
  void open(std::vector<std::filesystem::path> paths);

  /// Tells the menu what size was taken at the start (takeSize()).
  void setSize(int percent);

  /// Offers projects to be opened again, the latest first.
  void setRecent(const QStringList& paths);

  void setTheme(ThemeName name);

  /// Of the slices.
  void setMouse(MouseProfile profile);

  /// Asks what is chosen at the first start.
  void welcome();

 signals:
  void themeChosen(pneuma::ThemeName name);
  void sizeChosen(int percent);
  void mouseChosen(pneuma::MouseProfile profile);

  /// Somebody has read and accepted what is said at the first start.
  void welcomed();
  void tourAsked();

  /// Other projects are offered now.
  void recentChanged(const QStringList& paths);

 protected:
  /// Asks first if work would be lost or a job runs.
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  enum Step { OpenStep, LungsStep, LobesStep, AirwaysStep, BreathingStep, ExportStep, StepCount };

  QWidget* makeHeader();
  QWidget* makeRail();
  QWidget* makeCentre();
  QWidget* makeRightColumn();
  void connectActions();
  void connectDocument();
  void connectView();
  void connectFissures();
  void connectLungs();
  /// Lets the slices take part in correcting lungs, or no longer.
  void activateLungTools(bool active);
  void updateLungActions();
  void connectBreathing();
  void connectExport();
  void connectCommands();
  void connectOpening();
  void connectComparison();

  void goTo(Step step);
  /// The views, or the start page where there is nothing to see.
  void showViews();
  void showSeries(const SeriesList& list);
  void leaveSeries();
  void updateOpeningActions();
  /// Shows the step for lungs where there may be a CT, and numbers the steps.
  void showSteps();
  /// What can be done with the structures that are there.
  std::vector<Command> structureCommands();
  void showSnapshot();
  void showScene();
  void updateActions();
  void updateSteps();
  void updateLobesStep();
  void updateFissureActions();
  void updateBreathingActions();
  void updateBreathingStep();
  /// Shows the lungs breathing where that step is, and at rest elsewhere.
  void showBreathing();
  void showMoment();
  /// Balls that are stiffer or softer, where the step for breathing is.
  void showRegions();
  void saveBreath();
  /// At rest, or as the step for breathing has it.
  std::shared_ptr<const AirwayTree> treeToShow() const;
  void updateProperties();
  void applyVisibility();
  void selectBranch(std::optional<std::size_t> branch);
  void walk(Neighbour where);
  void probe(std::optional<std::size_t> branch);
  void probePoint(const std::optional<Vec3>& point);
  void cancel();
  void saveTree();
  void connectProject();
  /// @param then what to do once it is saved
  void saveProject(std::function<void()> then = {});
  void saveProjectAs(std::function<void()> then = {});
  void saveProjectTo(const std::filesystem::path& path, std::function<void()> then);
  /// What is shown and from where, for the project; and back.
  Json viewNow() const;
  void showView(const Json& view);
  void showStereo(const Json& view);
  std::string thumbnail() const;
  void showTitle();
  void addRecent(const std::filesystem::path& path);
  void changeRecent(const QStringList& paths);
  void openFissures();
  void saveFissures();
  void savePicture();
  void exportCase();
  /// What does the step that is shown, with what is set now.
  ShellCommand commandNow() const;
  void copyCommand();
  void updateExportActions();
  /// True while trees of all methods are shown beside each other, in place of the usual views.
  bool comparing() const;
  void showComparison();
  void closeComparison();

  Document document_;
  StructureModel structures_;
  SliceViews sliceViews_;
  LungEditor lungEditor_{document_, sliceViews_};
  FissureEditor fissures_{document_};
  ReviewWalk review_{document_, fissures_, sliceViews_};
  BreathPlayer player_;
  RegionEditor regions_{document_};
  Actions actions_;
  MouseProfile mouse_ = MouseProfile::Usual;
  std::optional<std::size_t> branch_;  ///< the selected one
  std::function<void()> whenSaved_;
  QStringList recent_;
  bool leaving_ = false;  ///< closes without asking

  // What the scene holds, so that only what is new is handed to it.
  std::shared_ptr<const std::vector<LobeSurface>> shownSurfaces_;
  std::shared_ptr<const std::vector<LobeSurface>> shownWhole_;  ///< of the lungs that they are of
  std::shared_ptr<const AirwayTree> shownTree_;
  std::shared_ptr<const CtImage> shownCt_;
  std::shared_ptr<const LabelImage> shownLabels_;
  std::shared_ptr<const Breath> shownBreath_;

  QLabel* caseName_ = nullptr;
  QToolButton* themeToggle_ = nullptr;
  std::array<StepButton*, StepCount> steps_{};
  QStackedWidget* panels_ = nullptr;
  OpenPanel* openPanel_ = nullptr;
  LungsPanel* lungsPanel_ = nullptr;
  ExportPanel* exportPanel_ = nullptr;
  QStackedWidget* centre_ = nullptr;
  SeriesPage* seriesPage_ = nullptr;
  ViewBar* viewBar_ = nullptr;
  SceneView* view_ = nullptr;
  SliceBar* sliceBar_ = nullptr;
  CtViews* ctViews_ = nullptr;
  FissureViews* fissureViews_ = nullptr;
  ComparisonPage* comparisonPage_ = nullptr;
  ErrorCard* errorCard_ = nullptr;
  StructureView* structureView_ = nullptr;
  QLabel* propertiesHeading_ = nullptr;
  SheetCard* properties_ = nullptr;
  BreathBar* breathBar_ = nullptr;
  QLabel* chartHeading_ = nullptr;
  QStackedWidget* charts_ = nullptr;
  GenerationChart* chart_ = nullptr;
  StatusStrip* status_ = nullptr;
  CommandPalette* palette_ = nullptr;
  KeysOverlay* keysOverlay_ = nullptr;
};

}  // namespace pneuma
