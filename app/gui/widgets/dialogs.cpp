#include "widgets/dialogs.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <utility>

#include "document/text.h"
#include "pipeline/report.h"
#include "widgets/icons.h"

namespace pneuma {

namespace {

QFileDialog* fileDialog(QWidget* parent, const QString& title, const char* name) {
  auto* dialog = new QFileDialog(parent, title);
  dialog->setObjectName(QString::fromUtf8(name));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  return dialog;
}

QMessageBox* questionBox(QWidget* parent, const QString& text, const QString& question) {
  auto* box = new QMessageBox(parent);
  box->setObjectName(QStringLiteral("closeQuestion"));
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setWindowTitle(QObject::tr("Pneuma"));
  box->setText(text);
  box->setInformativeText(question);
  return box;
}

void addAnswer(QMessageBox* box, QMessageBox::StandardButton which, const char* name,
               std::function<void()> answer) {
  QPushButton* made = box->addButton(which);
  made->setObjectName(QString::fromUtf8(name));
  if (answer) QObject::connect(made, &QPushButton::clicked, box->parent(), std::move(answer));
  if (which == QMessageBox::Cancel) box->setEscapeButton(QMessageBox::Cancel);
}

}  // namespace

void askForFiles(QWidget* parent, std::function<void(const QStringList&)> chosen) {
  auto* dialog = fileDialog(parent, QObject::tr("Open a project, a CT, lobe surfaces or airways"),
                            "openDialog");
  dialog->setFileMode(QFileDialog::ExistingFiles);
  dialog->setNameFilters(
      {QObject::tr("Everything that opens (*.nii *.nii.gz *.nrrd *.nhdr *.mha "
                   "*.mhd *.dcm *.zip *.stl *.obj *.ply *.vtp *.vtu *.swc *.csv *.json *.pneuma)"),
       QObject::tr("Projects (*.pneuma)"),
       QObject::tr("CTs and labels (*.nii *.nii.gz *.nrrd *.nhdr *.mha *.mhd *.dcm "
                   "*.zip)"),
       QObject::tr("Surfaces and trees (*.stl *.obj *.ply *.vtp *.vtu *.swc "
                   "*.csv *.json)"),
       QObject::tr("All files (*)")});
  QObject::connect(dialog, &QFileDialog::filesSelected, parent, std::move(chosen));
  dialog->open();
}

void askForFile(QWidget* parent, const QString& title, const QStringList& filters,
                std::function<void(const QString&)> chosen) {
  auto* dialog = fileDialog(parent, title, "fileDialog");
  dialog->setFileMode(QFileDialog::ExistingFile);
  dialog->setNameFilters(filters);
  QObject::connect(dialog, &QFileDialog::fileSelected, parent, std::move(chosen));
  dialog->open();
}

void askForFolder(QWidget* parent, std::function<void(const QString&)> chosen) {
  auto* dialog =
      fileDialog(parent, QObject::tr("Open a folder of a CT or of lobe surfaces"), "folderDialog");
  dialog->setFileMode(QFileDialog::Directory);
  dialog->setOption(QFileDialog::ShowDirsOnly);
  QObject::connect(dialog, &QFileDialog::fileSelected, parent, std::move(chosen));
  dialog->open();
}

void askForCt(QWidget* parent, bool folder, std::function<void(const QString&)> chosen) {
  auto* dialog =
      fileDialog(parent, QObject::tr("Where the CT of the project is now"), "locateDialog");
  dialog->setFileMode(folder ? QFileDialog::Directory : QFileDialog::ExistingFile);
  QObject::connect(dialog, &QFileDialog::fileSelected, parent, std::move(chosen));
  dialog->open();
}

void askForExportFolder(QWidget* parent, std::function<void(const QString&)> chosen) {
  auto* dialog = fileDialog(parent, QObject::tr("The folder to export into"), "exportDialog");
  dialog->setFileMode(QFileDialog::Directory);
  dialog->setOption(QFileDialog::ShowDirsOnly);
  dialog->setLabelText(QFileDialog::Accept, QObject::tr("Export"));
  QObject::connect(dialog, &QFileDialog::fileSelected, parent, std::move(chosen));
  dialog->open();
}

void askBeforeReplacing(QWidget* parent, const QString& folder, const QStringList& files,
                        std::function<void()> replace) {
  constexpr int Named = 6;
  QStringList named = files.mid(0, Named);
  if (files.size() > Named) named << QObject::tr("and %1 more").arg(files.size() - Named);
  QMessageBox* box =
      questionBox(parent, QObject::tr("These files are in \u201c%1\u201d already.").arg(folder),
                  QObject::tr("%1\n\nReplace them?").arg(named.join(QLatin1Char('\n'))));
  box->setObjectName(QStringLiteral("replaceQuestion"));
  addAnswer(box, QMessageBox::Yes, "replaceFiles", std::move(replace));
  addAnswer(box, QMessageBox::Cancel, "replaceCancel", {});
  box->button(QMessageBox::Yes)->setText(QObject::tr("Replace"));
  box->setDefaultButton(QMessageBox::Cancel);
  box->open();
}

void askWhereToSave(QWidget* parent, const QString& title, const QString& filters,
                    const QString& suffix, std::function<void(const QString&)> chosen) {
  auto* dialog = fileDialog(parent, title, "saveDialog");
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setFileMode(QFileDialog::AnyFile);
  dialog->setNameFilters(filters.split(QStringLiteral(";;")));
  dialog->setDefaultSuffix(suffix);
  QObject::connect(dialog, &QFileDialog::filterSelected, dialog, [dialog](const QString& filter) {
    const int dot = filter.lastIndexOf(QLatin1String("*.")) + 2;
    dialog->setDefaultSuffix(filter.mid(dot, filter.lastIndexOf(QLatin1Char(')')) - dot));
  });
  // Qt adds no suffix in a folder with a dot in its name, and has not asked of the file with one.
  QObject::connect(dialog, &QFileDialog::fileSelected, parent,
                   [parent, dialog, chosen = std::move(chosen)](const QString& name) {
                     const QFileInfo typed(name);
                     if (typed.fileName().contains(QLatin1Char('.'))) {
                       chosen(name);
                       return;
                     }
                     const QFileInfo whole(name + QLatin1Char('.') + dialog->defaultSuffix());
                     const QString path = whole.filePath();
                     if (!whole.exists()) {
                       chosen(path);
                       return;
                     }
                     askBeforeReplacing(parent, whole.dir().dirName(), {whole.fileName()},
                                        [chosen, path] { chosen(path); });
                   });
  dialog->open();
}

void askBeforeLosing(QWidget* parent, const QString& question, std::function<void()> save,
                     std::function<void()> discard) {
  QMessageBox* box = questionBox(parent, QObject::tr("The work is not saved."),
                                 QObject::tr("Save it as a project %1?").arg(question));
  addAnswer(box, QMessageBox::Save, "closeSave", std::move(save));
  addAnswer(box, QMessageBox::Discard, "closeDiscard", std::move(discard));
  addAnswer(box, QMessageBox::Cancel, "closeCancel", {});
  box->setDefaultButton(QMessageBox::Save);
  box->open();
}

void offerRecovery(QWidget* parent, const QString& when, std::function<void()> recover,
                   std::function<void()> throwAway) {
  QMessageBox* box =
      questionBox(parent, QObject::tr("Pneuma ended unexpectedly."),
                  QObject::tr("Work that was not saved was kept on %1. Open it?").arg(when));
  box->setObjectName(QStringLiteral("recoverQuestion"));
  addAnswer(box, QMessageBox::Open, "recoverOpen", std::move(recover));
  addAnswer(box, QMessageBox::Discard, "recoverDiscard", std::move(throwAway));
  addAnswer(box, QMessageBox::Cancel, "recoverLater", {});
  box->button(QMessageBox::Cancel)->setText(QObject::tr("Later"));
  box->setDefaultButton(QMessageBox::Open);
  box->open();
}

void askBeforeStopping(QWidget* parent, std::function<void()> stop) {
  QMessageBox* box = questionBox(parent, QObject::tr("A job is running."),
                                 QObject::tr("Stop it and close the window?"));
  addAnswer(box, QMessageBox::Yes, "stopJob", std::move(stop));
  addAnswer(box, QMessageBox::Cancel, "closeCancel", {});
  box->open();
}

void showAbout(QWidget* parent) {
  auto* box = new QMessageBox(parent);
  box->setObjectName(QStringLiteral("about"));
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setWindowTitle(QObject::tr("About Pneuma"));
  box->setIconPixmap(iconPixmap("pneuma", Qt::white, 64, parent->devicePixelRatioF()));
  box->setText(QStringLiteral("<b>Pneuma %1</b>").arg(qtText(versionText())));
  box->setInformativeText(
      QObject::tr("Grows a bronchial tree in the lobes of a lung, measures it and shows it.\n\n"
                  "Research use only. Not a medical device.\n\n"
                  "Free software under the GNU General Public License, version 3 or later."));
  box->setStandardButtons(QMessageBox::Close);
  box->open();
}

}  // namespace pneuma
