#pragma once

#include <cstdint>

/// What marks the parts of a DICOM file (PS3.5, 7.5), group and element in one number.
namespace pneuma::dicom {

inline constexpr std::uint32_t UndefinedLength = 0xFFFFFFFF;
inline constexpr std::uint32_t Item = 0xFFFEE000;
inline constexpr std::uint32_t ItemEnd = 0xFFFEE00D;
inline constexpr std::uint32_t SequenceEnd = 0xFFFEE0DD;
inline constexpr std::uint32_t TransferSyntax = 0x00020010;
inline constexpr int MostNested = 32;  ///< sequences in sequences that are followed

}  // namespace pneuma::dicom
