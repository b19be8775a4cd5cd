#pragma once

#include <vector>

#include "widgets/overlay.h"
#include "widgets/view_keys.h"

class QHBoxLayout;
class QScrollArea;

namespace pneuma {

/// All keys in groups; what is typed narrows them, by what they do or by the key.
class KeysOverlay : public Overlay {
  Q_OBJECT
  Q_PROPERTY(QString text READ text)

 public:
  explicit KeysOverlay(QWidget* window);

  /// Opens with these, in their order.
  void list(std::vector<KeyRow> rows);

  /// What is shown, as lines of "group: what: keys", for screen readers and scripts.
  QString text() const { return text_; }

 protected:
  void search(const QString& typed) override;
  bool keyPressed(int key) override;
  QRect place(const QSize& window) const override;

 private:
  std::vector<KeyRow> rows_;
  QScrollArea* scroll_;
  QLabel* nothing_;
  QString text_;
};

}  // namespace pneuma
