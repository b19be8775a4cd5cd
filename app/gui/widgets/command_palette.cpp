#include "widgets/command_palette.h"

#include <QLabel>
#include <QListWidget>
#include <QPainter>
#include <QStyledItemDelegate>
#include <QVBoxLayout>
#include <QVariant>
#include <algorithm>
#include <utility>

#include "document/command_search.h"
#include "widgets/theme.h"

namespace pneuma {

namespace {

constexpr int CommandRowHeight = 34;
constexpr int MostRows = 11;
constexpr int PaletteWidth = 720;
constexpr int SideGap = 12;
constexpr int ColumnGap = 14;
constexpr int TickWidth = 20;

enum CommandRole {
  GroupRole = Qt::UserRole + 1,
  KeysRole,
  ObstacleRole,
  UsableRole,
  OnRole,
  HitsRole
};

class CommandPainter : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  QSize sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const override {
    return {200, CommandRowHeight};
  }

  void paint(QPainter* painter, const QStyleOptionViewItem& option,
             const QModelIndex& index) const override {
    const Theme& theme = currentTheme();
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    if (option.state.testFlag(QStyle::State_Selected)) {
      painter->setPen(Qt::NoPen);
      painter->setBrush(theme.selection);
      painter->drawRoundedRect(option.rect, 6, 6);
    }
    QRect row = option.rect.adjusted(SideGap, 0, -SideGap, 0);
    const bool usable = index.data(UsableRole).toBool();
    if (index.data(OnRole).toBool()) {
      painter->setPen(QPen(theme.accent, 2.0, Qt::SolidLine, Qt::RoundCap));
      const QPoint tick(row.left() + 1, row.center().y() + 1);
      painter->drawLine(tick, tick + QPoint(4, 4));
      painter->drawLine(tick + QPoint(4, 4), tick + QPoint(11, -5));
    }
    row.setLeft(row.left() + TickWidth);
    row.setRight(drawKeys(*painter, option, row, index.data(KeysRole).toString()));
    painter->setPen(theme.dim);
    const QString group = index.data(GroupRole).toString();
    painter->drawText(row, Qt::AlignRight | Qt::AlignVCenter, group);
    row.setRight(row.right() - option.fontMetrics.horizontalAdvance(group) - ColumnGap);
    row.setLeft(drawTitle(*painter, option, row, index, usable ? theme.text : theme.dim) +
                ColumnGap);
    const QString obstacle = index.data(ObstacleRole).toString();
    if (!obstacle.isEmpty() && row.width() > 40) {
      painter->setFont(option.font);
      painter->setPen(theme.look);
      painter->drawText(row, Qt::AlignLeft | Qt::AlignVCenter,
                        option.fontMetrics.elidedText(obstacle, Qt::ElideRight, row.width()));
    }
    painter->restore();
  }

 private:
  /// @return where they begin, or the row's end
  static int drawKeys(QPainter& painter, const QStyleOptionViewItem& option, const QRect& row,
                      const QString& keys) {
    int right = row.right();
    const QStringList chips = keys.split(QStringLiteral("  "), Qt::SkipEmptyParts);
    for (auto chip = chips.rbegin(); chip != chips.rend(); ++chip) {
      const int width = option.fontMetrics.horizontalAdvance(*chip) + 12;
      const QRect box(right - width, row.center().y() - 10, width, 21);
      painter.setPen(currentTheme().line);
      painter.setBrush(currentTheme().field);
      painter.drawRoundedRect(box, 5, 5);
      painter.setPen(currentTheme().dim);
      painter.drawText(box, Qt::AlignCenter, *chip);
      right -= width + 5;
    }
    return chips.isEmpty() ? right : right - ColumnGap + 5;
  }

  /// The title with the letters that were found. @return where it ends
  static int drawTitle(QPainter& painter, const QStyleOptionViewItem& option, const QRect& row,
                       const QModelIndex& index, const QColor& colour) {
    const QString title = index.data().toString();
    const QVariantList hits = index.data(HitsRole).toList();
    QFont bold = option.font;
    bold.setBold(true);
    int left = row.left();
    for (int from = 0; from < title.size();) {
      const bool hit = hits.contains(from);
      int to = from + 1;
      while (to < title.size() && hits.contains(to) == hit) ++to;
      const QString part = title.mid(from, to - from);
      painter.setFont(hit ? bold : option.font);
      painter.setPen(hit ? currentTheme().accent : colour);
      painter.drawText(QRect(left, row.top(), std::max(0, row.right() - left), row.height()),
                       Qt::AlignLeft | Qt::AlignVCenter, part);
      left += painter.fontMetrics().horizontalAdvance(part);
      from = to;
    }
    return left;
  }
};

}  // namespace

CommandPalette::CommandPalette(QWidget* window)
    : Overlay(window, QStringLiteral("palette"), tr("Find a command, a step or a structure")) {
  list_ = new QListWidget;
  list_->setObjectName(QStringLiteral("paletteList"));
  list_->setAccessibleName(tr("Commands"));
  list_->setItemDelegate(new CommandPainter(list_));
  list_->setFocusPolicy(Qt::NoFocus);
  list_->setUniformItemSizes(true);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  nothing_ = new QLabel(tr("No command is called so; fewer letters find more."));
  nothing_->setObjectName(QStringLiteral("paletteNothing"));
  nothing_->setProperty("role", "dim");
  nothing_->setAlignment(Qt::AlignCenter);
  auto* hint = new QLabel(tr("Up and Down choose, Return runs, Esc closes"));
  hint->setProperty("role", "dim");
  column().addWidget(list_, 1);
  column().addWidget(nothing_, 1);
  column().addWidget(hint);
  connect(list_, &QListWidget::itemClicked, this, &CommandPalette::run);
}

void CommandPalette::offer(std::vector<Command> commands) {
  commands_ = std::move(commands);
  open();
}

void CommandPalette::search(const QString& typed) {
  std::vector<QString> texts;
  for (const Command& command : commands_) {
    texts.push_back(command.title + QLatin1Char(' ') + command.group);
  }
  shown_ = bestCommands(typed, texts);
  list_->clear();
  for (const std::size_t index : shown_) {
    const Command& command = commands_[index];
    auto* item = new QListWidgetItem(command.title, list_);
    item->setData(GroupRole, command.group);
    item->setData(KeysRole, command.keys);
    item->setData(ObstacleRole, command.enabled ? QString() : command.obstacle);
    item->setData(UsableRole, command.enabled);
    item->setData(OnRole, command.on);
    QVariantList hits;
    const auto match = matchCommand(typed, texts[index]);
    for (const int place : match ? match->hits : std::vector<int>()) hits << place;
    item->setData(HitsRole, hits);
    item->setData(Qt::AccessibleTextRole,
                  QStringList{command.title, command.group, command.keys,
                              command.enabled ? QString() : tr("not now"), command.obstacle}
                      .join(QStringLiteral(", ")));
  }
  list_->setCurrentRow(0);
  list_->setVisible(!shown_.empty());
  nothing_->setVisible(shown_.empty());
}

bool CommandPalette::keyPressed(int key) {
  switch (key) {
    case Qt::Key_Down:
    case Qt::Key_Tab:
      move(1);
      return true;
    case Qt::Key_Up:
    case Qt::Key_Backtab:
      move(-1);
      return true;
    case Qt::Key_PageDown:
      move(MostRows - 1);
      return true;
    case Qt::Key_PageUp:
      move(1 - MostRows);
      return true;
    case Qt::Key_Return:
    case Qt::Key_Enter:
      run();
      return true;
    default:
      return false;
  }
}

void CommandPalette::move(int rows) {
  list_->setCurrentRow(std::clamp(list_->currentRow() + rows, 0, std::max(0, list_->count() - 1)));
}

void CommandPalette::run() {
  const int row = list_->currentRow();
  if (row < 0 || row >= static_cast<int>(shown_.size())) return;
  const Command& command = commands_[shown_[static_cast<std::size_t>(row)]];
  if (!command.enabled) return;  // it says why
  const auto run = command.run;
  close();
  run();
}

QRect CommandPalette::place(const QSize& window) const {
  const int width = std::min(PaletteWidth, window.width() - 80);
  const int height = std::min(MostRows * CommandRowHeight + 100, window.height() - 120);
  return {(window.width() - width) / 2, std::min(96, window.height() / 10), width, height};
}

}  // namespace pneuma
