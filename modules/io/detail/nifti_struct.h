#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace pneuma {

/// The NIfTI-1 header, byte for byte (nifti1.h, R. W. Cox et al., 2004).
struct NiftiStruct {
  std::int32_t sizeofHdr;
  std::array<char, 35> unused;
  std::uint8_t dimInfo;
  std::array<std::int16_t, 8> dim;
  std::array<float, 3> intentParameters;
  std::int16_t intentCode;
  std::int16_t datatype;
  std::int16_t bitpix;
  std::int16_t sliceStart;
  std::array<float, 8> pixdim;
  float voxOffset;
  float sclSlope;
  float sclInter;
  std::int16_t sliceEnd;
  std::uint8_t sliceCode;
  std::uint8_t xyztUnits;
  float calMax;
  float calMin;
  float sliceDuration;
  float toffset;
  std::array<std::int32_t, 2> glMaxMin;
  std::array<char, 80> descrip;
  std::array<char, 24> auxFile;
  std::int16_t qformCode;
  std::int16_t sformCode;
  std::array<float, 3> quatern;  ///< b, c, d
  std::array<float, 3> qoffset;
  std::array<std::array<float, 4>, 3> srow;
  std::array<char, 16> intentName;
  std::array<char, 4> magic;
};

static_assert(sizeof(NiftiStruct) == 348);

/// True for the header of a NIfTI file of any kind (1 or 2, single or a pair, either byte order)
/// or of its forerunner Analyze: 348 bytes or more of which the first and the magic fit.
bool isNiftiHeader(std::string_view head);

// Codes of datatype, xyztUnits and the forms.
inline constexpr std::int16_t NiftiUint8 = 2;
inline constexpr std::int16_t NiftiInt16 = 4;
inline constexpr std::uint8_t NiftiMillimetres = 2;
inline constexpr std::int16_t NiftiScannerFrame = 1;
inline constexpr std::int16_t NiftiLabels = 1002;

}  // namespace pneuma
