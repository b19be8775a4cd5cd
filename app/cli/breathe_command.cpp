#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>

#include "cli/arguments.h"
#include "cli/breath_picture.h"
#include "cli/command.h"
#include "cli/files.h"
#include "cli/limits.h"
#include "cli/picture_arguments.h"
#include "cli/text.h"
#include "pipeline/breath_curve.h"
#include "pipeline/breathe.h"
#include "pipeline/breathe_files.h"
#include "pipeline/measured_breath.h"
#include "views/breath_gltf.h"
#include "views/breath_pictures.h"

namespace pneuma::cli {
namespace {

struct BreatheArguments {
  std::vector<std::filesystem::path> inputs;
  BreatheOptions options;
  std::filesystem::path fit;
  std::filesystem::path constants;
  std::filesystem::path curve;
  std::filesystem::path gltf;
  std::vector<std::string> stiffness;
  std::vector<std::string> emphysema;
  std::string largestFile;  ///< as given
  bool pictures = false;
  PictureArguments look;
  bool onionSkin = false;
};

/// "breath.pvd" -> "breath_0007.png"
std::filesystem::path framePicture(const std::filesystem::path& pvd, int frame) {
  std::array<char, 24> ending{};
  std::snprintf(ending.data(), ending.size(), "_%04d.png", frame);
  return pvd.parent_path() / pvd.stem().concat(ending.data());
}

BreathLook lookOf(const BreatheArguments& arguments) {
  const PictureArguments& look = arguments.look;
  return {sceneOptions(look), viewDirection(look.view), look.size.width, look.size.height,
          arguments.onionSkin};
}

std::filesystem::path tableBeside(const std::filesystem::path& picture) {
  return std::filesystem::path(picture).replace_extension(".csv");
}

std::string fitText(const Json& fit) {
  std::string text = "fitted to " + fixed(fit.at("rms_percent").get<double>(), 2) +
                     " % of the measured volume: compliance " +
                     fixed(fit.at("compliance_l_per_cmH2O").get<double>(), 3) +
                     " l/cmH2O, resistance";
  for (const Json& part : fit.at("resistance_cmH2O_s_per_l")) {
    text += " " + fixed(part.get<double>(), 2);
  }
  return text + " cmH2O s/l\n";
}

std::string summary(const Json& report, const std::filesystem::path& output) {
  const Json& breath = report.at("breath");
  const auto ml = [](const Json& value) { return fixed(value.get<double>(), 0) + " ml"; };
  std::string text = output.string() + ": " + report.at("scenario").get<std::string>() + ", " +
                     ml(breath.at("tidal_ml")) + " in " +
                     fixed(breath.at("period_s").get<double>(), 1) + " s\n";
  std::vector<std::vector<std::string>> rows = {{"lung", "at rest", "least", "most"}};
  for (const Json& lung : report.at("lungs")) {
    rows.push_back({lung.at("lung").get<std::string>(), ml(lung.at("rest_ml")),
                    ml(lung.at("least_ml")), ml(lung.at("most_ml"))});
  }
  if (report.contains("fit")) text += fitText(report.at("fit"));
  text += table(rows);
  if (report.contains("pleural_gap")) {
    const Json& gap = report.at("pleural_gap");
    text += "air around the " + gap.at("lung").get<std::string>() +
            " lung: " + ml(gap.at("gap_ml")) + " within a chest wall of " +
            ml(gap.at("chest_wall_rest_ml")) + "\n";
  }
  return text + report.at("basis").get<std::string>() + "\n" + failedChecks(report);
}

ExitCode runBreathe(BreatheArguments arguments, const CommonOptions& common,
                    const Progress& progress) {
  if (common.output.extension() != ".pvd") {
    throw Unsupported("breaths are written for ParaView; '" + common.output.string() +
                      "' should end in .pvd");
  }
  requireOutput(common.output, common.existing());
  const std::uint64_t largestBytes = largestFileBytes(arguments.largestFile);
  for (const std::string& region : arguments.stiffness) {
    arguments.options.regions.push_back(stiffnessRegion(region));
  }
  for (const std::string& name : arguments.emphysema) {
    const std::optional<Lobe> lobe = lobeOfShortName(name);
    if (!lobe) {
      throw InvalidOption("--emphysema knows RUL, RML, RLL, LUL, LLL, but '" + name +
                          "' was given");
    }
    arguments.options.regions.push_back({*lobe, Vec3::Zero(), 0.0, EmphysemaFactor});
  }
  if (!arguments.curve.empty()) requirePngOutput(arguments.curve, common.existing());
  MeasuredBreath measured;
  if (!arguments.fit.empty()) {
    measured = readMeasuredBreath(arguments.fit);
    arguments.options.fit = std::make_shared<const BreathFit>(fitBreath(measured));
  }
  if (!arguments.constants.empty()) {
    arguments.options.person =
        std::make_shared<const PersonMotion>(readPersonMotion(arguments.constants));
  }
  LungModel model = openFiles(expanded(arguments.inputs), progress.part(0.0, 0.2, "reading"));
  for (const std::filesystem::path& file : {arguments.fit, arguments.constants}) {
    if (file.empty()) continue;
    model.inputs.push_back(inputFile(file));
    arguments.inputs.push_back(file);
  }
  const std::filesystem::path folder = common.output.parent_path();
  std::vector<std::filesystem::path> frames =
      breathOutputs(common.output, model, arguments.options, largestBytes);
  std::vector<std::filesystem::path> paths;  // of what is written besides
  if (!arguments.curve.empty()) {
    const std::filesystem::path table = tableBeside(arguments.curve);
    const auto isTable = [&](const std::filesystem::path& file) {
      return (folder / file).lexically_normal() == table.lexically_normal();
    };
    if (std::ranges::any_of(frames, isTable)) {
      throw InvalidOption("the curve's table would be '" + table.string() +
                          "', which holds the table of frames; name the picture otherwise");
    }
    paths.push_back(arguments.curve);
    paths.push_back(table);
  }
  if (!arguments.gltf.empty()) {
    if (arguments.gltf.extension() != ".glb") {
      throw Unsupported("animations are written as binary glTF; '" + arguments.gltf.string() +
                        "' should end in .glb");
    }
    paths.push_back(arguments.gltf);
  }
  if (arguments.pictures) {
    requireDisplay();
    for (int n = 0; n < arguments.options.frames; ++n) {
      paths.push_back(framePicture(common.output, n));
    }
  }
  const auto requirePlaces = [&] {
    requireNoOtherSeries(common.output, frames);
    for (const auto& file : frames) {
      const std::filesystem::path path = folder / file;
      if (file.has_parent_path() && !exists(path.parent_path())) continue;  // it will be made
      requireOutput(path, common.existing());
      requireOtherThanInputs(path, arguments.inputs);
    }
  };
  requirePlaces();
  for (const auto& path : paths) {
    requireOutput(path, common.existing());
    requireOtherThanInputs(path, arguments.inputs);
  }
  const BreathingLungs lungs =
      breathe(model, arguments.options, progress.part(0.2, 0.7, "breathing"));
  const Json report = breatheReport(model, lungs, arguments.options);
  frames = breathOutputs(common.output, lungs, largestBytes);
  requirePlaces();
  OutputSet outputs;
  for (const auto& file : frames) {
    if (!file.has_parent_path()) {
      outputs.add(folder / file);
      continue;
    }
    outputs.addFolder(folder / file.parent_path());
    outputs.add(folder / file, folder.empty() ? "." : folder);
  }
  for (const auto& path : paths) outputs.add(path);
  writeBreath(common.output, lungs, report, progress.part(0.7, 0.85, "writing"), largestBytes);
  if (arguments.pictures) {
    const auto write = [&](int frame, const Picture& picture) {
      writeFile(framePicture(common.output, frame), pngText(picture), common.existing());
    };
    drawBreath(lungs, lungs.frames, lookOf(arguments), write, progress.part(0.85, 1.0, "drawing"));
  }
  if (!arguments.gltf.empty()) writeBreathGltf(arguments.gltf, lungs, common.existing());
  if (!arguments.curve.empty()) {
    writeFile(arguments.curve, pngText(breathPicture(lungs.cycle, measured)), common.existing());
    writeFile(tableBeside(arguments.curve), breathCurveCsv(lungs.cycle), common.existing());
  }
  outputs.keep();
  if (!common.quiet) printWarnings(report.at("warnings").get<std::vector<std::string>>());
  if (common.json) {
    std::cout << jsonText(report);
  } else if (!common.quiet) {
    std::cout << summary(report, common.output);
  }
  return failedChecks(report).empty() ? ExitCode::Done : ExitCode::CheckFailed;
}

}  // namespace

Run declareBreathe(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<BreatheArguments>();
  addFiles(app, "LOBES", arguments->inputs,
           "Surfaces of lobes or of whole lungs at the end of expiration, or a folder of them, and "
           "the airways that were grown in them if they shall move too.")
      ->required();
  addFields(app, arguments->options);
  app.add_option(
         "--fit", arguments->fit,
         "A measured breath (CSV: seconds, pressure_cmH2O, volume_ml) to breathe instead of "
         "the scenario's: the equation of pressure and volume is fitted to it.")
      ->type_name("FILE");
  app.add_option("--constants", arguments->constants,
                 "Move the lungs by constants that 'pneuma estimate' fitted to this person's "
                 "landmarks, in place of those of people in general.")
      ->type_name("FILE");
  app.add_option("--curve", arguments->curve,
                 "Draw pressure and volume of the breath (.png) and write them as a table (.csv) "
                 "beside it.")
      ->type_name("FILE");
  app.add_option("--gltf", arguments->gltf,
                 "Write the lungs, moving, for web pages, Blender and slides too (.glb).")
      ->type_name("FILE");
  app.add_option("--largest-file", arguments->largestFile,
                 "Surfaces or airways whose file of a frame would be larger are written in pieces, "
                 "with a .vtm that names them; bytes, or as 500M (default 2G).")
      ->type_name("SIZE");
  addRepeatable(app, "--stiffness", arguments->stiffness, "REGION=FACTOR",
                "A lobe, or a ball X,Y,Z,RADIUS (mm, LPS), and how many times as stiff as healthy "
                "lung it is: LLL=0.5, 60,-20,-150,15=5. May be repeated.");
  addRepeatable(app, "--emphysema", arguments->emphysema, "{RUL|RML|RLL|LUL|LLL}",
                "A lobe with emphysema: half as stiff as healthy lung. May be repeated.");
  CLI::Option* pictures =
      app.add_flag("--pictures", arguments->pictures,
                   "Draw every frame too, beside it and from the same place (.png).");
  for (CLI::Option* option :
       addPictureArguments(app, arguments->look, "Width and height of the pictures in pixels.")) {
    option->needs(pictures);
  }
  app.add_flag("--onion-skin", arguments->onionSkin,
               "Draw where the lungs are at the ends of expiration and inspiration, too.")
      ->needs(pictures);
  addOutput(app, common, "FILE",
            "The collection for ParaView (.pvd). Beside it: a VTP for every frame, of the airways "
            "too, a .vtp.series (unless frames are in pieces), the table of volumes and pressures "
            "(.csv) and the report (.json).")
      ->required();
  addJson(app, common);
  return [arguments, &common](const Progress& progress) {
    return runBreathe(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
