#pragma once

#include <QObject>
#include <QString>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "document/job_queue.h"
#include "document/series_list.h"
#include "document/snapshot.h"
#include "growth/growth.h"
#include "pipeline/breathe.h"
#include "pipeline/case_export.h"
#include "pipeline/case_report.h"
#include "pipeline/ct_model.h"
#include "pipeline/project.h"
#include "render/scene.h"

namespace pneuma {

struct MethodComparison;

/// One person's lungs as the window works on them: the snapshot shown, what was before it and what
/// was undone, the options of the next growth, and the jobs. Needs no display.
class Document : public QObject {
  Q_OBJECT

 public:
  /// What the steps to undo may hold beside what is shown.
  static constexpr std::size_t UndoBytes = std::size_t{512} << 20;

  explicit Document(QObject* parent = nullptr);

  const Snapshot& snapshot() const { return snapshot_; }

  const LungModel& model() const { return snapshot_.model; }

  /// Null if there is no tree.
  std::shared_ptr<const AirwayTree> tree() const { return treeOf(snapshot_.model); }

  /// The options of the next growth; which method, too.
  const GrowthOptions& growthOptions() const { return optionsOf_[method_]; }

  /// Makes the method of these options the one to grow with.
  void setGrowthOptions(const GrowthOptions& options);

  /// Grows with a method of growthMethods() from now on, with the options that it was given last.
  void setGrowthMethod(std::size_t method);

  std::size_t growthMethodIndex() const { return method_; }

  /// True if the tree shown was grown with other options than those set now, or in other lobes.
  bool growthOutOfDate() const;

  /// True if there are lobes to grow in.
  bool canGrow() const;

  /// The options of the next search for lungs.
  const LungOptions& lungOptions() const { return lungOptions_; }

  void setLungOptions(const LungOptions& options);

  /// True if the lungs shown were found with other options than those set now.
  bool lungsOutOfDate() const;

  /// True while lungs are looked for, airways grown, a case exported or its report written.
  bool findingLungs() const { return jobs_.has(JobKind::FindingLungs); }

  bool growing() const { return jobs_.has(JobKind::Growing); }

  bool exporting() const { return jobs_.has(JobKind::Exporting); }

  /// True if there are whole lungs to split into lobes.
  bool canSplit() const { return !snapshot_.lungs.empty(); }

  /// True while the lungs are being split, and while fissures are looked for in the CT.
  bool splitting() const { return jobs_.has(JobKind::Splitting); }

  bool lookingForFissures() const { return jobs_.has(JobKind::LookingForFissures); }

  /// Why fissures cannot be snapped to what shows in the CT; empty if they can.
  QString snapObstacle() const;

  /// What shows of fissures in one lung of the CT; null until it was looked for.
  std::shared_ptr<const SheetnessImage> sheets(Side side) const;

  /// True if the lobes shown were made with other fissures than those set now.
  bool lobesOutOfDate() const;

  /// The options of the next breath.
  const BreatheOptions& breatheOptions() const { return breatheOptions_; }

  void setBreatheOptions(const BreatheOptions& options);

  /// Moves the lungs by constants of `pneuma estimate`, read as a job, or by the preset's again.
  void openConstants(const std::filesystem::path& path);
  void forgetConstants();

  /// Breathes a measured breath, read and fitted as a job, or the scenario's again.
  void openMeasuredBreath(const std::filesystem::path& path);
  void forgetMeasuredBreath();

  /// The files that these were read from; null if there were none, as after opening a project.
  const InputFile* breathFile() const { return breathFile_ ? &*breathFile_ : nullptr; }

  const InputFile* constantsFile() const { return constantsFile_ ? &*constantsFile_ : nullptr; }

  /// Sets which parts of the lungs are stiffer or softer in the next breath. Can be undone. Not
  /// while a job runs.
  /// @param what was done, for example "place a ball"
  void setRegions(std::vector<StiffnessRegion> regions, const QString& what);

  /// True if there are lungs or lobes that can breathe.
  bool canBreathe() const;

  /// True while a breath is made.
  bool breathing() const { return jobs_.has(JobKind::Breathing); }

  /// True if the breath shown was made with other options than those set now.
  bool breathOutOfDate() const;

  JobQueue& jobs() { return jobs_; }

  const JobQueue& jobs() const { return jobs_; }

  /// Reads files and folders. A project alone replaces everything, also what could be undone. A
  /// tree alone is added to the lobes or the CT that are open, lobes alone to the tree or the CT,
  /// labels to the CT; otherwise what was read replaces what was there. Can be undone. In a CT
  /// without labels the lungs are looked for at once.
  void open(std::vector<std::filesystem::path> paths);

  /// Opens a series of a list, in place of what was read of it before. Can be undone.
  /// @param row that can be opened
  /// @param fillGaps where slices are missing, they are interpolated
  void openSeries(const SeriesList& list, int row, bool fillGaps);

  /// Lists the series where the CT that is open comes from, for another choice: seriesToChoose().
  void listSeries();

  /// True if the CT that is open comes from DICOM, which may hold other series.
  bool hasOtherSeries() const;

  /// Draws the series of a list one after the other: seriesDrawn().
  void drawSeries(const SeriesList& list);

  /// Gives up drawing series, if it does. Whatever is opened does that.
  void stopDrawing();

  bool drawingSeries() const { return jobs_.has(JobKind::DrawingSeries); }

  /// True if the CT of the project was not where it was, or was another.
  bool ctMissing() const { return snapshot_.model.ctSource && !snapshot_.model.ct; }

  /// Gives the project its CT again, which is at another place now: ctFound(), or ctMissed() if it
  /// is another one. Everything else stays as it is.
  void locateCt(const std::filesystem::path& path);

  /// Opens the synthetic chest. Can be undone.
  void openSample();

  /// Opens one of organNames(). Can be undone.
  void openOrgan(std::string_view name);

  /// Finds lungs and central airways in the CT with lungOptions(). Can be undone.
  void findLungs() { findLungs(StepKind::Work); }

  /// Why the lungs cannot be corrected by hand now, and what to do; empty if they can.
  QString correctionObstacle() const;

  /// Corrects the lungs by one edit. Surfaces and figures follow as a job; what was made of the
  /// lungs before is gone. Can be undone. While that job runs, lungs can be corrected further.
  /// @param labels with the edit
  /// @param what was done, for example "paint right lung"
  void correctLungs(LungEdit edit, std::shared_ptr<const LabelImage> labels, const QString& what);

  /// Corrects the lungs from a seed, which may take a moment, as a job. Can be undone.
  void growSeed(LungEdit seed, const QString& what);

  /// Corrects the lungs by the edits of a file, as `pneuma segment --edits` does. Can be undone.
  void openLungEdits(const std::filesystem::path& path);

  /// Writes all edits of the lungs.
  void saveLungEdits(const std::filesystem::path& path);

  /// True while surfaces and figures follow corrections of the lungs.
  bool followingLungs() const { return jobs_.has(JobKind::FollowingLungs); }

  /// Makes surfaces and figures those of the corrected lungs, if they are not, as a job. Not while
  /// another job changes them.
  void followLungs();

  /// Sets what the lungs are split with. Lobes that are there follow. Can be undone, with them.
  /// Not while another job runs.
  /// @param what was done, for example "set a point"
  void setLobeEdits(const LobeEdits& edits, const QString& what);

  /// Snaps fissures to what shows in the CT, or no longer. What shows is looked for first, once;
  /// wanted volumes are given up. Can be undone.
  void setSnapping(bool on);

  /// Reads fissures as `pneuma lobes --fissures` does; those that the file does not have are
  /// proposed again. Can be undone.
  void openFissures(const std::filesystem::path& path);

  /// Reads the surface of one fissure. Can be undone.
  void openFissureSurface(Fissure fissure, const std::filesystem::path& path);

  /// Writes the fissures that were set, by the extension as writeFissures().
  void saveFissures(const std::filesystem::path& path);

  /// Says that fissures were looked at as they are. Can be undone.
  /// @param skipped their stations were not
  void setReviewed(const std::vector<Fissure>& fissures, bool skipped);

  /// True if the fissure is still as it was when somebody looked at it.
  bool reviewed(Fissure fissure) const;

  /// Splits the whole lungs into lobes, to grow in. Can be undone.
  void splitLobes();

  /// Grows airways with growthOptions(). Can be undone.
  void grow();

  /// Grows a tree by every method with its present options, in the lobes that are open, and
  /// measures them: what is shown stays. Those that are there already are told of at once.
  void compareMethods();

  /// The trees of compareMethods(); null if there are none, or none of these lobes and airways.
  const std::shared_ptr<const MethodComparison>& comparison() const { return comparison_; }

  /// True while trees are grown to be compared.
  bool comparing() const { return jobs_.has(JobKind::Comparing); }

  /// Makes one of the compared trees the case's, and its options those of the next growth. Can be
  /// undone. Not while a job runs.
  /// @param method its place in the comparison
  void keepCompared(std::size_t method);

  /// Writes the figures of the compared trees as `pneuma compare --csv` does.
  void saveComparison(const std::filesystem::path& path);

  /// Makes lungs and airways breathe with breatheOptions(). Can be undone.
  void breathe();

  /// Writes the breath for ParaView, as `pneuma breathe` does.
  void saveBreath(const std::filesystem::path& path);

  /// Writes the tree as VTP, SWC, CSV or JSON by the extension.
  void saveTree(const std::filesystem::path& path);

  /// Writes what a preset makes of the case into a folder, as `pneuma export --preset` does: all of
  /// it or nothing. Files that are there are replaced: ask before.
  /// @param format one of formatsOf(); empty: the usual one @param view of a film
  void exportCase(ExportPreset preset, const std::filesystem::path& folder,
                  const std::string& format = {}, ViewDirection view = {});

  /// Those files of a preset that are in a folder already.
  std::vector<std::filesystem::path> filesInTheWay(ExportPreset preset,
                                                   const std::filesystem::path& folder,
                                                   const std::string& format = {}) const;

  /// Writes the report of the case as PDF, HTML or JSON by the extension, as `pneuma report` does.
  void saveReport(const std::filesystem::path& path, const CaseReportOptions& options);

  /// Writes a file that is ready, for example a picture.
  void saveFile(const std::filesystem::path& path, std::string content);

  /// True if the tree shown is in a file as it is.
  bool treeSaved() const { return saved_ != nullptr && saved_ == tree(); }

  /// The file of this case; empty if there is none yet.
  const std::filesystem::path& projectPath() const { return projectPath_; }

  /// Saves everything as a project; `view` and `thumbnail` are for whoever opens it.
  void saveProject(const std::filesystem::path& path, CtStorage ct, Json view,
                   std::string thumbnail);

  /// Everything as it is now, for saveProject() and for recovery; no view and no thumbnail.
  /// @param historyBytes the steps to undo and redo that are left out hold more than that
  Project projectNow(std::size_t historyBytes = UndoBytes) const;

  /// Opens what was kept of work that was lost: it counts as not saved. Where it would have been
  /// saved is the view's "project".
  void recover(const std::filesystem::path& file);

  /// How the CT of the project is kept.
  CtStorage ctStorage() const { return ctStorage_; }

  /// What the project that was opened last says of the view.
  const Json& openedView() const { return openedView_; }

  /// True if something was done since the project was saved or opened.
  bool modified() const { return snapshot_.revision != savedRevision_; }

  /// True if work would be lost: something was done since, and it is more than a grown tree that
  /// is in a file.
  bool workUnsaved() const;

  bool canUndo() const { return !undo_.empty() && idle(); }

  bool canRedo() const { return !redo_.empty() && idle(); }

  /// What undo() takes back, for example "grow airways"; empty if there is nothing.
  QString undoName() const { return undo_.empty() ? QString() : undo_.back().name; }

  QString redoName() const { return redo_.empty() ? QString() : redo_.back().name; }

  void undo();
  void redo();

 signals:
  /// The snapshot is another one, or what can be undone is.
  void changed();

  void growthOptionsChanged();
  void lungOptionsChanged();
  void breatheOptionsChanged();

  /// The trees to compare are there.
  void compared();

  /// The tree shown is in a file now.
  void treeWasSaved();

  /// The project is in its file now.
  void projectWasSaved();

  /// A project was opened in place of everything before. After changed().
  void projectWasOpened();

  /// open() found several series, or one that is hardly of lungs, and leaves the choice.
  void seriesToChoose(const pneuma::SeriesList& list);

  /// A picture of a row of a list; without pixels if there is nothing to be seen.
  void seriesDrawn(const pneuma::SeriesList& list, int row, const pneuma::Picture& picture);

  /// Like failed(), and locateCt() may help.
  void ctMissed(const QString& title, const QString& sentence);

  /// The project has its CT again.
  /// @param wasSaved nothing else was done since the project was saved
  void ctFound(bool wasSaved);

  /// One sentence on what has just been done, for the status bar.
  void said(const QString& sentence);

  /// @param title what was tried
  /// @param sentence what is wrong and what to do
  void failed(const QString& title, const QString& sentence);

 private:
  enum class Opened { AsSaved, Recovered };

  /// Whether a step only brings in what is in files anyway.
  enum class StepKind { Work, Opening };

  struct Step {
    QString name;
    Snapshot snapshot;
  };

  /// Puts the last step of `from` in place of what is shown, which goes to `to`.
  /// @param sentence to be told, of the step's name
  void showStep(std::vector<Step>& from, std::vector<Step>& to, const QString& sentence);

  void findLungs(StepKind kind);

  /// True if nothing runs but what follows from what is shown, which stopFollowing() ends.
  bool idle() const {
    return !jobs_.hasOthersThan({JobKind::FollowingLungs, JobKind::TracingFissures});
  }

  void stopFollowing();
  /// True while corrected lungs are still drawn; `then` is done once they are.
  bool waitsForLungs(std::function<void()> then);
  /// Corrects the lungs by edits that take a while. @param title of the job
  void correctByJob(const QString& title, std::function<std::vector<LungEdit>()> edits,
                    const QString& what);
  void becomeCorrected(std::vector<LungEdit> edits, std::shared_ptr<const LabelImage> labels,
                       const QString& what);
  /// Of a moment that is shown again: the labels that its corrections give.
  void restoreLabels();
  /// Reads what open() reads, and shows it.
  JobQueue::Continuation readFiles(const std::vector<std::filesystem::path>& paths,
                                   const CtReading& reading, const Snapshot& open,
                                   const Progress& progress);
  void become(Snapshot next, const QString& stepName, StepKind kind = StepKind::Work);
  /// Keeps the last steps to undo: 100, or as many as hold 512 MB beside what is shown.
  void forgetOldSteps();
  void openProject(const std::filesystem::path& path, Opened how);
  void showProject(Project project, const std::filesystem::path& path, Opened how);
  /// Remembers the hash of the CT, which takes a while to find, or where it was found again.
  void replaceSource(const std::shared_ptr<const CtSource>& before,
                     const std::shared_ptr<const CtSource>& after,
                     const std::shared_ptr<const CtImage>& found = nullptr);
  /// @param stepName of the undo step; none for a part of the last one
  void split(const QString& stepName);
  /// Makes edits the ones to split with, and what follows them.
  void take(const LobeEdits& edits, const QString& what);
  /// What follows the edits: the lobes, or how the fissures lie in the CT.
  void follow();
  void trace();
  /// Looks for fissures in the CT. @param then what to do once they are known
  void look(std::function<void()> then);
  /// False, and says so, if fissures cannot be edited because of another job.
  bool mayEdit();
  bool sheetsKnown() const;
  /// Forgets compared trees that grew in other lobes, or from other central airways.
  void dropComparison();
  /// Makes the snapshot's regions those of the next breath.
  void followRegions();
  void fail(const QString& title, const QString& sentence);

  Snapshot snapshot_;
  std::vector<GrowthOptions> optionsOf_;  ///< of every method, in the order of growthMethods()
  std::size_t method_ = 0;
  LungOptions lungOptions_;
  BreatheOptions breatheOptions_;
  std::optional<InputFile> breathFile_;     ///< that breatheOptions_.fit is of
  std::optional<InputFile> constantsFile_;  ///< that breatheOptions_.person is of
  std::shared_ptr<const MethodComparison> comparison_;
  LungModel comparedIn_;  ///< the model as it was shown then
  CtSheets sheets_;
  std::vector<Step> undo_;
  std::vector<Step> redo_;
  std::shared_ptr<const AirwayTree> saved_;  ///< the tree that was saved last
  std::filesystem::path projectPath_;
  CtStorage ctStorage_ = CtStorage::Linked;
  UnknownParts unknown_;  ///< of the project's file
  Json openedView_ = Json::object();
  std::uint64_t lastRevision_ = 0;
  std::uint64_t savedRevision_ = 0;
  std::vector<std::filesystem::path> touched_;  ///< what open() and the savers last worked on
  JobQueue jobs_;
};

}  // namespace pneuma
