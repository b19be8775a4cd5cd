#include "document/series_list.h"

#include <QObject>
#include <QStringList>
#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "document/text.h"
#include "io/input_files.h"
#include "io/volume_file.h"
#include "render/grey_window.h"

namespace pneuma {

namespace {

constexpr int FewPoints = 2;  ///< of the rating; a series with no more is hardly one of the lungs

QString millimetres(double mm) { return mm > 0.0 ? QString::number(mm, 'f', 2) : QString(); }

/// `series 3 "Scout" is a localizer` -> "It is a localizer": a row says of which series already.
QString withoutTitle(const DicomSeries& series, const std::string& sentence) {
  const std::string title = titleOf(series);
  std::string_view rest = sentence;
  if (!rest.starts_with(title)) return capitalised(rest);
  rest.remove_prefix(title.size());
  if (rest.starts_with(": ")) return capitalised(rest.substr(2));
  return QStringLiteral("It") + qtText(rest);
}

QString reasonsOf(const DicomSeries& series) {
  QStringList reasons;
  for (const std::string& reason : series.reasons) reasons << qtText(reason);
  return reasons.join(QStringLiteral(", "));
}

SeriesRow rowOf(const DicomSeries& series) {
  using Use = SeriesRow::Use;
  SeriesRow row;
  row.description =
      series.description.empty() ? QObject::tr("Not described") : qtText(series.description);
  row.modality = series.modality.empty() ? QStringLiteral("?") : qtText(series.modality);
  row.slices = grouped(series.slices.size());
  row.kernel = qtText(series.kernel);
  const QString thickness = millimetres(series.thicknessMm);
  const QString spacing = series.refusal ? QString() : millimetres(series.check.spacingMm);
  row.spacing =
      QStringLiteral("%1 / %2").arg(spacing.isEmpty() ? QStringLiteral("-") : spacing,
                                    thickness.isEmpty() ? QStringLiteral("-") : thickness);
  row.size =
      QStringLiteral("%1 × %2 × %3")
          .arg(series.columns)
          .arg(series.rows)
          .arg(series.refusal ? static_cast<int>(series.slices.size()) : series.geometry.size[2]);
  if (const std::string obstacle = obstacleOf(series); !obstacle.empty()) {
    const bool opensFilled = obstacleOf(series, {.fillGaps = true}).empty();
    row.use = opensFilled ? Use::WithGapsOnly : Use::Impossible;
    row.why = opensFilled
                  ? QObject::tr("Slices are missing: %1. Find them, or let them be filled in.")
                        .arg(qtText(gapsText(series)))
                  : QObject::tr("Cannot be opened. %1.").arg(withoutTitle(series, obstacle));
  } else if (series.ofAnotherPart) {
    row.use = Use::Doubtful;
    row.why =
        QObject::tr("Not of the chest: it states the body part %1.").arg(qtText(series.bodyPart));
  } else if (series.rating <= FewPoints) {
    row.use = Use::Doubtful;
    row.why = QObject::tr("Doubtful: %1.").arg(reasonsOf(series));
  } else {
    row.use = Use::Possible;
    row.why = QObject::tr("Can be opened: %1.").arg(reasonsOf(series));
  }
  return row;
}

/// From the darkest to the brightest, padding aside.
GreyWindow wholeRange(const CtImage& image) {
  double low = 1.0;
  double high = 0.0;
  for (const std::int16_t value : image.voxels) {
    if (value == PaddingHu) continue;
    low = low > high ? value : std::min<double>(low, value);
    high = std::max<double>(high, value);
  }
  return {std::max(NarrowestWindowHu, high - low), 0.5 * (low + high)};
}

/// The mean of the voxels under each pixel.
Picture reduced(const CtImage& slice, double aspect, int edge, const GreyWindow& window) {
  const int columns = slice.geometry.size[0];
  const int rows = slice.geometry.size[1];
  const double across = columns;
  const double down = rows * aspect;
  const double scale = std::min(1.0, edge / std::max(across, down));
  Picture picture;
  picture.width = std::max(1, static_cast<int>(std::lround(across * scale)));
  picture.height = std::max(1, static_cast<int>(std::lround(down * scale)));
  const auto border = [](int pixel, int pixels, int voxels) {
    return static_cast<int>(static_cast<std::int64_t>(pixel) * voxels / pixels);
  };
  for (int y = 0; y < picture.height; ++y) {
    const int top = border(y, picture.height, rows);
    const int bottom = std::max(top + 1, border(y + 1, picture.height, rows));
    for (int x = 0; x < picture.width; ++x) {
      const int left = border(x, picture.width, columns);
      const int right = std::max(left + 1, border(x + 1, picture.width, columns));
      double sum = 0.0;
      for (int j = top; j < bottom; ++j) {
        for (int i = left; i < right; ++i) sum += slice.at(i, j, 0);
      }
      const std::uint8_t grey = window.grey(sum / ((bottom - top) * (right - left)));
      picture.rgb.insert(picture.rgb.end(), 3, grey);
    }
  }
  return picture;
}

}  // namespace

bool SeriesList::toBeChosen() const {
  const auto plain = [](const SeriesRow& row) {
    return row.use == SeriesRow::Use::Recommended || row.use == SeriesRow::Use::Possible;
  };
  const auto count = std::ranges::count_if(rows, plain);
  if (count == 1) return !plain(rows.front());  // something better is there, but for its gaps
  return count > 1 || rows.size() > 1 || chosen >= 0;
}

QString SeriesList::sentence() const {
  const QString names = QObject::tr("Names of patients are not shown.");
  const QString count = counted(rows.size(), "series is", "series are");
  if (chosen < 0) {
    return QObject::tr("%1 here, and none can be opened; the table says why. Open another folder.")
        .arg(count);
  }
  if (rows[static_cast<std::size_t>(chosen)].use == SeriesRow::Use::Recommended) {
    return QObject::tr(
               "%1 here. The one that suits lungs best is chosen; open another if you "
               "like. %2")
        .arg(count, names);
  }
  return QObject::tr("%1 here, and none is plainly one of the lungs: look before you open one. %2")
      .arg(count, names);
}

SeriesList seriesList(std::vector<std::filesystem::path> paths, std::vector<DicomSeries> series,
                      const std::string& openedUid) {
  SeriesList list;
  list.paths = std::move(paths);
  for (const DicomSeries& one : series) {
    list.rows.push_back(rowOf(one));
    list.rows.back().opened = !openedUid.empty() && one.uid == openedUid;
  }
  const auto best = std::ranges::find(list.rows, SeriesRow::Use::Possible, &SeriesRow::use);
  if (best != list.rows.end()) {
    best->use = SeriesRow::Use::Recommended;
    best->why = QObject::tr("Recommended: %1.")
                    .arg(reasonsOf(series[static_cast<std::size_t>(best - list.rows.begin())]));
  }
  const auto opens = std::ranges::find_if(list.rows, &SeriesRow::canOpen);
  const auto chosen = best != list.rows.end() ? best : opens;
  if (chosen != list.rows.end()) list.chosen = static_cast<int>(chosen - list.rows.begin());
  list.series = std::make_shared<const std::vector<DicomSeries>>(std::move(series));
  return list;
}

const std::filesystem::path* dicomPlace(const std::vector<std::filesystem::path>& paths) {
  const std::filesystem::path* place = nullptr;
  for (const std::filesystem::path& path : paths) {
    if (isProjectFileName(path) || isVolumeFile(path) || !isDicomPath(path)) continue;
    if (place != nullptr) return nullptr;
    place = &path;
  }
  return place;
}

Picture thumbnailOf(const DicomSeries& series, int edge) {
  if (series.slices.empty()) return {};
  try {
    const CtImage slice = readDicomSlice(series, series.slices.size() / 2);
    const Vec3& pixel = slice.geometry.spacing;
    const GreyWindow window = series.modality == "CT" ? GreyWindow{} : wholeRange(slice);
    return reduced(slice, pixel.y() / pixel.x(), edge, window);
  } catch (const Error&) {
    return {};  // the row says what is wrong with the series
  }
}

}  // namespace pneuma
