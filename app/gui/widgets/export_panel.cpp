#include "widgets/export_panel.h"

#include <QButtonGroup>
#include <QLabel>
#include <QRadioButton>
#include <QVBoxLayout>
#include <QVariant>
#include <array>

#include "widgets/action_button.h"
#include "widgets/actions.h"
#include "widgets/heading.h"

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

}  // namespace

ExportPanel::ExportPanel(const Actions& actions, QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  column->addWidget(heading(tr("Project")));
  column->addSpacing(4);
  auto* everything = new QLabel(tr("Everything in one file, to go on with it another day."));
  everything->setProperty("role", "dim");
  everything->setWordWrap(true);
  column->addWidget(everything);
  column->addSpacing(4);
  column->addWidget(actionButton(actions.saveProject, "saveProject"));
  column->addSpacing(14);
  column->addWidget(heading(tr("Airway tree")));
  formats_ = new QButtonGroup(this);
  for (std::size_t i = 0; i < Formats.size(); ++i) {
    auto* radio = new QRadioButton(QString::fromUtf8(Formats[i].name));
    radio->setObjectName(QStringLiteral("format_") + QString::fromUtf8(Formats[i].extension));
    radio->setAccessibleDescription(tr(Formats[i].keeps));
    radio->setChecked(i == 0);
    formats_->addButton(radio, static_cast<int>(i));
    auto* keeps = new QLabel(tr(Formats[i].keeps));
    keeps->setProperty("role", "dim");
    keeps->setWordWrap(true);
    keeps->setContentsMargins(24, 0, 0, 4);
    column->addWidget(radio);
    column->addWidget(keeps);
  }
  column->addSpacing(6);
  column->addWidget(actionButton(actions.saveTree, "saveTree", "primary"));
  column->addSpacing(14);
  column->addWidget(heading(tr("Picture")));
  column->addSpacing(4);
  column->addWidget(actionButton(actions.savePicture, "savePicture"));
  column->addStretch();
}

QString ExportPanel::format() const {
  return QString::fromUtf8(Formats[static_cast<std::size_t>(formats_->checkedId())].extension);
}

}  // namespace pneuma
