#pragma once

#include <QFrame>
#include <QString>
#include <vector>

class QLabel;
class QProgressBar;
class QPushButton;
class QToolButton;

namespace pneuma {

struct Actions;
class JobQueue;

/// The window's last line: what the pointer is on or what has been done, the running job with its
/// cancel button, the warnings.
class StatusStrip : public QFrame {
  Q_OBJECT

 public:
  StatusStrip(const JobQueue& jobs, const Actions& actions, QWidget* parent = nullptr);

  /// A sentence that stays until the next one.
  void say(const QString& sentence);

  /// What the pointer is on; shown instead of the sentence while it is not empty.
  void probe(const QString& text);

  void setWarnings(std::vector<QString> warnings);

 private:
  void showProgress(const QString& title, double fraction, const QString& what);
  void showJob(bool busy);
  void showWarnings();
  void updateMessage();

  QLabel* message_;
  QLabel* job_;
  QProgressBar* bar_;
  QToolButton* cancel_;
  QPushButton* warningButton_;
  QString sentence_;
  QString probe_;
  std::vector<QString> warnings_;
};

}  // namespace pneuma
