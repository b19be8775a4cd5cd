#include "document/text.h"

#include <QLocale>
#include <QRegularExpression>

namespace pneuma {

namespace {

const QLocale& english() {
  static const QLocale locale(QLocale::English, QLocale::UnitedStates);
  return locale;
}

}  // namespace

QString grouped(std::size_t count) { return english().toString(static_cast<qulonglong>(count)); }

QString withUnit(double value, int decimals, const char* unit) {
  const QString number = english().toString(value, 'f', decimals);
  return *unit == '\0' ? number : number + QStringLiteral(" ") + QString::fromUtf8(unit);
}

QString counted(std::size_t count, const char* one, const char* many) {
  return grouped(count) + QStringLiteral(" ") + QString::fromUtf8(count == 1 ? one : many);
}

QString qtText(std::string_view utf8) {
  return QString::fromUtf8(utf8.data(), static_cast<int>(utf8.size()));
}

QString sizeText(const ImageGeometry& geometry) {
  return QStringLiteral("%1 × %2 × %3")
      .arg(geometry.size[0])
      .arg(geometry.size[1])
      .arg(geometry.size[2]);
}

QString capitalised(std::string_view words) {
  QString text = qtText(words);
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text;
}

QString organTitle(std::string_view name) {
  return capitalised(name).replace(QLatin1Char('-'), QLatin1Char(' '));
}

QString fileNameOf(const std::filesystem::path& path) {
  const auto last = path.has_filename() ? path.filename() : path.parent_path().filename();
  return qtText(last.string());
}

QString withCommands(QString sentence) {
  static const QRegularExpression option(
      QStringLiteral("\\((--(?:fill-gaps|fix-tilt|resample))\\)"));
  return sentence.replace(option, QStringLiteral("by 'pneuma import \\1'"));
}

QString withoutFolders(QString sentence, const std::vector<std::filesystem::path>& paths) {
  for (const auto& path : paths) {
    std::error_code ignored;
    const bool isFolder = std::filesystem::is_directory(path, ignored);
    const QString folder = qtText((isFolder ? path : path.parent_path()).string());
    if (folder.isEmpty() || folder == QLatin1String("/")) continue;
    sentence.replace(folder + QLatin1Char('/'), QString());
    if (isFolder) sentence.replace(folder, QStringLiteral("..."));
  }
  return sentence;
}

}  // namespace pneuma
