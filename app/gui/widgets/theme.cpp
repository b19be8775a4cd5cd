#include "widgets/theme.h"

#include <QApplication>
#include <QFile>
#include <QFont>
#include <QFontInfo>
#include <QPalette>
#include <QStyleFactory>
#include <utility>
#include <vector>

namespace pneuma {

namespace {

const Theme& dark() {
  static const Theme theme{ThemeName::Dark, "#0b0d11", "#171b22", "#1e232c", "#2c3340",
                           "#12161c",       "#e6eaf1", "#93a0b4", "#4aa8ff", "#72bcff",
                           "#071018",       "#20354f", "#e6eaf1", "#2fbf8f", "#f2b544"};
  return theme;
}

const Theme& light() {
  static const Theme theme{ThemeName::Light, "#d5dae1", "#f4f6f9", "#ffffff", "#d3d9e2",
                           "#eef1f5",        "#1b2330", "#5d6878", "#1b6ec9", "#175fb0",
                           "#ffffff",        "#d8e8fb", "#ffffff", "#1d8f69", "#8a5c00"};
  return theme;
}

const Theme* inUse = nullptr;

QString styleSheet(const Theme& theme) {
  QFile file(QStringLiteral(":/style.qss"));
  file.open(QIODevice::ReadOnly);
  QString sheet = QString::fromUtf8(file.readAll());
  std::vector<std::pair<QString, QColor>> colours = {
      {QStringLiteral("@accentHover"), theme.accentHover},
      {QStringLiteral("@onAccent"), theme.onAccent},
      {QStringLiteral("@selection"), theme.selection},
      {QStringLiteral("@accent"), theme.accent},
      {QStringLiteral("@ground"), theme.ground},
      {QStringLiteral("@panel"), theme.panel},
      {QStringLiteral("@field"), theme.field},
      {QStringLiteral("@card"), theme.card},
      {QStringLiteral("@line"), theme.line},
      {QStringLiteral("@text"), theme.text},
      {QStringLiteral("@knob"), theme.knob},
      {QStringLiteral("@good"), theme.good},
      {QStringLiteral("@look"), theme.look},
      {QStringLiteral("@dim"), theme.dim},
  };
  sheet.replace(QStringLiteral("@tick"), theme.name == ThemeName::Dark
                                             ? QStringLiteral("tick-dark")
                                             : QStringLiteral("tick-light"));
  for (const auto& [name, colour] : colours) sheet.replace(name, colour.name());
  return sheet;
}

QPalette palette(const Theme& theme) {
  QPalette palette;
  palette.setColor(QPalette::Window, theme.panel);
  palette.setColor(QPalette::Base, theme.field);
  palette.setColor(QPalette::AlternateBase, theme.card);
  palette.setColor(QPalette::Button, theme.card);
  palette.setColor(QPalette::ToolTipBase, theme.card);
  palette.setColor(QPalette::Highlight, theme.accent);
  palette.setColor(QPalette::HighlightedText, theme.onAccent);
  palette.setColor(QPalette::Link, theme.accent);
  palette.setColor(QPalette::PlaceholderText, theme.dim);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText,
                          QPalette::ToolTipText, QPalette::BrightText}) {
    palette.setColor(role, theme.text);
    palette.setColor(QPalette::Disabled, role, theme.dim);
  }
  return palette;
}

}  // namespace

const Theme& currentTheme() { return inUse == nullptr ? dark() : *inUse; }

void applyTheme(QApplication& application, ThemeName name) {
  inUse = name == ThemeName::Dark ? &dark() : &light();
  application.setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
  QFont font = application.font();
  if (QFontInfo(QFont(QStringLiteral("Inter"))).family() == QLatin1String("Inter")) {
    font.setFamily(QStringLiteral("Inter"));
  }
  font.setPixelSize(13);
  application.setFont(font);
  application.setPalette(palette(*inUse));
  application.setStyleSheet(styleSheet(*inUse));
}

}  // namespace pneuma
