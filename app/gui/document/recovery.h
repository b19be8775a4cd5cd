#pragma once

#include <QLockFile>
#include <QObject>
#include <QString>
#include <QTimer>
#include <atomic>
#include <filesystem>
#include <future>
#include <memory>
#include <vector>

#include "document/document.h"

namespace pneuma {

/// Work that was lost when the program ended without being asked to.
struct LostWork {
  std::filesystem::path file;  ///< a project
  QString when;                ///< it was kept last, as people read it
};

/// Keeps work that is not saved in a file of its own, away from the user's files, a moment after
/// every step and on a thread of its own, so that nothing waits for it; with it the last steps to
/// undo, as many as hold 64 MB. Once it is saved, or given
/// up on purpose, that file goes away.
class Recovery : public QObject {
  Q_OBJECT

 public:
  /// @param folder is made if needed, so that only this user may enter it; where that fails nothing
  /// is kept
  Recovery(Document& document, const std::filesystem::path& folder, QObject* parent = nullptr);

  /// Removes what was kept: the user was asked whether to save it.
  ~Recovery() override;

  /// $XDG_STATE_HOME/pneuma/recovery, or where that usually is. Empty if there is none.
  static std::filesystem::path usualFolder();

  /// What programs that do not run any more left in the folder, the latest first.
  static std::vector<LostWork> lostWork(const std::filesystem::path& folder);

  static void throwAway(const LostWork& lost);

  /// Opens lost work. Its file goes away as soon as this program has kept it.
  void recover(const LostWork& lost);

 private:
  void keep();
  void startWriting();
  bool writing();

  Document& document_;
  std::filesystem::path file_;  ///< empty where nothing can be kept
  std::unique_ptr<QLockFile> lock_;
  QTimer timer_;
  std::uint64_t kept_ = 0;                  ///< revision that is in the file
  std::filesystem::path takenOver_;         ///< lost work that was opened
  std::shared_ptr<const CtSource> plain_;   ///< of a CT, and the same
  std::shared_ptr<const CtSource> hashed_;  ///< with its hash, which takes a while to find
  std::atomic<bool> stop_ = false;
  std::future<std::shared_ptr<const CtSource>> writing_;
};

}  // namespace pneuma
