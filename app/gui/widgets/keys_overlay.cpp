#include "widgets/keys_overlay.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QScrollArea>
#include <QScrollBar>
#include <QVBoxLayout>
#include <QVariant>
#include <algorithm>
#include <array>
#include <utility>

#include "document/command_search.h"
#include "widgets/heading.h"

namespace pneuma {

namespace {

constexpr int KeysWidth = 1080;
constexpr int KeysHeight = 860;
constexpr std::size_t KeyColumns = 2;

using KeyGroup = std::pair<QString, std::vector<const KeyRow*>>;

QWidget* keyChips(const QStringList& keys) {
  auto* chips = new QWidget;
  auto* line = new QHBoxLayout(chips);
  line->setContentsMargins(0, 0, 0, 0);
  line->setSpacing(4);
  line->addStretch();
  for (const QString& key : keys) {
    auto* chip = new QLabel(key);
    chip->setTextFormat(Qt::PlainText);
    chip->setProperty("role", "key");
    line->addWidget(chip);
  }
  return chips;
}

QWidget* keyTable(const KeyGroup& group) {
  auto* table = new QWidget;
  auto* grid = new QGridLayout(table);
  grid->setContentsMargins(0, 0, 0, 12);
  grid->setHorizontalSpacing(12);
  grid->setVerticalSpacing(3);
  grid->setColumnStretch(0, 1);
  grid->addWidget(heading(group.first), 0, 0, 1, 2);
  int line = 1;
  for (const KeyRow* row : group.second) {
    auto* what = new QLabel(row->what);
    what->setTextFormat(Qt::PlainText);
    what->setWordWrap(true);
    QWidget* chips = keyChips(row->keys);
    chips->setAccessibleName(row->keys.join(QStringLiteral(", ")));
    grid->addWidget(what, line, 0);
    grid->addWidget(chips, line++, 1, Qt::AlignRight | Qt::AlignVCenter);
  }
  return table;
}

}  // namespace

KeysOverlay::KeysOverlay(QWidget* window)
    : Overlay(window, QStringLiteral("keys"), tr("Find a key by what it does")) {
  setObjectName(QStringLiteral("keysOverlay"));
  scroll_ = new QScrollArea;
  scroll_->setWidgetResizable(true);
  scroll_->setFrameShape(QFrame::NoFrame);
  scroll_->setFocusPolicy(Qt::NoFocus);
  scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  nothing_ = new QLabel(tr("No key does that; Ctrl+K finds what has no key."));
  nothing_->setObjectName(QStringLiteral("keysNothing"));
  nothing_->setProperty("role", "dim");
  nothing_->setAlignment(Qt::AlignCenter);
  auto* hint = new QLabel(tr("Single letters act while a view has the focus. Esc closes."));
  hint->setProperty("role", "dim");
  column().addWidget(scroll_, 1);
  column().addWidget(nothing_, 1);
  column().addWidget(hint);
}

void KeysOverlay::list(std::vector<KeyRow> rows) {
  rows_ = std::move(rows);
  open();
}

void KeysOverlay::search(const QString& typed) {
  std::vector<KeyGroup> groups;
  text_.clear();
  for (const KeyRow& row : rows_) {
    const QString keys = row.keys.join(QStringLiteral(", "));
    const bool asked = matchCommand(typed, row.what + QLatin1Char(' ') + row.group) ||
                       row.keys.contains(typed.trimmed(), Qt::CaseInsensitive);
    if (!asked) continue;
    const auto known = std::find_if(groups.begin(), groups.end(), [&](const KeyGroup& group) {
      return group.first == row.group;
    });
    (known == groups.end() ? groups.emplace_back(row.group, std::vector<const KeyRow*>()) : *known)
        .second.push_back(&row);
    text_ += row.group + QStringLiteral(": ") + row.what + QStringLiteral(": ") + keys +
             QLatin1Char('\n');
  }
  auto* content = new QWidget;
  auto* line = new QHBoxLayout(content);
  line->setContentsMargins(4, 4, 10, 4);
  line->setSpacing(36);
  std::size_t total = 0;
  for (const KeyGroup& group : groups) total += group.second.size() + 2;
  std::array<QVBoxLayout*, KeyColumns> columns{};
  for (QVBoxLayout*& column : columns) {
    column = new QVBoxLayout;
    column->setSpacing(0);
    line->addLayout(column, 1);
  }
  std::size_t before = 0;
  for (const KeyGroup& group : groups) {
    // The first half goes to the left.
    const std::size_t size = group.second.size() + 2;
    const std::size_t column = 2 * before + size > total && before > 0 ? 1 : 0;
    columns[column]->addWidget(keyTable(group));
    before += size;
  }
  for (QVBoxLayout* column : columns) column->addStretch();
  scroll_->setWidget(content);
  scroll_->setVisible(!groups.empty());
  nothing_->setVisible(groups.empty());
  setAccessibleDescription(text_);
}

bool KeysOverlay::keyPressed(int key) {
  QScrollBar* bar = scroll_->verticalScrollBar();
  switch (key) {
    case Qt::Key_Down:
      bar->setValue(bar->value() + 40);
      return true;
    case Qt::Key_Up:
      bar->setValue(bar->value() - 40);
      return true;
    case Qt::Key_PageDown:
      bar->setValue(bar->value() + bar->pageStep());
      return true;
    case Qt::Key_PageUp:
      bar->setValue(bar->value() - bar->pageStep());
      return true;
    case Qt::Key_Question:
      if (!field().text().isEmpty()) return false;
      close();
      return true;
    case Qt::Key_Tab:
    case Qt::Key_Backtab:
      return true;  // there is nowhere to go
    default:
      return false;
  }
}

QRect KeysOverlay::place(const QSize& window) const {
  const int width = std::min(KeysWidth, window.width() - 80);
  const int height = std::min(KeysHeight, window.height() - 100);
  return {(window.width() - width) / 2, (window.height() - height) / 2, width, height};
}

}  // namespace pneuma
