#pragma once

#include <cstdint>
#include <span>

#include "core/progress.h"
#include "io/atomic_file.h"

namespace pneuma {

/// What is put around compressed data.
enum class Wrapper { Zlib, Gzip };

/// Compresses `bytes` to the end of `file`; the same bytes give the same file. Returns how many
/// were written. @throws OutputFailed, Cancelled
std::uint64_t writePacked(AtomicFile& file, Wrapper wrapper, std::span<const char> head,
                          std::span<const char> bytes, const Progress& progress);

}  // namespace pneuma
