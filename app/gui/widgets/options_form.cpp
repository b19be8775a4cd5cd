#include "widgets/options_form.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QLocale>
#include <QVariant>
#include <utility>

#include "document/options_model.h"
#include "document/text.h"

namespace pneuma {

namespace {

/// So that several forms below each other line up.
constexpr int LabelWidth = 106;

/// Shows as many decimals as the value has, and whole numbers in groups.
class NumberBox : public QDoubleSpinBox {
 public:
  NumberBox() {
    setLocale(QLocale(QLocale::English, QLocale::UnitedStates));
    setGroupSeparatorShown(true);
    setKeyboardTracking(false);
    setAlignment(Qt::AlignRight);
  }

  QString textFromValue(double value) const override {
    QString text = QDoubleSpinBox::textFromValue(value);
    if (!text.contains(QLatin1Char('.'))) return text;
    while (text.endsWith(QLatin1Char('0'))) text.chop(1);
    if (text.endsWith(QLatin1Char('.'))) text.chop(1);
    return text;
  }
};

/// "min-points" -> "Min points"
QString labelOf(const OptionsModel::Row& row) {
  QString label = capitalised(row.name);
  return label.replace(QLatin1Char('-'), QLatin1Char(' '));
}

QModelIndex valueIndex(const OptionsModel& model, int row) {
  return model.index(row, OptionsModel::ValueColumn);
}

}  // namespace

OptionsForm::OptionsForm(OptionsModel& model, std::set<std::string> names, bool except,
                         QWidget* parent)
    : QWidget(parent), model_(model), names_(std::move(names)), except_(except) {
  grid_ = new QGridLayout(this);
  grid_->setContentsMargins(0, 0, 0, 0);
  grid_->setHorizontalSpacing(6);
  grid_->setVerticalSpacing(6);
  grid_->setColumnStretch(1, 1);
  grid_->setColumnMinimumWidth(0, LabelWidth);
  connect(&model_, &QAbstractItemModel::modelReset, this, &OptionsForm::rebuild);
  connect(&model_, &QAbstractItemModel::dataChanged, this, &OptionsForm::refresh);
  rebuild();
}

void OptionsForm::rebuild() {
  while (QLayoutItem* item = grid_->takeAt(0)) {
    if (item->widget() != nullptr) item->widget()->deleteLater();
    delete item;
  }
  for (int row = 0; row < model_.rowCount(); ++row) {
    if (names_.contains(model_.row(row).name) != except_) addRow(row);
  }
  refresh();
}

void OptionsForm::addRow(int row) {
  const OptionsModel::Row& option = model_.row(row);
  auto* label = new QLabel(labelOf(option));
  label->setProperty("role", "dim");
  QWidget* editor = option.choices.empty() ? numberEditor(row) : choiceEditor(row);
  editor->setObjectName(QStringLiteral("option_") + qtText(option.name));
  editor->setAccessibleName(labelOf(option));
  editor->setAccessibleDescription(qtText(option.help));
  editor->setMinimumWidth(88);
  const QString range =
      model_.data(model_.index(row, OptionsModel::RangeColumn), Qt::DisplayRole).toString();
  const QString tip =
      QStringLiteral("%1\n%2%3")
          .arg(qtText(option.help), range,
               option.unit.empty() ? QString() : QStringLiteral(" ") + qtText(option.unit));
  label->setToolTip(tip);
  editor->setToolTip(tip);
  label->setBuddy(editor);
  const int line = grid_->rowCount();
  grid_->addWidget(label, line, 0);
  grid_->addWidget(editor, line, 1);
}

QWidget* OptionsForm::numberEditor(int row) {
  const OptionsModel::Row& option = model_.row(row);
  auto* box = new NumberBox;
  box->setDecimals(option.whole ? 0 : 4);
  box->setRange(option.range.low, option.range.high);
  if (!option.unit.empty()) box->setSuffix(QStringLiteral(" ") + qtText(option.unit));
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
  for (const auto& choice : model_.row(row).choices) box->addItem(qtText(choice));
  connect(box, &QComboBox::currentTextChanged, this, [this, row](const QString& text) {
    model_.setData(valueIndex(model_, row), text, Qt::EditRole);
  });
  return box;
}

void OptionsForm::refresh() {
  for (int row = 0; row < model_.rowCount(); ++row) {
    const OptionsModel::Row& option = model_.row(row);
    const QString name = QStringLiteral("option_") + qtText(option.name);
    if (auto* number = findChild<QDoubleSpinBox*>(name)) {
      const QSignalBlocker quiet(number);
      number->setValue(QString::fromStdString(option.value).toDouble());
    } else if (auto* choice = findChild<QComboBox*>(name)) {
      const QSignalBlocker quiet(choice);
      choice->setCurrentText(qtText(option.value));
    }
  }
}

}  // namespace pneuma
