#include "io/fissure_file.h"

#include <utility>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/detail/fissure_formats.h"
#include "io/detail/text_fields.h"
#include "io/surface_file.h"

namespace pneuma {
namespace {

constexpr std::size_t MostBytes = std::size_t{64} << 20;
/// Farther than anything on Earth; beyond, sums of squares and sentences are of no use.
constexpr double FarthestMm = 1e10;
constexpr std::string_view MarkupsEnding = ".mrk.json";

Json parsed(const std::filesystem::path& path, const std::string& text) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw InvalidInput(quoted(path) + " is no JSON near byte " + std::to_string(error.byte) +
                       "; it is cut off or damaged");
  } catch (const Json::out_of_range&) {
    throw InvalidInput(quoted(path) + " holds a number that is too large");
  }
}

bool isMarkupsName(const std::filesystem::path& path) {
  return lowerCase(path.filename().string()).ends_with(MarkupsEnding);
}

/// Other formats than ours have points and nothing else.
void requirePointsOnly(const std::filesystem::path& path, const GivenFissures& fissures) {
  for (const auto& [fissure, given] : fissures) {
    if (!given.plane && !given.equation && !given.patch && given.weights.empty()) continue;
    throw Unsupported(quoted(path) + " cannot tell of the " + std::string(longName(fissure)) +
                      (given.plane      ? "'s plane"
                       : given.equation ? "'s equation"
                       : given.patch    ? "'s surface"
                                        : "'s weights") +
                      ": that format has points alone; write .json instead");
  }
}

/// @throws InvalidInput naming the fissure of a place that is nowhere near a person
void requireNearPlaces(const std::filesystem::path& path, const GivenFissure& given,
                       const std::string& fissure) {
  std::vector<Vec3> places = given.points;
  if (given.plane) places.push_back(given.plane->point);
  if (given.equation) places.push_back(given.equation->origin);
  for (const Vec3& p : places) {
    if (p.cwiseAbs().maxCoeff() <= FarthestMm) continue;
    throw InvalidInput(quoted(path) + " sets a point of the " + fissure + " at " + pointText(p) +
                       ", more than 10,000 km away; lengths are in mm");
  }
}

FissureFile readAnyFormat(const std::filesystem::path& path) {
  const std::string text = readFile(path, MostBytes);
  const std::string extension = lowerCase(path.extension().string());
  if (extension == ".json") {
    const Json json = parsed(path, text);
    const bool markups = isMarkupsName(path) || isMarkups(json);
    return markups ? FissureFile{fissuresOfMarkups(path, json), {}} : fissuresOfJson(path, json);
  }
  if (extension == ".fcsv") return {fissuresOfFcsv(path, text), {}};
  if (extension == ".csv") return {fissuresOfCipCsv(path, text), {}};
  throw Unsupported(quoted(path) +
                    " cannot be read as points of fissures; give .json (pneuma/fissures/1), "
                    ".mrk.json or .fcsv (3D Slicer), or .csv (Chest Imaging Platform)");
}

}  // namespace

Vec3 planeNormal(double tiltRad, double turnRad) {
  return rotated(rotated(Vec3::UnitZ(), Vec3::UnitX(), tiltRad), Vec3::UnitY(), turnRad);
}

FissureFile readFissureFile(const std::filesystem::path& path) {
  FissureFile file = readAnyFormat(path);
  for (const auto& [fissure, given] : file.fissures) {
    requireNearPlaces(path, given, std::string(longName(fissure)));
  }
  for (const AccessoryFissure& accessory : file.accessory) {
    requireNearPlaces(path, accessory.fissure, quotedName(accessory.name));
  }
  return file;
}

FissurePatch readFissurePatch(const std::filesystem::path& path) {
  SurfaceFile surface = readSurface(path);
  return {path, std::make_shared<const TriangleMesh>(std::move(surface.mesh)),
          std::move(surface.notes)};
}

GivenFissures readFissures(const std::filesystem::path& path) {
  return readFissureFile(path).fissures;
}

GivenFissures readPlanes(const std::filesystem::path& path) {
  const FissureFile file = readFissureFile(path);
  if (!file.accessory.empty()) {
    throw InvalidInput(quoted(path) + " has accessory fissures; they are taken by --fissures");
  }
  for (const auto& [fissure, given] : file.fissures) {
    if (given.plane) continue;
    throw InvalidInput(quoted(path) + " gives no plane for the " + std::string(longName(fissure)) +
                       " but " +
                       (given.equation ? "an equation"
                        : given.patch  ? "a surface"
                                       : "points") +
                       "; what is no plane is taken by --fissures");
  }
  return file.fissures;
}

std::vector<std::filesystem::path> patchFiles(const FissureFile& file) {
  std::vector<std::filesystem::path> files;
  const auto add = [&](const GivenFissure& given) {
    if (given.patch) files.push_back(given.patch->file);
  };
  for (const auto& [fissure, given] : file.fissures) add(given);
  for (const AccessoryFissure& accessory : file.accessory) add(accessory.fissure);
  return files;
}

void writeFissures(const std::filesystem::path& path, const GivenFissures& fissures,
                   const std::vector<AccessoryFissure>& accessory) {
  const std::string extension = lowerCase(path.extension().string());
  if (extension == ".json" && !isMarkupsName(path)) {
    writeFile(path, fissureJsonText({fissures, accessory}, path.parent_path()));
    return;
  }
  requireFissureFileName(path);
  requirePointsOnly(path, fissures);
  if (!accessory.empty()) {
    throw Unsupported(quoted(path) + " cannot tell of accessory fissures; write .json instead");
  }
  writeFile(path, extension == ".json"   ? markupsText(fissures)
                  : extension == ".fcsv" ? fcsvText(fissures)
                                         : cipCsvText(fissures));
}

void requireFissureFileName(const std::filesystem::path& path) {
  const std::string extension = lowerCase(path.extension().string());
  if (extension == ".json" || extension == ".fcsv" || extension == ".csv") return;
  throw Unsupported("fissures cannot be written as " + quoted(path) +
                    "; take .json, .mrk.json, .fcsv or .csv");
}

}  // namespace pneuma
