#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace pneuma::cli {

/// Bytes of "8G", "1.5G", "500M", "64K" (of 1024 each) or a plain number of bytes.
/// @param option for messages
/// @throws InvalidOption for anything else
std::uint64_t parseBytes(std::string_view option, std::string_view text);

/// The bytes of `--largest-file` (io/piece_files.h); what is usual if there is no text.
/// @throws InvalidOption if that is no size, or too small a one
std::uint64_t largestFileBytes(const std::string& text);

/// Likewise of --max-memory; 0: no limit.
/// @throws InvalidOption as well for less than 64M, in which nothing runs
std::uint64_t parseMemorySize(std::string_view text);

/// From now on the process gets no more than `bytes` for its data: an allocation over it fails, and
/// work that would take more says so before it starts. 0 leaves everything as it is.
/// A stricter limit that is set from outside stays. @throws InvalidOption if the system has no such
/// limit
void limitMemory(std::uint64_t bytes);

/// Graphics libraries end the process where memory ends, so they start only with enough of it.
/// @throws Error (OutOfMemory) if a limit on the process leaves less than drawing takes
void requireMemoryForDrawing();

/// After `seconds` the wish to stop is there, as if by Ctrl-C; timeIsOver() tells the two apart. 0:
/// never.
void limitTime(double seconds);

/// True once the time of limitTime() has passed.
bool timeIsOver();

}  // namespace pneuma::cli
