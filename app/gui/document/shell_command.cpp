#include "document/shell_command.h"

#include <QObject>
#include <algorithm>
#include <cctype>
#include <string>

#include "document/document.h"
#include "document/text.h"
#include "pipeline/compare_methods.h"
#include "pipeline/fissure_snapping.h"
#include "pipeline/lobe_shares.h"
#include "views/case_export.h"

namespace pneuma {

namespace {

namespace fs = std::filesystem;

// What one command writes and the next one reads.
constexpr const char* SampleFolder = "chest";
constexpr const char* LungsFolder = "lungs";
constexpr const char* LobesFolder = "lobes";
constexpr const char* LabelsName = "labels.nii.gz";
constexpr const char* CentralName = "central.vtp";
constexpr const char* TreeName = "tree.vtp";
constexpr const char* FissuresName = "fissures.json";
constexpr const char* LungEditsName = "lung-edits.json";

QString saveFirst() {
  return QObject::tr("Save the project first (Ctrl+S): the command reads its file.");
}

/// A command as its words are put together.
class Line {
 public:
  explicit Line(const char* command) {
    words_ << QStringLiteral("pneuma") << QString::fromUtf8(command);
  }

  Line& add(std::string_view word) {
    words_ << shellWord(word);
    return *this;
  }

  /// A file's name, which is no option even if it looks like one.
  Line& file(const std::string& name) {
    return add(!name.empty() && name.front() == '-' ? "./" + name : name);
  }

  Line& files(const std::vector<std::string>& names) {
    for (const std::string& name : names) file(name);
    return *this;
  }

  Line& option(std::string_view name, const std::string& value) {
    const std::string flag = "--" + std::string(name);
    if (!value.empty() && value.front() == '-') return add(flag + "=" + value);
    return add(flag).add(value);
  }

  /// Those options that differ from the defaults.
  template <HasFields Options>
  Line& options(const Options& chosen, const Options& defaults = {}) {
    forEachField<Options>([&](const auto& field) {
      using Value = typename std::remove_cvref_t<decltype(field)>::value_type;
      if (chosen.*(field.member) == defaults.*(field.member)) return;
      if constexpr (std::is_same_v<Value, bool>) {
        add("--" + std::string(field.name));
      } else {
        option(field.name, textOf(chosen.*(field.member)));
      }
    });
    return *this;
  }

  QString output(std::string_view name) {
    add("-o").add(name);
    return words_.join(QLatin1Char(' '));
  }

  QString text() const { return words_.join(QLatin1Char(' ')); }

 private:
  QStringList words_;
};

/// What commands read, and those that have to be run before.
struct Source {
  QStringList lines;
  std::vector<std::string> surfaces;  ///< files, folders, or a project
  std::string organ;
  std::string central;
  std::string tree;  ///< one that was opened to be looked at
  bool project = false;
  QString obstacle;

  bool nothing() const { return surfaces.empty() && organ.empty(); }
};

bool endsAs(const fs::path& path, const std::vector<std::string>& ends) {
  return std::ranges::find(ends, path.extension().string()) != ends.end();
}

/// The files that surfaces were read from; empty unless all of them are known.
std::vector<std::string> filesOf(const std::vector<LobeSurface>& surfaces,
                                 const std::vector<InputFile>& inputs) {
  std::vector<std::string> files;
  for (const LobeSurface& surface : surfaces) {
    const auto input = std::ranges::find_if(inputs, [&](const InputFile& one) {
      return fs::path(one.path).filename().string() == surface.name;
    });
    if (input == inputs.end()) return {};
    if (std::ranges::find(files, input->path) == files.end()) files.push_back(input->path);
  }
  return files;
}

/// Which series of the CT, and how it is put right.
void addReading(Line& line, const CtSource& ct) {
  if (!ct.series.empty()) line.option("series", ct.series);
  line.options(ct.corrections);
}

/// Finds the lungs of a CT, corrected by hand where they are.
QStringList segmentLines(const CtSource& ct, const LungOptions& options, bool corrected) {
  QStringList lines;
  Line line("segment");
  line.file(ct.path.string());
  addReading(line, ct);
  line.options(options);
  if (corrected) {
    lines << QObject::tr("# %1 holds the corrections by hand: File, Save lung corrections")
                 .arg(QString::fromUtf8(LungEditsName));
    line.option("edits", LungEditsName);
  }
  line.option("surfaces", LungsFolder).option("central", CentralName);
  return lines << line.output(LabelsName);
}

/// Splits the lungs of a source by edits, and makes the lobes the source.
void addLobes(Source& source, const LungModel& model, const LobeEdits& edits) {
  Line line("lobes");
  line.files(source.surfaces);
  if (!inputsOf(edits).given.empty()) {
    source.lines << QObject::tr("# %1 holds the fissures that were set: File, Save fissures")
                        .arg(QString::fromUtf8(FissuresName));
    line.option("fissures", FissuresName);
  }
  if (const std::string shares = textOfLobeShares(edits.shares); !shares.empty()) {
    line.option("fractions", shares);
  }
  if (model.ct && model.ctSource && model.lungs) {
    line.option("ct", model.ctSource->path.string());
    addReading(line, *model.ctSource);
    line.option("labels", LabelsName);
    if (edits.snap) line.add("--snap");
  }
  source.lines << line.options(edits.options).output(LobesFolder);
  source.surfaces = {LobesFolder};
}

/// The surfaces before they were split.
void findSurfaces(Source& source, const Document& document) {
  const LungModel& model = document.model();
  const auto& surfaces = model.wholeLungs ? model.wholeLungs : model.surfaces;
  if (!surfaces) {
    source.organ = model.organ;
    return;
  }
  source.surfaces = filesOf(*surfaces, model.inputs);
  if (!source.surfaces.empty()) return;
  if (model.lungs && model.ctSource) {
    source.lines << segmentLines(*model.ctSource, document.snapshot().lungOptions,
                                 model.corrections != nullptr);
    source.surfaces = {LungsFolder};
    if (model.central) source.central = CentralName;
  } else if (model.inputs.empty() && !model.ctSource) {
    source.lines << Line("sample").add(SampleFolder).option("format", "vtp").text();
    source.surfaces = {SampleFolder};
    source.central = std::string(SampleFolder) + "/" + CentralName;
  } else {
    source.obstacle = saveFirst();
  }
}

/// The trees among the files that were opened.
void findTrees(Source& source, const LungModel& model) {
  for (const InputFile& input : model.inputs) {
    const bool isSurface = std::ranges::find(source.surfaces, input.path) != source.surfaces.end();
    if (isSurface || !endsAs(input.path, {".vtp", ".vtu", ".swc", ".csv", ".json"})) continue;
    (model.opened ? source.tree : source.central) = input.path;
  }
}

Source sourceOf(const Document& document) {
  Source source;
  if (!document.projectPath().empty()) {
    source.project = true;
    source.surfaces = {document.projectPath().string()};
    if (document.modified()) source.obstacle = saveFirst();
    return source;
  }
  findSurfaces(source, document);
  findTrees(source, document.model());
  if (document.model().lobes && source.obstacle.isEmpty()) {
    addLobes(source, document.model(), document.snapshot().splitEdits);
  }
  return source;
}

ShellCommand refused(const QString& sentence) { return {{}, sentence}; }

QString growLine(const Source& source, const GrowthOptions& options,
                 const std::string& output = TreeName) {
  Line line("grow");
  line.files(source.surfaces);
  if (!source.organ.empty()) line.option("organ", source.organ);
  if (!source.central.empty()) line.option("central", source.central);
  const GrowthMethod& method = growthMethods()[options.index()];
  if (options.index() != 0) line.option("method", std::string(method.name));
  std::visit(
      [&](const auto& chosen) {
        using Options = std::remove_cvref_t<decltype(chosen)>;
        const auto& defaults = std::get<Options>(method.defaults);
        forEachField<Options>([&](const auto& field) {
          if (chosen.*(field.member) == defaults.*(field.member)) return;
          line.option("set", std::string(field.name) + "=" + textOf(chosen.*(field.member)));
        });
      },
      options);
  return line.output(output);
}

std::string textOfRegion(const StiffnessRegion& region) {
  const std::string factor = "=" + textOf(region.factor);
  if (!region.isBall()) return std::string(shortName(region.lobe)) + factor;
  const Vec3& c = region.centre;
  return textOf(c.x()) + "," + textOf(c.y()) + "," + textOf(c.z()) + "," + textOf(region.radiusMm) +
         factor;
}

std::string textOfView(ViewDirection view) {
  const ViewDirection told = toTenths(view);
  return textOf(told.azimuthDeg) + "," + textOf(told.elevationDeg);
}

ShellCommand openCommand(const Document& document) {
  const LungModel& model = document.model();
  if (!document.projectPath().empty()) {
    return {{Line("info").file(document.projectPath().string()).text()}, {}};
  }
  Line line("info");
  std::vector<std::string> files;
  if (model.ctSource) files.push_back(model.ctSource->path.string());
  for (const InputFile& input : model.inputs) {
    if (std::ranges::find(files, input.path) == files.end()) files.push_back(input.path);
  }
  if (!files.empty()) {
    line.files(files);
    if (model.ctSource && !model.ctSource->series.empty()) {
      line.option("series", model.ctSource->series);
    }
    return {{line.text()}, {}};
  }
  if (!model.organ.empty()) {
    return refused(QObject::tr("A built-in organ is no file: the step Airways names it."));
  }
  const Source source = sourceOf(document);
  if (source.lines.isEmpty()) return refused(QObject::tr("Open something first."));
  return {{source.lines.first()}, {}};
}

ShellCommand lungsCommand(const Document& document) {
  const LungModel& model = document.model();
  if (!model.ctSource) return refused(QObject::tr("Open a CT first."));
  if (model.corrections && model.corrections->read) {
    return refused(
        QObject::tr("The corrections are of labels from a file, not of lungs that the command "
                    "finds: export the segmentation."));
  }
  const bool corrected = model.corrections && !document.lungsOutOfDate();
  return {segmentLines(*model.ctSource, document.lungOptions(), corrected), {}};
}

ShellCommand lobesCommand(const Document& document) {
  if (!document.canSplit()) {
    return refused(QObject::tr("Open whole lungs or find them in a CT first."));
  }
  Source source;
  if (!document.projectPath().empty()) {
    source = sourceOf(document);
  } else {
    findSurfaces(source, document);
  }
  if (!source.obstacle.isEmpty()) return refused(source.obstacle);
  addLobes(source, document.model(), document.snapshot().lobeEdits);
  return {source.lines, {}};
}

ShellCommand airwaysCommand(const Document& document) {
  if (!document.canGrow()) return refused(QObject::tr("Open lobe surfaces or an organ first."));
  Source source = sourceOf(document);
  if (!source.obstacle.isEmpty()) return refused(source.obstacle);
  if (source.nothing()) return refused(saveFirst());
  return {source.lines << growLine(source, document.growthOptions()), {}};
}

ShellCommand breathingCommand(const Document& document) {
  if (!document.canBreathe()) return refused(QObject::tr("Open lobes or lungs first."));
  Source source = sourceOf(document);
  if (!source.obstacle.isEmpty()) return refused(source.obstacle);
  const LungModel& model = document.model();
  const BreatheOptions& options = document.breatheOptions();
  if ((options.fit && !document.breathFile()) || (options.person && !document.constantsFile())) {
    return refused(QObject::tr(
        "The project holds what was fitted, but not where its file is: open it again."));
  }
  Line line("breathe");
  line.files(source.surfaces);
  if (!source.project) {
    const bool sample = source.surfaces == std::vector<std::string>{SampleFolder};
    if (model.growth) {
      source.lines << growLine(source, model.growth->options);
      line.file(TreeName);
    } else if (!source.tree.empty()) {
      line.file(source.tree);
    } else if (!source.central.empty() && !sample) {
      line.file(source.central);
    }
  }
  line.options(options);
  if (options.fit) line.option("fit", document.breathFile()->path);
  if (options.person) line.option("constants", document.constantsFile()->path);
  for (const StiffnessRegion& region : options.regions) {
    line.option("stiffness", textOfRegion(region));
  }
  return {source.lines << line.output("breath.pvd"), {}};
}

ShellCommand exportCommand(const Document& document, const ExportWish& wish) {
  const ExportRow row = exportRows(document.snapshot())[static_cast<std::size_t>(wish.kind)];
  if (!row.lack.isEmpty()) return refused(row.lack);
  const LungModel& model = document.model();
  Source source = sourceOf(document);
  if (!source.obstacle.isEmpty()) return refused(source.obstacle);
  const bool made = model.growth || model.lobes || model.lungs || document.snapshot().breath;
  if (!source.project && made) return refused(saveFirst());
  std::vector<std::string> files = source.surfaces;
  const bool sample = files == std::vector<std::string>{SampleFolder};
  for (const std::string& tree : {source.central, source.tree}) {
    if (!tree.empty() && !sample) files.push_back(tree);
  }
  if (files.empty()) return refused(saveFirst());
  Line line(wish.kind == ExportKind::Report   ? "report"
            : wish.kind == ExportKind::Figure ? "render"
                                              : "export");
  line.files(files);
  if (const auto preset = presetOf(wish.kind)) {
    line.option("preset", textOf(*preset));
    if (!wish.format.empty() && wish.format != formatsOf(*preset).front()) {
      line.option("as", wish.format);
    }
    if (preset == ExportPreset::Film) line.option("view", textOfView(wish.view));
    return {source.lines << line.output(row.name), {}};
  }
  if (wish.kind == ExportKind::Figure) {
    line.option("view", textOfView(wish.view));
    return {source.lines << line.output("figure.png"), {}};
  }
  if (wish.identify) line.add("--identify");
  return {source.lines << line.output("report.pdf"), {}};
}

}  // namespace

ShellCommand compareCommand(const Document& document) {
  if (!document.comparison()) return refused(QObject::tr("Compare methods first."));
  Source source = sourceOf(document);
  if (!source.obstacle.isEmpty()) return refused(source.obstacle);
  if (source.nothing()) return refused(saveFirst());
  Line line("compare");
  for (const auto& growth : document.comparison()->growths) {
    const std::string tree = std::string(growthMethod(growth->options).name) + ".vtp";
    source.lines << growLine(source, growth->options, tree);
    line.file(tree);
  }
  for (const std::string& surface : source.surfaces) line.option("domain", surface);
  if (!source.organ.empty()) line.option("organ", source.organ);
  line.add("--csv");
  return {source.lines << line.output("comparison.csv"), {}};
}

QString shellWord(std::string_view text) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("_@%+=:,./-").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!text.empty() && std::ranges::all_of(text, plain)) return qtText(text);
  QString inside = qtText(text);
  inside.replace(QLatin1Char('\''), QStringLiteral("'\\''"));
  return QLatin1Char('\'') + inside + QLatin1Char('\'');
}

ShellCommand shellCommand(WorkStep step, const Document& document, const ExportWish& wish) {
  switch (step) {
    case WorkStep::Open:
      return openCommand(document);
    case WorkStep::Lungs:
      return lungsCommand(document);
    case WorkStep::Lobes:
      return lobesCommand(document);
    case WorkStep::Airways:
      return airwaysCommand(document);
    case WorkStep::Breathing:
      return breathingCommand(document);
    case WorkStep::Export:
      break;
  }
  return exportCommand(document, wish);
}

}  // namespace pneuma
