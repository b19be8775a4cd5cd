#include <QAction>
#include <QCommandLineParser>
#include <QScreen>
#include <QSettings>
#include <QTimer>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/error.h"
#include "document/recovery.h"
#include "end_signals.h"
#include "io/atomic_file.h"
#include "io/unfinished_files.h"
#include "pipeline/report.h"
#include "script_recorder.h"
#include "scripting.h"
#include "tour.h"
#include "widgets/application.h"
#include "widgets/dialogs.h"
#include "widgets/main_window.h"
#include "widgets/size_menu.h"

namespace {

using namespace pneuma;

constexpr const char* ThemeKey = "theme";
constexpr const char* SizeKey = "size";
constexpr int UsualSize = 100;
constexpr const char* RecentKey = "recent";
constexpr const char* MouseKey = "mouse";
constexpr const char* WelcomedKey = "welcomed";

bool hasDisplay() {
#ifdef Q_OS_UNIX
  return qEnvironmentVariableIsSet("DISPLAY") || qEnvironmentVariableIsSet("WAYLAND_DISPLAY") ||
         qEnvironmentVariableIsSet("QT_QPA_PLATFORM");
#else
  return true;
#endif
}

struct CommandLine {
  QCommandLineParser parser;
  QCommandLineOption help{{"h", "help"}, "Show this help."};
  QCommandLineOption version{{"v", "version"}, "Show the version."};
  QCommandLineOption theme{"theme", "dark or light.", "name"};
  QCommandLineOption sample{"sample", "Open the sample chest."};
  QCommandLineOption openFolder{"open-folder", "Ask for a folder to open."};
  QCommandLineOption play{"play", "Play a script of steps, then quit.", "script.json"};
  QCommandLineOption record{"record", "Write what is done in the window as a script for --play.",
                            "script.json"};
  QCommandLineOption settings{"settings", "Settings in this file, also while a script is played.",
                              "settings.ini"};
  QCommandLineOption screenshots{"screenshots", "Folder for the script's pictures.", "folder", "."};

  CommandLine() {
    parser.setApplicationDescription(
        "Grows and shows airway trees in lung lobes. Research use only; not a medical device.");
    play.setFlags(QCommandLineOption::HiddenFromHelp);
    record.setFlags(QCommandLineOption::HiddenFromHelp);
    screenshots.setFlags(QCommandLineOption::HiddenFromHelp);
    settings.setFlags(QCommandLineOption::HiddenFromHelp);
    parser.addOptions(
        {help, version, theme, sample, openFolder, play, record, settings, screenshots});
    parser.addPositionalArgument(
        "FILE", "A project, a CT, surfaces, folders and airway trees to open.", "[FILE...]");
  }
};

int say(std::FILE* stream, const std::string& text, ExitCode code) {
  std::fputs(text.c_str(), stream);
  return static_cast<int>(code);
}

int playScript(MainWindow& window, const QString& script, const QString& folder) {
  try {
    ScriptPlayer(window, folder).play(script);
    return static_cast<int>(ExitCode::Done);
  } catch (const ScriptError& error) {
    return say(stderr, std::string("pneuma-desktop: ") + error.what() + "\n",
               ExitCode::CheckFailed);
  }
}

/// Before there is an application that knows its settings' names.
int chosenSize() {
  const QSettings settings(QStringLiteral("pneuma"), QStringLiteral("pneuma-desktop"));
  return settings.value(SizeKey, UsualSize).toInt();
}

/// What a person chose, here or in an earlier window; null: this window neither knows nor keeps it.
std::unique_ptr<QSettings> settingsFor(const CommandLine& line) {
  if (line.parser.isSet(line.settings)) {
    return std::make_unique<QSettings>(line.parser.value(line.settings), QSettings::IniFormat);
  }
  // A script must not depend on what somebody chose last.
  if (line.parser.isSet(line.play)) return nullptr;
  return std::make_unique<QSettings>();
}

void takeAndKeep(MainWindow& window, QSettings& settings) {
  window.setSize(settings.value(SizeKey, UsualSize).toInt());
  window.setRecent(settings.value(RecentKey).toStringList());
  window.setMouse(mouseProfile(settings.value(MouseKey).toString()));
  QObject::connect(&window, &MainWindow::themeChosen, [&settings](ThemeName name) {
    settings.setValue(ThemeKey, name == ThemeName::Light ? "light" : "dark");
  });
  QObject::connect(&window, &MainWindow::sizeChosen,
                   [&settings](int percent) { settings.setValue(SizeKey, percent); });
  QObject::connect(&window, &MainWindow::mouseChosen, [&settings](MouseProfile profile) {
    settings.setValue(MouseKey, habitsOf(profile).name);
  });
  QObject::connect(&window, &MainWindow::recentChanged,
                   [&settings](const QStringList& paths) { settings.setValue(RecentKey, paths); });
  QObject::connect(&window, &MainWindow::welcomed,
                   [&settings] { settings.setValue(WelcomedKey, true); });
}

int runWindow(const CommandLine& line) {
  const bool playing = line.parser.isSet(line.play);
  const std::unique_ptr<QSettings> settings = settingsFor(line);
  QString theme = line.parser.value(line.theme);
  if (theme.isEmpty() && settings) theme = settings->value(ThemeKey).toString();

  MainWindow window;
  window.setTheme(theme == QLatin1String("light") ? ThemeName::Light : ThemeName::Dark);
  if (settings) takeAndKeep(window, *settings);
  Tour tour(window);
  QObject::connect(&window, &MainWindow::tourAsked, &tour, &Tour::start);
  // What was lost is offered before anything else is kept. Not to scripts, unless they say where.
  std::unique_ptr<Recovery> recovery;
  std::vector<LostWork> lost;
  const std::filesystem::path kept = Recovery::usualFolder();
  if (!kept.empty() && (!playing || qEnvironmentVariableIsSet("XDG_STATE_HOME"))) {
    lost = Recovery::lostWork(kept);
    recovery = std::make_unique<Recovery>(window.document(), kept);
  }
  // Not larger than the screen, whose pixels may be scaled.
  window.resize(QSize(1600, 1000).boundedTo(window.screen()->availableSize()));
  window.show();
  std::vector<std::filesystem::path> files;
  for (const QString& file : line.parser.positionalArguments())
    files.emplace_back(file.toStdString());
  if (!lost.empty()) {
    offerRecovery(
        &window, lost.front().when, [&] { recovery->recover(lost.front()); },
        [&] { Recovery::throwAway(lost.front()); });
  }
  if (settings && lost.empty() && !settings->value(WelcomedKey).toBool()) window.welcome();
  window.open(std::move(files));
  // What the entry in a desktop's menu offers beside the window itself.
  for (const auto& [option, action] :
       {std::pair{&line.sample, "actionSample"}, std::pair{&line.openFolder, "actionOpenFolder"}}) {
    if (line.parser.isSet(*option)) {
      QTimer::singleShot(0, window.findChild<QAction*>(QLatin1String(action)), &QAction::trigger);
    }
  }
  if (playing) {
    QTimer::singleShot(0, &window, [&] {
      QApplication::exit(
          playScript(window, line.parser.value(line.play), line.parser.value(line.screenshots)));
    });
  }
  if (!line.parser.isSet(line.record)) return QApplication::exec();
  const ScriptRecorder recorder(window);
  const int result = QApplication::exec();
  try {
    writeFile(line.parser.value(line.record).toStdString(), recorder.text().toStdString());
  } catch (const Error& error) {
    return say(stderr, std::string("pneuma-desktop: ") + error.what() + "\n", error.code());
  }
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  leaveNoCoreDumps();
#ifdef SIGXFSZ
  std::signal(SIGXFSZ, SIG_IGN);  // a file larger than allowed is said, and does not end the window
#endif
  CommandLine line;
  QStringList arguments;
  for (int i = 0; i < argc; ++i) arguments << QString::fromLocal8Bit(argv[i]);
  if (!hasDisplay()) {
    // Help and version must work on a machine without a display, where QApplication would end us.
    const bool parsed = line.parser.parse(arguments);
    if (parsed && line.parser.isSet(line.version)) {
      return say(stdout, "pneuma-desktop " + versionText() + "\n", ExitCode::Done);
    }
    return say(
        stderr,
        "pneuma-desktop: there is no display here; start it on a desktop, or run the command "
        "line program pneuma.\n",
        ExitCode::NoRendering);
  }
  const bool others = arguments.contains(QStringLiteral("--settings"));
  if (!arguments.contains(QStringLiteral("--play")) && !others) takeSize(chosenSize());
  const auto application = makeApplication(argc, argv);
  tidyUpAtEndSignals();
  if (!line.parser.parse(QCoreApplication::arguments())) {
    return say(stderr, "pneuma-desktop: " + line.parser.errorText().toStdString() + "\n",
               ExitCode::Usage);
  }
  if (line.parser.isSet(line.help)) {
    return say(stdout, line.parser.helpText().toStdString(), ExitCode::Done);
  }
  if (line.parser.isSet(line.version)) {
    return say(stdout, "pneuma-desktop " + versionText() + "\n", ExitCode::Done);
  }
  return runWindow(line);
}
