#include <QApplication>
#include <QClipboard>
#include <QStackedWidget>
#include <filesystem>

#include "document/shell_command.h"
#include "document/text.h"
#include "widgets/commands.h"
#include "widgets/dialogs.h"
#include "widgets/error_card.h"
#include "widgets/export_panel.h"
#include "widgets/main_window.h"
#include "widgets/scene_view.h"
#include "widgets/status_strip.h"
#include "widgets/step_button.h"

// What the window does for the step "Export", and commands to copy.
namespace pneuma {

void MainWindow::connectExport() {
  connect(actions_.exportCase, &QAction::triggered, this, &MainWindow::exportCase);
  connect(actions_.copyCommand, &QAction::triggered, this, &MainWindow::copyCommand);
  connect(exportPanel_, &ExportPanel::kindChanged, this, &MainWindow::updateExportActions);
}

void MainWindow::exportCase() {
  errorCard_->hide();
  goTo(ExportStep);
  if (const auto preset = presetOf(exportPanel_->kind())) {
    askForExportFolder(this, [this, kind = *preset](const QString& name) {
      const std::filesystem::path folder = name.toStdString();
      const std::string format = exportPanel_->presetFormat().toStdString();
      const auto write = [this, kind, folder, format] {
        document_.exportCase(kind, folder, format, view_->lookingFrom());
      };
      const auto there = document_.filesInTheWay(kind, folder, format);
      if (there.empty()) {
        write();
        return;
      }
      QStringList names;
      for (const auto& file : there) names << qtText(file.string());
      askBeforeReplacing(this, fileNameOf(folder), names, write);
    });
  } else if (exportPanel_->kind() == ExportKind::Figure) {
    savePicture();
  } else {
    askWhereToSave(this, tr("Save the report"),
                   tr("PDF, a page (*.pdf);;HTML, a page (*.html);;JSON, everything (*.json)"),
                   QStringLiteral("pdf"), [this](const QString& name) {
                     CaseReportOptions options;
                     options.identify = exportPanel_->identify();
                     document_.saveReport(name.toStdString(), options);
                   });
  }
}

ShellCommand MainWindow::commandNow() const {
  if (comparing()) return compareCommand(document_);
  ExportWish wish;
  wish.kind = exportPanel_->kind();
  wish.identify = exportPanel_->identify();
  wish.view = view_->lookingFrom();
  wish.format = exportPanel_->presetFormat().toStdString();
  return shellCommand(static_cast<WorkStep>(panels_->currentIndex()), document_, wish);
}

void MainWindow::copyCommand() {
  const ShellCommand command = commandNow();
  if (!command.obstacle.isEmpty()) {
    status_->say(command.obstacle);
    return;
  }
  QApplication::clipboard()->setText(command.text() + QLatin1Char('\n'));
  const auto count = static_cast<std::size_t>(command.lines.size());
  status_->say(tr("Copied for a terminal: %1").arg(counted(count, "line", "lines")));
}

void MainWindow::updateExportActions() {
  const bool busy = document_.jobs().busy();
  const bool drawn =
      exportPanel_->kind() == ExportKind::Figure || exportPanel_->kind() == ExportKind::Film;
  const QString lack =
      drawn && !view_->obstacle().isEmpty() ? view_->obstacle() : exportPanel_->lack();
  allow(*actions_.exportCase, lack.isEmpty() && !busy,
        tr("Write what is chosen in the step Export"), busy ? tr("A job is running") : lack);
  const QString obstacle = commandNow().obstacle;
  allow(*actions_.copyCommand, obstacle.isEmpty(),
        tr("Copies the commands that do this step with these options"), obstacle);
}

}  // namespace pneuma
