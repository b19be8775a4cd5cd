#pragma once

#include <QString>
#include <QStringList>
#include <string>
#include <string_view>

#include "document/export_list.h"
#include "pipeline/lobe_shares.h"
#include "render/camera.h"

namespace pneuma {

class Document;

/// A step of the window.
enum class WorkStep { Open, Lungs, Lobes, Airways, Breathing, Export };

/// What the step "Export" is asked for.
struct ExportWish {
  ExportKind kind = ExportKind::Paraview;
  bool identify = false;  ///< the report
  ViewDirection view{};   ///< of the figure and the film
  std::string format{};   ///< of a preset; empty: the usual one
};

/// What a person types to have the same from the command line.
struct ShellCommand {
  QStringList lines;  ///< for a POSIX shell, one after the other; a line with # is a remark
  QString obstacle;   ///< why there is none, and what to do; empty if there is one

  QString text() const { return lines.join(QLatin1Char('\n')); }
};

/// One word of a POSIX shell that stands for a text.
QString shellWord(std::string_view text);

/// The commands that do what a step does with the options that are set now: those that differ from
/// the defaults, and the steps before that it builds on. Files are named as they were opened, what
/// comes of them by usual names in the folder where the commands are run. A saved project is what
/// they read; one that was changed since has to be saved first.
ShellCommand shellCommand(WorkStep step, const Document& document, const ExportWish& wish = {});

/// The commands that grow trees by all methods with the options they were grown with, and compare
/// them.
ShellCommand compareCommand(const Document& document);

}  // namespace pneuma
