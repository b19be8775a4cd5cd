#include "io/input_files.h"

#include <algorithm>
#include <array>
#include <memory>

#include <openssl/evp.h>

#include "core/error.h"
#include "io/detail/hex_digits.h"
#include "io/detail/input_file.h"
#include "io/detail/text_fields.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t PieceSize = std::size_t{1} << 20;

/// The entries of a kind that `wanted` tells.
template <typename Iterator, typename Wanted>
std::vector<fs::path> entries(const fs::path& folder, Wanted wanted) {
  std::error_code error;
  std::vector<fs::path> files;
  for (Iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    if (wanted(entry->status(ignored).type())) files.push_back(entry->path());
  }
  if (error) {
    throw InputMissing("the folder " + quoted(folder) + " cannot be read: " + error.message());
  }
  std::ranges::sort(files);
  return files;
}

bool isFile(fs::file_type type) { return type == fs::file_type::regular; }

}  // namespace

std::vector<fs::path> filesIn(const fs::path& folder) {
  return entries<fs::directory_iterator>(folder, isFile);
}

std::vector<fs::path> unreadableIn(const fs::path& folder) {
  return entries<fs::directory_iterator>(folder, [](fs::file_type type) {
    return type != fs::file_type::regular && type != fs::file_type::directory;
  });
}

std::vector<fs::path> filesBelow(const fs::path& folder) {
  return entries<fs::recursive_directory_iterator>(folder, isFile);
}

std::string sha256OfFile(const fs::path& path, const Progress& progress) {
  const ReadableFile file(path);
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(),
                                                                        &EVP_MD_CTX_free);
  if (!context) throw std::bad_alloc();
  bool sound = EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) == 1;
  std::vector<char> piece(PieceSize);
  std::uint64_t done = 0;
  while (const std::size_t size = file.read(piece, done)) {
    sound = sound && EVP_DigestUpdate(context.get(), piece.data(), size) == 1;
    done += size;
    progress.report(static_cast<double>(done) / static_cast<double>(std::max(done, file.size())));
  }
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (!sound || EVP_DigestFinal_ex(context.get(), digest.data(), &size) != 1) {
    throw Error(ExitCode::Internal, "OpenSSL could not compute a SHA-256");
  }
  return hexDigits({digest.data(), size});
}

}  // namespace pneuma
