#include <array>
#include <vector>

#include "cli/command.h"
#include "core/options.h"

namespace pneuma::cli {
namespace {

constexpr std::array<Command, 28> Table = {{
    {"run", "From a CT to lungs, lobes and a grown tree, by a recipe.", declareRun},
    {"cohort", "Write a Snakemake workflow that does all of it for many CTs.", declareCohort},
    {"segment", "Find lungs and central airways in a CT.", declareSegment},
    {"lobes", "Split lungs into lobes along their fissures.", declareLobes},
    {"check", "Check a folder of lobes all over again.", declareCheck},
    {"fissures", "Set points upon the fissures between lobes that touch.", declareFissures},
    {"grow", "Grow a bronchial tree in lobes or in a built-in organ.", declareGrow},
    {"study", "Grow with many seeds: mean and spread of the figures.", declareStudy},
    {"outline", "Aggregate in the outline of a right lung, in a plane (Zhang 2003).",
     declareOutline},
    {"breathe", "Make lungs and their airways breathe, frame by frame.", declareBreathe},
    {"estimate", "Fit how lungs move to one person's landmarks, and say what that is worth.",
     declareEstimate},
    {"measure", "Measure a tree: orders, ratios, angles, lengths, homogeneity.", declareMeasure},
    {"compare", "Put trees, labels or surfaces side by side: one table, one picture.",
     declareCompare},
    {"info", "Say what surfaces, trees and CTs are worth, and what is wrong with them.",
     declareInfo},
    {"import", "Read a CT (DICOM, zip, volume) and write it as one volume file.", declareImport},
    {"repair", "Mend a surface and list what was changed.", declareRepair},
    {"anonymize", "Take names, dates and private data out of DICOM files.", declareAnonymize},
    {"render", "Make a picture of surfaces and trees.", declareRender},
    {"regress", "Draw listed pictures again and compare them with their references.",
     declareRegress},
    {"export", "Convert surfaces and trees between formats, frames and units.", declareExport},
    {"sample", "Write a synthetic chest with known truth.", declareSample},
    {"report", "Put everything known of a case on one page.", declareReport},
    {"thumbnail", "Take the picture out of a project, for file managers.", declareThumbnail},
    {"reproduce", "Repeat a paper's experiment: published beside measured.", declareReproduce},
    {"doctor", "Check this installation and this machine.", declareDoctor},
    {"completion", "Print a shell's completion script.", declareCompletion},
    {"help", "Explain a command.", declareHelp},
    {"version", "Print the version.", declareVersion},
}};

}  // namespace

std::span<const Command> commands() { return Table; }

const Command& command(std::string_view name) {
  std::vector<std::string_view> names;
  for (const Command& candidate : Table) {
    if (candidate.name == name) return candidate;
    names.push_back(candidate.name);
  }
  const std::string_view nearest = nearestWord(name, names);
  throw InvalidOption("there is no command '" + std::string(name) + "'; " +
                      (nearest.empty() ? "'pneuma help' lists them"
                                       : "did you mean '" + std::string(nearest) + "'?"));
}

}  // namespace pneuma::cli
