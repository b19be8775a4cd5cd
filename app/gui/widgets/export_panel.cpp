#include "widgets/export_panel.h"

#include <QButtonGroup>
#include <QCheckBox>
#include <QComboBox>
#include <QFrame>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>
#include <QVBoxLayout>
#include <QVariant>

#include "document/document.h"
#include "document/text.h"
#include "widgets/action_button.h"
#include "widgets/actions.h"
#include "widgets/heading.h"
#include "widgets/scrolled.h"

namespace pneuma {

namespace {

struct Format {
  const char* extension;
  const char* name;
  const char* keeps;
};

constexpr std::array<Format, 4> Formats = {{
    {"vtp", "VTP", QT_TR_NOOP("Everything; opens in ParaView.")},
    {"swc", "SWC", QT_TR_NOOP("Points, radii, topology and lobes.")},
    {"csv", "CSV", QT_TR_NOOP("A row per branch; centrelines become straight.")},
    {"json", "JSON", QT_TR_NOOP("Everything, as text.")},
}};

constexpr int UnderTheButton = 22;  ///< where the text of a radio button begins

QLabel* dimLabel(int indent) {
  auto* label = new QLabel;
  label->setProperty("role", "dim");
  label->setWordWrap(true);
  label->setContentsMargins(indent, 0, 0, 3);
  return label;
}

}  // namespace

ExportPanel::ExportPanel(Document& document, const Actions& actions, QWidget* parent)
    : QWidget(parent), document_(document), rows_(exportRows(document.snapshot())) {
  setObjectName(QStringLiteral("exportPanel"));
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  column->addWidget(heading(tr("Export for")));
  column->addWidget(makeKinds());
  presetFormat_ = new QComboBox;
  presetFormat_->setObjectName(QStringLiteral("presetFormat"));
  presetFormat_->setAccessibleName(tr("Format of the files"));
  presetFormat_->setToolTip(tr("Format of the files"));
  identify_ = new QCheckBox(tr("Name the case and its files"));
  identify_->setObjectName(QStringLiteral("identify"));
  identify_->setToolTip(tr("The report tells whose lungs they are; without it, hashes alone"));
  column->addSpacing(10);
  column->addWidget(heading(tr("Airway tree alone")));
  column->addWidget(makeFormats());
  keeps_ = dimLabel(0);
  keeps_->setObjectName(QStringLiteral("formatKeeps"));
  column->addWidget(keeps_);
  column->addWidget(actionButton(actions.saveTree, "saveTree"));
  column->addSpacing(10);
  column->addWidget(heading(tr("Project")));
  QLabel* everything = dimLabel(0);
  everything->setText(tr("Everything in one file, to go on with it another day."));
  column->addWidget(everything);
  column->addWidget(actionButton(actions.saveProject, "saveProject"));
  column->addStretch();
  fillScrolling(this, content);
  // In sight wherever the list is.
  layout()->addWidget(presetFormat_);
  layout()->addWidget(identify_);
  layout()->addWidget(actionButton(actions.exportCase, "exportCase", "primary"));

  connect(kinds_, &QButtonGroup::idClicked, this, [this] {
    identify_->setVisible(kind() == ExportKind::Report);
    offerFormats();
    emit kindChanged();
  });
  connect(&document_, &Document::changed, this, &ExportPanel::follow);
  connect(formats_, &QButtonGroup::idClicked, this, &ExportPanel::showKeeps);
  connect(presetFormat_, QOverload<int>::of(&QComboBox::activated), this,
          &ExportPanel::kindChanged);
  identify_->hide();
  offerFormats();
  follow();
  showKeeps();
}

QWidget* ExportPanel::makeKinds() {
  auto* list = new QWidget;
  auto* column = new QVBoxLayout(list);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  kinds_ = new QButtonGroup(this);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    auto* radio = new QRadioButton(rows_[i].title);
    radio->setObjectName(QStringLiteral("export_") + QString::fromUtf8(rows_[i].name));
    radio->setChecked(i == 0);
    kinds_->addButton(radio, static_cast<int>(i));
    notes_[i] = dimLabel(UnderTheButton);
    notes_[i]->setObjectName(QStringLiteral("exportNote_") + QString::fromUtf8(rows_[i].name));
    column->addWidget(radio);
    column->addWidget(notes_[i]);
  }
  return list;
}

void ExportPanel::offerFormats() {
  presetFormat_->clear();
  if (const auto preset = presetOf(kind())) {
    for (const std::string_view format : formatsOf(*preset)) {
      const QString name = qtText(format);
      presetFormat_->addItem(name == QLatin1String("nii.gz") ? tr("NIfTI") : name.toUpper(), name);
    }
  }
  presetFormat_->setVisible(presetFormat_->count() > 0);
}

QWidget* ExportPanel::makeFormats() {
  auto* frame = new QFrame;
  frame->setProperty("role", "segmented");
  auto* row = new QHBoxLayout(frame);
  row->setContentsMargins(2, 2, 2, 2);
  row->setSpacing(1);
  formats_ = new QButtonGroup(this);
  for (std::size_t i = 0; i < Formats.size(); ++i) {
    auto* button = new QPushButton(QString::fromUtf8(Formats[i].name));
    button->setObjectName(QStringLiteral("format_") + QString::fromUtf8(Formats[i].extension));
    button->setAccessibleDescription(tr(Formats[i].keeps));
    button->setCheckable(true);
    button->setChecked(i == 0);
    formats_->addButton(button, static_cast<int>(i));
    row->addWidget(button);
  }
  return frame;
}

void ExportPanel::follow() {
  rows_ = exportRows(document_.snapshot());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const bool there = rows_[i].lack.isEmpty();
    QAbstractButton* radio = kinds_->button(static_cast<int>(i));
    radio->setEnabled(there);
    notes_[i]->setText(there ? rows_[i].keeps : rows_[i].lack);
    radio->setAccessibleDescription(notes_[i]->text());
  }
  emit kindChanged();
}

void ExportPanel::showKeeps() {
  keeps_->setText(tr(Formats[static_cast<std::size_t>(formats_->checkedId())].keeps));
}

ExportKind ExportPanel::kind() const { return static_cast<ExportKind>(kinds_->checkedId()); }

bool ExportPanel::identify() const { return identify_->isChecked(); }

QString ExportPanel::presetFormat() const { return presetFormat_->currentData().toString(); }

QString ExportPanel::format() const {
  return QString::fromUtf8(Formats[static_cast<std::size_t>(formats_->checkedId())].extension);
}

}  // namespace pneuma
