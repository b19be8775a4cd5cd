#include "widgets/options_form.h"

#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QVariant>
#include <algorithm>
#include <cmath>
#include <utility>

#include "document/options_model.h"
#include "document/text.h"
#include "widgets/number_box.h"

namespace pneuma {

namespace {

constexpr int EditorWidth = 84;

/// "min-points" -> "Min points"
QString labelOf(const OptionsModel::Row& row) {
  QString label = capitalised(row.name);
  return label.replace(QLatin1Char('-'), QLatin1Char(' '));
}

QModelIndex valueIndex(const OptionsModel& model, int row) {
  return model.index(row, OptionsModel::ValueColumn);
}

bool isSwitch(const OptionsModel::Row& row) {
  return row.choices == std::vector<std::string>{"off", "on"};
}

/// Enough for two digits of the smallest number allowed.
int decimalsOf(const OptionsModel::Row& row) {
  if (row.whole) return 0;
  if (row.range.low <= 0.0) return 4;
  return std::max(4, static_cast<int>(std::ceil(-std::log10(row.range.low))) + 1);
}

}  // namespace

OptionsForm::OptionsForm(OptionsModel& model, std::vector<std::string> names, const QString& source,
                         int labelWidth, QWidget* parent)
    : QWidget(parent), model_(model), names_(std::move(names)), source_(source) {
  grid_ = new QGridLayout(this);
  grid_->setContentsMargins(0, 0, 0, 0);
  grid_->setHorizontalSpacing(6);
  grid_->setVerticalSpacing(5);
  grid_->setColumnStretch(1, 1);
  grid_->setColumnMinimumWidth(0, labelWidth);
  for (const std::string& name : names_) {
    const auto row = model_.rowOf(name);
    if (!row.has_value()) continue;
    if (isSwitch(model_.row(*row))) {
      addSwitch(*row);
    } else {
      addRow(*row);
    }
  }
  connect(&model_, &QAbstractItemModel::modelReset, this, &OptionsForm::refresh);
  connect(&model_, &QAbstractItemModel::dataChanged, this, &OptionsForm::refresh);
  refresh();
}

void OptionsForm::describe(QWidget& editor, int row) const {
  const OptionsModel::Row& option = model_.row(row);
  editor.setObjectName(QStringLiteral("option_") + qtText(option.name));
  editor.setAccessibleName(labelOf(option));
  editor.setAccessibleDescription(qtText(option.help));
  QString tip = qtText(option.help);
  if (!isSwitch(option)) {
    tip += QLatin1Char('\n') +
           model_.data(model_.index(row, OptionsModel::RangeColumn), Qt::DisplayRole).toString();
    if (!option.unit.empty()) tip += QLatin1Char(' ') + qtText(option.unit);
  }
  tip += QLatin1Char('\n') + tr("Default: %1").arg(qtText(option.standard));
  if (!option.unit.empty()) tip += QLatin1Char(' ') + qtText(option.unit);
  if (!source_.isEmpty()) tip += QLatin1Char('\n') + source_;
  editor.setToolTip(tip);
}

void OptionsForm::addRow(int row) {
  const OptionsModel::Row& option = model_.row(row);
  QWidget* editor = option.choices.empty() ? numberEditor(row) : choiceEditor(row);
  describe(*editor, row);
  editor->setMinimumWidth(EditorWidth);
  auto* label = new QLabel(labelOf(option));
  label->setProperty("role", "dim");
  label->setWordWrap(true);
  label->setMaximumWidth(FormLabelWidth);
  label->setToolTip(editor->toolTip());
  label->setBuddy(editor);
  const int line = grid_->rowCount();
  grid_->addWidget(label, line, 0);
  grid_->addWidget(editor, line, 1);
  besideSwitch_ = false;
}

void OptionsForm::addSwitch(int row) {
  auto* box = new QCheckBox(labelOf(model_.row(row)));
  describe(*box, row);
  connect(box, &QCheckBox::toggled, this, [this, row](bool on) {
    model_.setData(valueIndex(model_, row), on ? QStringLiteral("on") : QStringLiteral("off"),
                   Qt::EditRole);
  });
  grid_->addWidget(box, besideSwitch_ ? grid_->rowCount() - 1 : grid_->rowCount(),
                   besideSwitch_ ? 1 : 0);
  besideSwitch_ = !besideSwitch_;
}

QWidget* OptionsForm::numberEditor(int row) {
  const OptionsModel::Row& option = model_.row(row);
  auto* box = new NumberBox;
  box->setDecimals(decimalsOf(option));
  box->setRange(option.range.low, option.range.high);
  if (!option.unit.empty()) box->setSuffix(QStringLiteral(" ") + qtText(option.unit));
  if (option.range.low > 0.0 && option.range.high / option.range.low > 1e4) {
    box->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  }
  const double span = option.range.high - option.range.low;
  box->setSingleStep(option.whole  ? (span > 1e5 ? 1000.0 : 1.0)
                     : span <= 2.0 ? 0.01
                     : span < 60.0 ? 0.1
                                   : 1.0);
  connect(box, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
          [this, row](double value) {
            model_.setData(valueIndex(model_, row), QString::number(value, 'g', 17), Qt::EditRole);
          });
  return box;
}

QWidget* OptionsForm::choiceEditor(int row) {
  auto* box = new QComboBox;
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);  // not the longest
  for (const auto& choice : model_.row(row).choices) box->addItem(qtText(choice));
  connect(box, &QComboBox::currentTextChanged, this, [this, row](const QString& text) {
    model_.setData(valueIndex(model_, row), text, Qt::EditRole);
  });
  return box;
}

void OptionsForm::refresh() {
  for (const std::string& name : names_) {
    const auto row = model_.rowOf(name);
    auto* editor = findChild<QWidget*>(QStringLiteral("option_") + qtText(name));
    if (!row.has_value() || editor == nullptr) continue;
    const OptionsModel::Row& option = model_.row(*row);
    const QSignalBlocker quiet(editor);
    if (auto* number = qobject_cast<QDoubleSpinBox*>(editor)) {
      number->setValue(qtText(option.value).toDouble());
    } else if (auto* choice = qobject_cast<QComboBox*>(editor)) {
      choice->setCurrentText(qtText(option.value));
    } else if (auto* box = qobject_cast<QCheckBox*>(editor)) {
      box->setChecked(option.value == "on");
    }
  }
}

}  // namespace pneuma
