#pragma once

#include <QString>
#include <QStringList>
#include <functional>

class QWidget;

/// The window's dialogs. None of them stops the rest of the window's work.
namespace pneuma {

void askForFiles(QWidget* parent, std::function<void(const QStringList&)> chosen);

/// One file. @param filters as file dialogs have them
void askForFile(QWidget* parent, const QString& title, const QStringList& filters,
                std::function<void(const QString&)> chosen);

void askForFolder(QWidget* parent, std::function<void(const QString&)> chosen);

/// The CT of a project, which moved.
/// @param folder that it was one, of slices
void askForCt(QWidget* parent, bool folder, std::function<void(const QString&)> chosen);

/// A folder that is there, or is made in the dialog, to export into.
void askForExportFolder(QWidget* parent, std::function<void(const QString&)> chosen);

/// Asks before files of a folder are replaced; "Cancel" calls nothing.
/// @param files relative to the folder
void askBeforeReplacing(QWidget* parent, const QString& folder, const QStringList& files,
                        std::function<void()> replace);

/// @param filters one, or some between ";;"
/// @param suffix without the dot, put behind a name that has none
void askWhereToSave(QWidget* parent, const QString& title, const QString& filters,
                    const QString& suffix, std::function<void(const QString&)> chosen);

/// Asks what becomes of work that is in no file; "Cancel" calls nothing.
/// @param question what is about to happen: "before the window closes"
void askBeforeLosing(QWidget* parent, const QString& question, std::function<void()> save,
                     std::function<void()> discard);

/// Offers work that was lost when the program ended on its own.
/// @param when it was kept
void offerRecovery(QWidget* parent, const QString& when, std::function<void()> recover,
                   std::function<void()> throwAway);

/// Asks whether a job that runs may be stopped to close the window.
void askBeforeStopping(QWidget* parent, std::function<void()> stop);

void showAbout(QWidget* parent);

}  // namespace pneuma
