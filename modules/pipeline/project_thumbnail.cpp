#include "pipeline/project_thumbnail.h"

#include "core/error.h"
#include "io/archive_lookup.h"

namespace pneuma {

std::string projectThumbnail(const std::filesystem::path& path) {
  constexpr std::uint64_t LargestPicture = std::uint64_t{1} << 26;
  constexpr std::uint64_t LargestJson = std::uint64_t{1} << 36;
  if (auto picture = readMember(path, "thumbnail.png", LargestPicture)) return *std::move(picture);
  if (!readMember(path, "project.json", LargestJson)) {
    throw InvalidInput("'" + path.string() + "' is no project of Pneuma: it holds no project.json");
  }
  return {};
}

}  // namespace pneuma
