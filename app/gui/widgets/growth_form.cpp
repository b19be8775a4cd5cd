#include "widgets/growth_form.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <QVariant>
#include <variant>

#include "document/document.h"
#include "document/option_layout.h"
#include "document/text.h"
#include "widgets/heading.h"
#include "widgets/options_form.h"

namespace pneuma {

namespace {

QPushButton* link(const QString& text, const char* name, const QString& tip) {
  auto* button = new QPushButton(text);
  button->setObjectName(QString::fromUtf8(name));
  button->setProperty("role", "link");
  button->setToolTip(tip);
  return button;
}

}  // namespace

GrowthForm::GrowthForm(Document& document, QWidget* parent) : QWidget(parent), document_(document) {
  column_ = new QVBoxLayout(this);
  column_->setContentsMargins(0, 0, 0, 0);
  column_->setSpacing(8);
  rebuild();
  connect(&model_, &QAbstractItemModel::dataChanged, this, &GrowthForm::takeOptions);
  connect(&document_, &Document::growthOptionsChanged, this, &GrowthForm::follow);
}

void GrowthForm::rebuild() {
  while (QLayoutItem* item = column_->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  method_ = document_.growthMethodIndex();
  std::visit([this](const auto& options) { model_.bind(options); }, document_.growthOptions());
  column_->addWidget(
      new OptionsForm(model_, optionLayout(growthMethods()[method_]).usual, source()));
  column_->addWidget(makeLinks());
  column_->addWidget(makeAdvanced());
  follow();
}

QString GrowthForm::source() const {
  return tr("Method: %1").arg(qtText(growthMethods()[method_].citation));
}

QWidget* GrowthForm::makeLinks() {
  const GrowthMethod& method = growthMethods()[method_];
  const auto paper = paperOptions(method);
  auto* links = new QWidget;
  auto* row = new QHBoxLayout(links);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(6);
  auto* advanced = link({}, "advanced", tr("Every other option of this method"));
  advanced->setCheckable(true);
  row->addWidget(advanced);
  row->addStretch();
  paper_ = nullptr;
  if (paper.has_value()) {
    paper_ = link(tr("Paper's values"), "paperValues",
                  tr("The values of the method's paper, and nothing beyond its rules"));
    connect(paper_, &QPushButton::clicked, this,
            [this, paper] { document_.setGrowthOptions(*paper); });
    row->addWidget(paper_);
  }
  defaults_ = link(tr("Defaults"), "defaults",
                   paper.has_value() ? tr("The values that serve a person's lobes best")
                                     : tr("The values of the method's paper"));
  connect(defaults_, &QPushButton::clicked, this,
          [this, &method] { document_.setGrowthOptions(method.defaults); });
  row->addWidget(defaults_);
  const auto name = [advanced](bool shown) {
    advanced->setText(shown ? tr("Less") : tr("Advanced"));
  };
  name(advancedShown_);
  advanced->setChecked(advancedShown_);
  connect(advanced, &QPushButton::toggled, this, [this, name](bool shown) {
    advancedShown_ = shown;
    name(shown);
    emit advancedToggled(shown);
  });
  return links;
}

QWidget* GrowthForm::makeAdvanced() {
  auto* advanced = new QWidget;
  advanced->setObjectName(QStringLiteral("advancedForm"));
  auto* column = new QVBoxLayout(advanced);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(8);
  for (const OptionGroup& group : optionLayout(growthMethods()[method_]).groups) {
    if (!group.title.isEmpty()) {
      column->addSpacing(4);
      column->addWidget(heading(group.title));
    }
    column->addWidget(new OptionsForm(model_, group.names, source()));
  }
  if (!advancedShown_) advanced->hide();
  connect(this, &GrowthForm::advancedToggled, advanced, &QWidget::setVisible);
  return advanced;
}

void GrowthForm::follow() {
  if (method_ != document_.growthMethodIndex()) {
    rebuild();
    return;
  }
  const GrowthOptions& options = document_.growthOptions();
  std::visit(
      [this](const auto& chosen) {
        if (!(model_.options<std::remove_cvref_t<decltype(chosen)>>() == chosen)) {
          model_.bind(chosen);
        }
      },
      options);
  const GrowthMethod& method = growthMethods()[method_];
  if (paper_ != nullptr) paper_->setEnabled(!(*paperOptions(method) == options));
  defaults_->setEnabled(!(method.defaults == options));
}

void GrowthForm::takeOptions() {
  GrowthOptions options = document_.growthOptions();
  std::visit(
      [this](auto& chosen) { chosen = model_.options<std::remove_cvref_t<decltype(chosen)>>(); },
      options);
  document_.setGrowthOptions(options);
}

}  // namespace pneuma
