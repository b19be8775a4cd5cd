#include "pipeline/ct_source.h"

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/ct_file.h"
#include "io/input_files.h"

namespace pneuma {

std::string contentHash(const std::vector<std::filesystem::path>& files, const Progress& progress) {
  std::string all;
  for (std::size_t n = 0; n < files.size(); ++n) {
    const auto part = [&](std::size_t done) {
      return static_cast<double>(done) / static_cast<double>(files.size());
    };
    all += files[n].filename().string() + "\n" +
           sha256OfFile(files[n], progress.part(part(n), part(n + 1), "hashing"));
  }
  return sha256(all);
}

CtSource hashed(CtSource source, const Progress& progress) {
  if (!source.sha256.empty()) return source;
  const auto files =
      ctInputFiles(source.path, {source.series}, progress.part(0.0, 0.2, "reading headers"));
  source.bytes = 0;
  for (const std::filesystem::path& file : files) {
    std::error_code error;
    const std::uint64_t bytes = std::filesystem::file_size(file, error);
    if (error) throw InputMissing("the CT '" + file.string() + "' cannot be read");
    source.bytes += bytes;
  }
  const Progress hashing = progress.part(0.2, 1.0, "hashing");
  source.sha256 =
      files.size() == 1 ? sha256OfFile(files.front(), hashing) : contentHash(files, hashing);
  return source;
}

}  // namespace pneuma
