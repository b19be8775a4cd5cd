#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <ostream>

#include "core/error.h"
#include "volume_samples.h"

/// Volume files that are bad, each in one way.
namespace pneuma::testing {

inline constexpr auto IsMissing = ExitCode::InputMissing;
inline constexpr auto IsInvalid = ExitCode::InputInvalid;
inline constexpr auto IsUnsupported = ExitCode::Unsupported;

/// A file and what must be said about it.
struct BadFile {
  std::string file;
  std::string content;
  ExitCode code;
  std::string cause;      ///< part of the sentence
  std::string data = {};  ///< of "voxels.raw" beside a detached header, "" for none
};

inline void PrintTo(const BadFile& bad, std::ostream* out) {
  *out << bad.file << ": " << bad.cause;
}

inline std::string nifti(const std::function<void(NiftiStruct&)>& change,
                         const std::string& voxels = smallBytes()) {
  NiftiStruct h = smallNifti();
  change(h);
  return niftiBytes(h, voxels);
}

/// The small NIfTI with one byte of its packed form changed, from the end if negative.
inline std::string damagedGzip(int at) {
  std::string content = packed(niftiBytes(smallNifti()));
  const auto size = static_cast<int>(content.size());
  content[static_cast<std::size_t>(at < 0 ? size + at : at)] ^= 0x55;
  return content;
}

inline std::string cut(const std::string& content, std::size_t bytes) {
  return content.substr(0, content.size() - bytes);
}

inline std::string floats(float third) {
  std::vector<float> values(24, 7.0F);
  values[2] = third;
  return bytesOfValues(values);
}

/// The values are floats.
inline void asFloat(NiftiStruct& h) {
  h.datatype = 16;
  h.bitpix = 32;
}

inline constexpr float Nan = std::numeric_limits<float>::quiet_NaN();

inline std::vector<BadFile> badNifti() {
  const std::string good = niftiBytes(smallNifti());
  return {
      {"a.nii", good.substr(0, 300), IsInvalid, "no NIfTI file, although its name says so"},
      {"a.nii", "", IsInvalid, "is empty"},
      {"a.nii", std::string(400, 'x'), IsInvalid, "is damaged or no NIfTI"},
      {"a.nii", cut(good, 1), IsInvalid,
       "is cut off: 4 x 3 x 2 voxels of int16 take 48 bytes, but only 47"},
      {"a.nii", good + "x", IsInvalid, "holds more than its header says"},
      {"a.nii.gz", cut(packed(good), 1), IsInvalid, "compressed data break off after 400"},
      {"a.nii.gz", packed(good).substr(0, 60), IsInvalid, "no NIfTI file"},
      {"a.nii.gz", packed(good) + "more", IsInvalid, "holds more than its header says"},
      {"a.nii.gz", packed(good + "x"), IsInvalid, "holds more than its header says"},
      {"a.nii.gz", packed(cut(good, 5)), IsInvalid, "but only 43 are there"},
      {"a.nii.gz", damagedGzip(-8), IsInvalid, "incorrect data check"},
      {"a.nii.gz", damagedGzip(-4), IsInvalid, "incorrect length check"},
      {"a.nii.gz", damagedGzip(20), IsInvalid, "a.nii.gz\" is damaged"},
      {"a.nii", nifti([](auto& h) { h.dim[3] = 1; }, std::string(24, 'x')), IsUnsupported,
       "single slice of 4 x 3 x 1"},
      {"a.nii", nifti([](auto& h) { h.dim[0] = 2; }), IsUnsupported, "a picture of 4 x 3"},
      {"a.nii", nifti([](auto& h) {
         h.dim[0] = 4;
         h.dim[4] = 3;
       }),
       IsUnsupported, "4 x 3 x 2 x 3 values, several to a voxel"},
      {"a.nii", nifti([](auto& h) { h.dim[2] = 0; }), IsInvalid,
       "4 x 0 x 2 voxels; every axis needs some"},
      {"a.nii", nifti([](auto& h) { h.dim[2] = -3; }), IsInvalid, "4 x -3 x 2"},
      {"a.nii", nifti([](auto& h) { h.dim[0] = 99; }), IsInvalid, "99 dimensions"},
      {"a.nii", nifti([](auto& h) { h.dim = {3, 32767, 32767, 32767, 1, 1, 1, 1}; }), IsInvalid,
       "more than any scanner makes"},
      {"a.nii.gz", packed(nifti([](auto& h) { h.dim = {3, 4000, 4000, 4000, 1, 1, 1, 1}; })),
       IsInvalid, "compressed bytes cannot hold"},
      {"a.nii", nifti([](auto& h) {
         h.datatype = 128;
         h.bitpix = 24;
       }),
       IsUnsupported, "colours (RGB)"},
      {"a.nii", nifti([](auto& h) { h.datatype = 32; }), IsUnsupported, "complex"},
      {"a.nii", nifti([](auto& h) { h.datatype = 77; }), IsInvalid, "the datatype 77"},
      {"a.nii", nifti([](auto& h) { h.bitpix = 8; }), IsInvalid, "int16 of 8 bits"},
      {"a.nii", nifti([](auto& h) { h.xyztUnits = 5; }), IsInvalid, "the unit of length 5"},
      {"a.nii", nifti([](auto& h) { h.voxOffset = 100; }), IsInvalid, "begin at byte 100"},
      {"a.nii", nifti([](auto& h) { h.voxOffset = Nan; }), IsInvalid, "begin at byte nan"},
      {"a.nii", nifti([](auto& h) { h.voxOffset = 1e6; }), IsInvalid, "but only 0 are there"},
      {"a.nii.gz", packed(nifti([](auto& h) { h.voxOffset = 1e6; })), IsInvalid,
       "but only 0 are there"},
      {"a.nii", nifti([](auto& h) {
         h.srow = {{{1, 0, 3, 0}, {0, 2, 0, 0}, {0, 0, 0, 0}}};
       }),
       IsInvalid, "axes that lie in one plane"},
      {"a.nii", nifti([](auto& h) {
         h.srow[1] = {0, Nan, 0, 0};
       }),
       IsInvalid, "direction that is no number"},
      {"a.nii", nifti([](auto& h) { h.srow[1] = {}; }), IsInvalid, "1, 0 and 3 mm apart"},
      {"a.nii", nifti([](auto& h) { h.xyztUnits = 1; }), IsInvalid,
       "1000, 2000 and 3000 mm apart, not 0.01 to 100 mm"},
      {"a.nii", nifti([](auto& h) {
         h.sformCode = 0;
         h.pixdim[2] = -2;
       }),
       IsInvalid, "must be positive numbers"},
      {"a.nii", nifti([](auto& h) {
         h.sformCode = 0;
         h.qformCode = 1;
         h.pixdim[1] = 0;
       }),
       IsInvalid, "must be positive numbers"},
      {"a.nii", nifti([](auto& h) {
         h.sformCode = 0;
         h.qformCode = 1;
         h.quatern = {1, 1, 1};
       }),
       IsInvalid, "quaternion that is no rotation"},
      {"a.nii", nifti([](auto& h) {
         h.sclSlope = 2;
         h.sclInter = Nan;
       }),
       IsInvalid, "no number as intercept"},
      {"a.nii", nifti([](auto& h) { h.sclSlope = 5000; }), IsInvalid,
       "35000 at voxel (3, 1, 0); a CT in HU"},
      {"a.nii", nifti(asFloat, floats(Nan)), IsInvalid, "the value nan at voxel (2, 0, 0)"},
      {"a.nii", nifti(asFloat, floats(INFINITY)), IsInvalid, "the value inf at voxel (2, 0, 0)"},
      {"a.nii", nifti([](auto& h) {
         h.magic = {'n', 'i', '1', '\0'};
       }),
       IsUnsupported, "a pair of files (.hdr and .img)"},
      {"a.nii", nifti([](auto& h) { h.magic = {}; }), IsUnsupported, "Analyze 7.5"},
      {"a.nii", std::string("\x1c\x02\0\0n+2\0\r\n\x1a\n", 12) + std::string(600, '\0'),
       IsUnsupported, "is NIfTI-2"},
      {"a.txt", "no volume", IsUnsupported, "is not a volume that can be read; give NIfTI"},
  };
}

inline BadFile nrrd(const std::vector<std::string>& changes, ExitCode code,
                    const std::string& cause, const std::string& data = "") {
  return {"a  \xc3\xa4.nrrd", nrrdBytes(changes), code, cause, data};
}

inline std::vector<BadFile> badNrrd() {
  return {
      {"a.nrrd", "", IsInvalid, "is empty"},
      {"a.nrrd", "something else", IsInvalid, "is damaged or no NRRD"},
      {"a.nrrd", "NRRD0009\n" + nrrdBytes(), IsUnsupported, "a version of NRRD that is not known"},
      {"a.nrrd", nrrdHeader(), IsInvalid, "is cut off: no empty line"},
      {"a.nrrd", cut(nrrdBytes(), 8), IsInvalid, "but only 40 are there"},
      {"a.nrrd", nrrdBytes() + "xx", IsInvalid, "holds more than its header says"},
      {"a.nrrd", nrrdBytes({"encoding: gzip"}, cut(packed(smallBytes()), 20)), IsInvalid,
       "break off"},
      {"a.nrrd", nrrdBytes({"encoding: gzip"}), IsInvalid, "unknown compression method"},
      nrrd({"nothing to read"}, IsInvalid, "line 10: \"field: value\" was expected"),
      nrrd({"type: block"}, IsUnsupported, "blocks of bytes"),
      nrrd({"type: quaternion"}, IsInvalid, "the type \"quaternion\""),
      nrrd({"type"}, IsInvalid, "the type \"\""),
      nrrd({"dimension: 2"}, IsInvalid, "a value for each of its 2 axes"),
      nrrd({"dimension: 2", "sizes: 4 3", "kinds", "space directions"}, IsUnsupported,
           "a picture of 4 x 3"),
      nrrd({"dimension: 400"}, IsInvalid, "dimension = 400"),
      nrrd({"dimension: three"}, IsInvalid, "dimension = \"three\""),
      nrrd({"sizes: 4 3 1"}, IsUnsupported, "a single slice"),
      nrrd({"sizes: 4 3 -2"}, IsInvalid, "4 x 3 x -2 voxels"),
      nrrd({"sizes: 4000000000 4000000000 4000000000"}, IsInvalid, "more than any scanner makes"),
      nrrd({"sizes: 99999999999999999999 1 1"}, IsInvalid, "needs a whole number"),
      nrrd({"dimension: 4", "sizes: 3 4 3 2", "kinds: RGB-color domain domain domain",
            "space directions: none (1,0,0) (0,2,0) (0,0,3)"},
           IsUnsupported, "3 values to a voxel (an axis of kind \"RGB-color\")"),
      nrrd({"dimension: 4", "sizes: 4 3 2 5", "kinds",
            "space directions: (1,0,0) (0,2,0) (0,0,3) none"},
           IsUnsupported, "several to a voxel (4-D"),
      nrrd({"kinds: domain domain"}, IsInvalid, "a value for each of its 3 axes"),
      nrrd({"kinds: domain domain time"}, IsUnsupported, "an axis of kind \"time\""),
      nrrd({"space: left-posterior-superior-time"}, IsUnsupported, "a volume over time"),
      nrrd({"space: 3D-left-handed"}, IsUnsupported, "left and right cannot be told"),
      nrrd({"space directions: (1,0,0) (0,2,0)"}, IsInvalid, "a value for each of its 3 axes"),
      nrrd({"space directions: (1,0,0) (0,2,0) (0,0,3) (1,1,1)"}, IsInvalid,
           "a value for each of its 3 axes"),
      nrrd({"space directions: (1,0,0) (0,2,0) (0,0,x)"}, IsInvalid,
           "space directions = \"0 0 x\"; it needs 3 numbers"),
      nrrd({"space directions: 1 0 0"}, IsInvalid, "a vector like (1,0,0) was expected"),
      nrrd({"space directions: (1,0,0) (0,2,0) (1,2,0)"}, IsInvalid, "axes that lie in one plane"),
      nrrd({"space directions: (1,0,0) (0,2,0) (0,0,0)"}, IsInvalid, "must be positive numbers"),
      nrrd({"space directions: (1,0,0) (0,nan,0) (0,0,1)"}, IsInvalid,
           "direction that is no number"),
      nrrd({"space directions: (1,0,0) (0,1,0) none"}, IsUnsupported, "an axis without direction"),
      nrrd({"space directions", "spacings: 1 -2 3"}, IsInvalid, "1, -2 and 3 mm apart"),
      nrrd({"space directions: (1,0,0) (0,2,0) (0,0,0.009)"}, IsInvalid,
           "1, 2 and 0.009 mm apart, not 0.01 to 100 mm"),
      nrrd({"space directions: (1,0,0) (0,101,0) (0,0,1)"}, IsInvalid, "not 0.01 to 100 mm"),
      nrrd({"space directions"}, IsInvalid, "does not say how far its voxels lie apart"),
      nrrd({"space origin: (1,2)"}, IsInvalid, "space origin = \"1 2\""),
      nrrd({"space units: \"mm\" \"mm\" \"furlong\""}, IsUnsupported, "measures in \"furlong\""),
      nrrd({"space units: \"mm\" \"mm\" \"m\""}, IsUnsupported, "in different units"),
      nrrd({"endian"}, IsInvalid, "does not say the byte order"),
      nrrd({"encoding: ascii"}, IsUnsupported, "the encoding \"ascii\""),
      nrrd({"encoding: zip"}, IsInvalid, "the encoding \"zip\""),
      nrrd({"byte skip: -7"}, IsInvalid, "byte skip = -7"),
      nrrd({"byte skip: 9223372036854775807"}, IsInvalid, "but only 0 are there"),
      nrrd({"line skip: 2"}, IsUnsupported, "line skip"),
      nrrd({"data file: none.raw"}, IsMissing, "none.raw\", which is not there"),
      nrrd({"data file: ../voxels.raw"}, IsInvalid, "only a plain name in the same folder",
           smallBytes()),
      nrrd({"data file: /etc/hostname"}, IsInvalid, "only a plain name"),
      nrrd({"data file: .."}, IsInvalid, "only a plain name"),
      nrrd({"data file: LIST"}, IsUnsupported, "several files"),
      nrrd({"data file: v%03d.raw 1 9 1"}, IsUnsupported, "several files"),
      nrrd({"data file:"}, IsInvalid, "does not name the file of its voxels"),
      nrrd({"data file: voxels.raw"}, IsInvalid, "voxels.raw\" is cut off", "short"),
  };
}

inline BadFile meta(const std::vector<std::string>& changes, ExitCode code,
                    const std::string& cause, const std::string& data = "") {
  return {"a  \xc3\xa4.mha", metaBytes(changes), code, cause, data};
}

inline std::vector<BadFile> badMetaImages() {
  const std::string zlib = packed(smallBytes(), false);
  return {
      {"a.mha", "", IsInvalid, "is empty"},
      {"a.mha", "something = else", IsInvalid, "is damaged or no MetaImage"},
      {"a.mhd", metaBytes({"ElementDataFile"}, ""), IsInvalid, "no ElementDataFile"},
      {"a.mha", cut(metaBytes(), 2), IsInvalid, "but only 46 are there"},
      {"a.mha", metaBytes() + "\n", IsInvalid, "holds more than its header says"},
      {"a.mha", metaBytes({"CompressedData = True"}, cut(zlib, 9)), IsInvalid, "break off"},
      {"a.mha", metaBytes({"CompressedData = True"}, zlib + "x"), IsInvalid, "holds more"},
      {"a.mha", metaBytes({"CompressedData = True", "CompressedDataSize = 4000"}, zlib), IsInvalid,
       "its header says 4000 compressed bytes"},
      {"a.mha", metaBytes({"CompressedData = True"}, cut(zlib, 1) + "\x7f"), IsInvalid,
       "incorrect data check"},
      {"a.mha", metaBytes({"CompressedData = True"}, "plain voxels"), IsInvalid,
       "incorrect header check"},
      meta({"no key"}, IsInvalid, "line 13: \"key = value\" was expected"),
      meta({"ObjectType = Tube"}, IsUnsupported, "object of type \"Tube\""),
      meta({"BinaryData = False"}, IsUnsupported, "its voxels as text"),
      meta({"ElementNumberOfChannels = 3"}, IsUnsupported, "3 values to a voxel"),
      meta({"ElementType = MET_SHORT_ARRAY"}, IsUnsupported, "holds vectors"),
      meta({"ElementType = MET_OTHER"}, IsInvalid, "ElementType = \"MET_OTHER\""),
      meta({"NDims = 2", "DimSize = 4 3"}, IsUnsupported, "a picture of 4 x 3"),
      meta({"NDims = 2"}, IsInvalid, "DimSize = \"4 3 2\" but NDims = 2"),
      meta({"NDims = 0"}, IsInvalid, "NDims = 0"),
      meta({"NDims"}, IsInvalid, "NDims = \"\""),
      meta({"NDims = 4", "DimSize = 4 3 2 7"}, IsUnsupported, "several to a voxel (4-D"),
      meta({"DimSize = 4 3 0"}, IsInvalid, "4 x 3 x 0 voxels"),
      meta({"DimSize = 4 3 1"}, IsUnsupported, "a single slice"),
      meta({"DimSize = 4 3 2.5"}, IsInvalid, "DimSize = \"2.5\""),
      meta({"DimSize = 2147483648 2 2"}, IsInvalid, "more than any scanner makes"),
      meta({"Offset = 1e30 0 0"}, IsInvalid, "more than 100 m away"),
      meta({"ElementSpacing = 1 2 -3"}, IsInvalid, "1, 2 and -3 mm apart"),
      meta({"ElementSpacing = 1 2 0"}, IsInvalid, "must be positive numbers"),
      meta({"ElementSpacing = 1 2 nan"}, IsInvalid, "must be positive numbers"),
      meta({"ElementSpacing"}, IsInvalid, "add ElementSpacing"),
      meta({"TransformMatrix = 1 0 0 0 1 0 1 1 0"}, IsInvalid, "axes that lie in one plane"),
      meta({"TransformMatrix = 1 0 0 0"}, IsInvalid, "it needs 9 numbers"),
      meta({"Offset = 1 2 inf"}, IsInvalid, "position or direction that is no number"),
      meta({"Offset = here"}, IsInvalid, "Offset = \"here\"; it needs 3 numbers"),
      meta({"DistanceUnits = ft"}, IsUnsupported, "measures in \"ft\""),
      meta({"ElementToIntensityFunctionSlope = 0"}, IsInvalid, "a slope of 0"),
      meta({"HeaderSize = -4"}, IsInvalid, "HeaderSize = -4"),
      meta({"CompressedData = True", "HeaderSize = -1"}, IsUnsupported, "HeaderSize = -1"),
      meta({"ElementDataFile = none.raw"}, IsMissing, "none.raw\", which is not there"),
      meta({"ElementDataFile = ../../voxels.raw"}, IsInvalid, "only a plain name"),
      meta({"ElementDataFile = C:\\voxels.raw"}, IsInvalid, "only a plain name"),
      meta({"ElementDataFile = LIST"}, IsUnsupported, "several files"),
      meta({"ElementDataFile = s%d.raw 1 9 1"}, IsUnsupported, "several files"),
      meta({"ElementDataFile = voxels.raw"}, IsInvalid, "voxels.raw\" holds more",
           smallBytes() + "x"),
  };
}

}  // namespace pneuma::testing
