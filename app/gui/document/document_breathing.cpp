#include <chrono>
#include <utility>

#include "core/seconds.h"
#include "document/breath.h"
#include "document/document.h"
#include "document/text.h"
#include "pipeline/breathe_files.h"
#include "pipeline/measured_breath.h"
#include "pipeline/person_motion.h"

// What the document knows of breathing.
namespace pneuma {

void Document::setBreatheOptions(const BreatheOptions& options) {
  if (options == breatheOptions_) return;
  breatheOptions_ = options;
  emit breatheOptionsChanged();
}

void Document::setRegions(std::vector<StiffnessRegion> regions, const QString& what) {
  if (jobs_.busy() || regions == snapshot_.regions) return;
  Snapshot next = snapshot_;
  next.regions = std::move(regions);
  become(std::move(next), what);
}

void Document::followRegions() {
  BreatheOptions options = breatheOptions_;
  options.regions = snapshot_.regions;
  setBreatheOptions(options);
}

void Document::openConstants(const std::filesystem::path& path) {
  touched_ = {path};
  jobs_.push(tr("Reading the constants of a person"), [this, path](const Progress&) {
    auto read = std::make_shared<PersonMotion>(readPersonMotion(path));
    read->name = "'" + path.filename().string() + "'";  // folders are nobody's business
    const std::shared_ptr<const PersonMotion> person = std::move(read);
    return JobQueue::Continuation([this, path, person, file = inputFile(path)] {
      constantsFile_ = file;
      BreatheOptions options = breatheOptions_;
      options.person = person;
      setBreatheOptions(options);
      emit said(tr("Opened %1: %2").arg(fileNameOf(path), qtText(basisOf(*person))));
    });
  });
}

void Document::openMeasuredBreath(const std::filesystem::path& path) {
  touched_ = {path};
  jobs_.push(tr("Fitting a measured breath"), [this, path](const Progress&) {
    const auto fit = std::make_shared<const BreathFit>(fitBreath(readMeasuredBreath(path)));
    return JobQueue::Continuation([this, path, fit, file = inputFile(path)] {
      breathFile_ = file;
      BreatheOptions options = breatheOptions_;
      options.fit = fit;
      options.tidalMl = 0.0;  // the measured breath has both
      options.periodSeconds = 0.0;
      setBreatheOptions(options);
      emit said(tr("Opened %1: fitted to %2 % of the breath's volume")
                    .arg(fileNameOf(path))
                    .arg(100.0 * fit->rms, 0, 'f', 2));
    });
  });
}

void Document::forgetConstants() {
  BreatheOptions options = breatheOptions_;
  options.person = nullptr;
  setBreatheOptions(options);
}

void Document::forgetMeasuredBreath() {
  BreatheOptions options = breatheOptions_;
  options.fit = nullptr;
  setBreatheOptions(options);
}

bool Document::canBreathe() const {
  if (!snapshot_.model.surfaces) return false;
  for (const LobeSurface& surface : *snapshot_.model.surfaces) {
    if (side(surface.lobe) != Side::None) return true;
  }
  return false;
}

bool Document::breathOutOfDate() const {
  return snapshot_.breath && !(snapshot_.breath->options == breatheOptions_);
}

void Document::breathe() {
  if (waitsForLungs([this] { breathe(); })) return;
  std::vector<InputFile> measured;
  if (breatheOptions_.fit && breathFile_) measured.push_back(*breathFile_);
  if (breatheOptions_.person && constantsFile_) measured.push_back(*constantsFile_);
  jobs_.push(
      JobKind::Breathing, tr("Breathing"),
      [this, before = snapshot_, options = breatheOptions_, measured](const Progress& progress) {
        const auto start = std::chrono::steady_clock::now();
        BreathingLungs lungs =
            pneuma::breathe(before.model, options, progress.part(0.0, 0.85, "moving lungs"));
        LungModel reported = before.model;
        reported.inputs.insert(reported.inputs.end(), measured.begin(), measured.end());
        Json report = breatheReport(reported, lungs, options);
        progress.report(0.9);
        Snapshot next = before;
        next.breath = breathOf(before.model, std::move(lungs), options, std::move(report));
        const double seconds = secondsSince(start);
        return JobQueue::Continuation([this, seconds, next = std::move(next)] {
          emit said(tr("Breathing in %1: %2 a breath, %3 breaths a minute")
                        .arg(withUnit(seconds, 1, "s"),
                             withUnit(1000.0 * next.breath->lungs.cycle.tidal, 0, "mL"),
                             withUnit(60.0 / next.breath->lungs.drive.period, 1, "")));
          become(next, tr("breathe"));
        });
      });
}

void Document::saveBreath(const std::filesystem::path& path) {
  const auto breath = snapshot_.breath;
  if (!breath) {
    emit failed(tr("Save the breath"), tr("Nothing breathes yet: press Breathe first."));
    return;
  }
  touched_ = {path};
  jobs_.push(tr("Saving the breath"), [this, path, breath](const Progress& progress) {
    writeBreath(path, breath->lungs, breath->report, progress);
    return JobQueue::Continuation([this, path, breath] {
      emit said(
          tr("Saved %1: %2")
              .arg(fileNameOf(path), counted(breath->lungs.frames.size(), "frame", "frames")));
    });
  });
}

}  // namespace pneuma
