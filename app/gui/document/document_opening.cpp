#include <algorithm>
#include <utility>

#include "core/error.h"
#include "document/document.h"
#include "document/text.h"
#include "io/volume_file.h"
#include "pipeline/ct_source.h"

// Opening files; which series of several, and where a CT is that moved.
namespace pneuma {

namespace {

constexpr int ThumbnailPixels = 128;  ///< twice what is shown, for sharp displays

QString nameOf(const LungModel& model) {
  if (model.inputs.empty()) return {};
  const QString first = fileNameOf(model.inputs.front().path);
  const std::size_t others = model.inputs.size() - 1;
  return others == 0 ? first : QStringLiteral("%1 and %2 more").arg(first).arg(others);
}

/// What was said and taken of `read` told after what was of `open`.
void addRecord(LungModel& both, const LungModel& read) {
  both.inputs.insert(both.inputs.end(), read.inputs.begin(), read.inputs.end());
  both.warnings.insert(both.warnings.end(), read.warnings.begin(), read.warnings.end());
  both.readSeconds += read.readSeconds;
}

/// `read` put together with what is open, where the one has what the other lacks.
LungModel joined(const LungModel& open, LungModel read) {
  const bool images = read.ct || read.labels;
  const bool treeOnly = !images && !read.surfaces && (read.central || read.opened);
  const bool lobesOnly = !images && read.surfaces && !read.central && !read.opened;
  if (read.labels && !read.ct) {
    LungModel both = open;
    both.labels = read.labels;
    both.lungs = nullptr;
    both.corrections = nullptr;
    if (!open.ct) {
      const std::string name = read.inputs.empty()
                                   ? "this"
                                   : "'" + fileNameOf(read.inputs.front().path).toStdString() + "'";
      throw InvalidInput(name + " holds labels, not a CT; open the CT that they belong to first");
    }
    requireSamePlace(both);
    addRecord(both, read);
    warnOfMisfit(both);
    return both;
  }
  if (treeOnly && (open.surfaces || open.ct)) {
    LungModel both = open;
    both.growth = nullptr;
    if (read.central) {
      both.central = read.central;
      both.opened = nullptr;
    } else {
      both.opened = read.opened;
    }
    addRecord(both, read);
    return both;
  }
  // A built-in organ's airways lead into the organ, not into a person's lobes.
  const bool keepsAirways = lobesOnly && !open.surfaces && !open.regions && open.central;
  const bool keepsCt = lobesOnly && open.ct;
  if (keepsAirways) read.central = open.central;
  if (keepsCt) {
    read.ct = open.ct;
    read.ctSource = open.ctSource;
    read.labels = open.labels;
    read.lungs = open.lungs;
    read.corrections = open.corrections;
  }
  if (keepsAirways || keepsCt) {
    read.inputs.insert(read.inputs.begin(), open.inputs.begin(), open.inputs.end());
    read.warnings.insert(read.warnings.begin(), open.warnings.begin(), open.warnings.end());
  }
  return read;
}

}  // namespace

JobQueue::Continuation Document::readFiles(const std::vector<std::filesystem::path>& paths,
                                           const CtReading& reading, const Snapshot& open,
                                           const Progress& progress) {
  LungModel model =
      joined(open.model, openFiles(paths, reading, progress.part(0.0, 0.95, "reading")));
  const QString name = nameOf(model);
  Snapshot next = nextSnapshot(open, std::move(model));
  next.name = name;
  return [this, next = std::move(next)] {
    emit said(tr("Opened %1").arg(whatWasRead(next.model)));
    become(next, tr("open"), StepKind::Opening);
    if (next.model.ct && !next.model.labels) findLungs(StepKind::Opening);
  };
}

void Document::openSeries(const SeriesList& list, int row, bool fillGaps) {
  stopDrawing();
  touched_ = list.paths;
  CtReading reading;
  reading.series.wanted = seriesName((*list.series)[static_cast<std::size_t>(row)].uid);
  reading.series.listed = list.series;
  reading.corrections.fillGaps =
      fillGaps && list.rows[static_cast<std::size_t>(row)].use == SeriesRow::Use::WithGapsOnly;
  jobs_.push(tr("Opening"),
             [this, paths = list.paths, reading, open = snapshot_](const Progress& progress) {
               return readFiles(paths, reading, open, progress);
             });
}

bool Document::hasOtherSeries() const {
  const LungModel& model = snapshot_.model;
  return model.ct && model.ctSource && !isVolumeFile(model.ctSource->path);
}

void Document::listSeries() {
  if (!hasOtherSeries()) return;
  stopDrawing();
  touched_ = {snapshot_.model.ctSource->path};
  jobs_.push(tr("Looking for series"),
             [this, source = snapshot_.model.ctSource](const Progress& progress) {
               std::vector<DicomSeries> all = listDicomSeries(source->path, progress);
               const std::string opened = chosenSeries(all, {source->series}).uid;
               return [this, list = seriesList({source->path}, std::move(all), opened)] {
                 emit seriesToChoose(list);
               };
             });
}

void Document::drawSeries(const SeriesList& list) {
  for (std::size_t row = 0; row < list.rows.size(); ++row) {
    jobs_.push(
        JobKind::DrawingSeries, tr("Drawing the series"), [this, list, row](const Progress&) {
          return [this, list, row, picture = thumbnailOf((*list.series)[row], ThumbnailPixels)] {
            emit seriesDrawn(list, static_cast<int>(row), picture);
          };
        });
  }
}

void Document::stopDrawing() { jobs_.supersede({JobKind::DrawingSeries}); }

void Document::locateCt(const std::filesystem::path& path) {
  if (!ctMissing()) return;
  touched_ = {path};
  const auto missed = [this, path](const QString& sentence) {
    emit ctMissed(tr("Locate the CT"), withoutFolders(sentence, {path}));
  };
  jobs_.push(tr("Looking at the CT"),
             [this, path, missed, before = snapshot_.model.ctSource](
                 const Progress& progress) -> JobQueue::Continuation {
               try {
                 FoundCt found = foundCt(*before, path, progress);
                 const auto after = std::make_shared<const CtSource>(std::move(found.source));
                 return [this, before, after, ct = std::move(found.image)] {
                   const bool wasSaved = !modified();
                   replaceSource(before, after, ct);
                   snapshot_.revision = ++lastRevision_;
                   emit said(tr("The project has its CT again: %1").arg(sizeText(ct->geometry)));
                   emit changed();
                   emit ctFound(wasSaved);
                 };
               } catch (const Error& problem) {
                 return [missed, sentence = qtText(problem.what())] { missed(sentence); };
               }
             });
}

}  // namespace pneuma
