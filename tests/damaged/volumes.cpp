#include <limits>

#include "bytes.h"

/// NIfTI, NRRD and MetaImage.
namespace pneuma::damaged {
namespace {

bool isPacked(const Format& format) { return format.sound->compare(0, 2, "\x1F\x8B") == 0; }

}  // namespace

void damageNifti(Corpus& corpus, const Format& format) {
  const bool packed = isPacked(format);
  const auto add = [&](const std::string& detail, Change change, Wanted wanted = Wanted::Anything) {
    corpus.add(
        format, "nifti", detail,
        [packed, change = std::move(change)](const Bytes& sound) {
          return packed ? gzipped(change(gunzipped(sound))) : change(sound);
        },
        wanted);
  };
  const auto put = [&](const std::string& detail, std::size_t at, const Bytes& part) {
    add(detail, [=](const Bytes& nifti) { return overwritten(nifti, at, part); });
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  put("header-size-0", 0, little(0, 4));
  put("header-size-swapped", 0, little(0x5C010000, 4));
  for (const int count : {0, 1, 2, 4, 7, 8, -1}) {
    put("axes-" + std::to_string(count), 40, little(static_cast<unsigned>(count), 2));
  }
  for (const int size : {0, -1, 1, 4097, 32767, -32768}) {
    put("columns-" + std::to_string(size), 42, little(static_cast<unsigned>(size), 2));
    put("slices-" + std::to_string(size), 46, little(static_cast<unsigned>(size), 2));
  }
  put("all-sizes-32767", 42, little(0x7FFF7FFF7FFFU, 6));
  put("all-sizes-2000", 42, little(0x07D007D007D0U, 6));
  put("five-volumes", 40,
      little(4, 2) + little(0x64, 2) + little(0x64, 2) + little(0x10, 2) + little(5, 2));
  for (const int type : {0, 1, 128, 1792, 9999}) {
    put("values-of-type-" + std::to_string(type), 70, little(static_cast<unsigned>(type), 2));
  }
  put("bits-1", 72, little(1, 2));
  const std::pair<const char*, float> spacings[] = {
      {"0", 0.0F},     {"negative", -5.0F}, {"nan", nan},  {"infinite", infinite},
      {"1e-9", 1e-9F}, {"0.009", 0.009F},   {"21", 21.0F}, {"1e30", 1e30F}};
  for (const auto& [name, spacing] : spacings) {
    // By its own field, and by the rows of the matrix that says the same.
    add(std::string("spacing-") + name, [spacing = spacing](const Bytes& nifti) {
      const Bytes one = overwritten(nifti, 84, floatBytes(spacing));
      return overwritten(one, 280, floatBytes(spacing));
    });
  }
  put("data-begin-nan", 108, floatBytes(nan));
  put("data-begin-negative", 108, floatBytes(-1e9F));
  put("data-begin-far", 108, floatBytes(1e18F));
  put("data-begin-in-header", 108, floatBytes(10.0F));
  put("slope-nan", 112, floatBytes(nan));
  put("slope-1e30", 112, floatBytes(1e30F));
  put("intercept-infinite", 116, floatBytes(infinite));
  put("unit-unknown", 123, little(7, 1));
  put("no-frame", 252, little(0, 4));
  put("frame-9999", 252, little(0x270F270F, 4));
  put("quaternion-nan", 256, floatBytes(nan));
  put("quaternion-long", 256, floatBytes(5.0F));
  put("offset-nan", 292, floatBytes(nan));
  put("offset-1e30", 292, floatBytes(1e30F));
  put("matrix-singular", 280, Bytes(48, '\0'));
  add("matrix-flat", [](const Bytes& nifti) {
    return overwritten(nifti, 312, nifti.substr(280, 16));  // the third row as the first
  });
  put("magic-of-pair", 344, Bytes("ni1\0", 4));
  put("magic-of-second", 344, Bytes("n+2\0", 4));
  put("extension-2-to-31", 348, little(1, 4) + little(0x7FFFFFFF, 4));
  add(
      "header-only", [](const Bytes& nifti) { return nifti.substr(0, 352); }, Wanted::Refused);
  add(
      "one-byte-less", [](const Bytes& nifti) { return nifti.substr(0, nifti.size() - 1); },
      Wanted::Refused);
  if (!packed) return;
  corpus.add(format, "gzip", "a-gigabyte-of-zeros", [](const Bytes& sound) {
    // Members one behind the other are one stream.
    static const Bytes packedZeros = gzipped(Bytes(std::size_t{1} << 26, '\0'));
    return gzipped(overwritten(gunzipped(sound), 42, little(0x040004000400U, 6))) +
           repeated(packedZeros, 16);
  });
  corpus.add(format, "gzip", "twice", [](const Bytes& sound) { return gzipped(sound); });
  corpus.add(
      format, "gzip", "checksum",
      [](const Bytes& sound) { return overwritten(sound, sound.size() - 8, "abcd"); },
      Wanted::Refused);
  corpus.add(
      format, "gzip", "method-9", [](const Bytes& sound) { return overwritten(sound, 2, "\x09"); },
      Wanted::Refused);
  corpus.add(
      format, "gzip", "endless-name",
      [](const Bytes& sound) {
        return sound.substr(0, 3) + "\x08" + sound.substr(4, 6) + Bytes(3000000, 'n');
      },
      Wanted::Refused);
}

void damageHeaderLines(Corpus& corpus, const Format& format) {
  const bool isNrrd = format.sound->compare(0, 4, "NRRD") == 0;
  const auto line = [&](const std::string& detail, const std::string& prefix,
                        const std::string& text) {
    corpus.add(format, isNrrd ? "nrrd" : "meta", detail,
               [=](const Bytes& sound) { return withLine(sound, prefix, text); });
  };
  const std::string is = isNrrd ? ": " : " = ";
  const std::string sizes = isNrrd ? "sizes" : "DimSize";
  const std::string axes = isNrrd ? "dimension" : "NDims";
  const std::string steps = isNrrd ? "space directions" : "ElementSpacing";
  const std::string origin = isNrrd ? "space origin" : "Offset";
  const std::string type = isNrrd ? "type" : "ElementType";
  for (const char* value :
       {"0 0 0", "-1 5 5", "4097 4097 2", "4294967295 4294967295 4294967295", "2147483648 2 2",
        "1000000000000000000 1 1", "nan 5 5", "5 5", "1 5 5", "5 5 5 5", "1e3 5 5",
        "99999999999999999999999 5 5", "2000 2000 2000"}) {
    std::string name = value;
    for (char& c : name) c = c == ' ' ? '_' : c;
    line("sizes-" + name, sizes, sizes + is + value);
  }
  for (const char* value : {"0", "2", "4", "17", "-3", "4294967296", "three"}) {
    line(std::string("axes-") + value, axes, axes + is + value);
  }
  const auto spacing = [&](const std::string& detail, const std::string& x) {
    line("spacing-" + detail, steps,
         isNrrd ? steps + is + "(" + x + ",0,0) (0,5,0) (0,0,10)" : steps + is + x + " 5 10");
  };
  for (const char* value : {"0", "-5", "nan", "inf", "1e-9", "0.009", "21", "1e30", "1e999", "x"}) {
    spacing(value, value);
  }
  line("directions-singular", isNrrd ? steps : "TransformMatrix",
       isNrrd ? "space directions: (5,0,0) (5,0,0) (0,0,10)"
              : "TransformMatrix = 1 0 0 1 0 0 0 0 1");
  line("directions-nan", isNrrd ? steps : "TransformMatrix",
       isNrrd ? "space directions: (5,0,0) (0,nan,0) (0,0,10)"
              : "TransformMatrix = 1 0 0 0 nan 0 0 0 1");
  line("origin-nan", origin, origin + is + (isNrrd ? "(nan,0,0)" : "nan 0 0"));
  line("origin-1e300", origin, origin + is + (isNrrd ? "(1e300,0,0)" : "1e300 0 0"));
  line("origin-short", origin, origin + is + (isNrrd ? "(1,2)" : "1 2"));
  for (const char* field :
       {"sizes", "dimension", "type", "space directions", "encoding", "endian", "space"}) {
    if (isNrrd) line(std::string("without-") + field, std::string(field) + ":", "");
  }
  for (const char* field : {"DimSize", "NDims", "ElementType", "ElementSpacing", "ObjectType",
                            "ElementDataFile", "BinaryDataByteOrderMSB"}) {
    if (!isNrrd) line(std::string("without-") + field, field, "");
  }
  line("sizes-twice", sizes, sizes + is + "5 5 5\n" + sizes + is + "6 6 6");
  line("type-unknown", type, type + is + "quadruple");
  line("type-double", type, type + is + (isNrrd ? "double" : "MET_DOUBLE"));
  line("line-of-1-mb", type, type + is + Bytes(1000000, 's'));
  line("lines-100000", type,
       repeated(isNrrd ? "# x\n" : "X = 1\n", 100000) + type + is +
           (isNrrd ? "short" : "MET_SHORT"));
  const std::string data = isNrrd ? "data file: " : "ElementDataFile = ";
  const std::string place = isNrrd ? "endian" : "ElementDataFile";
  for (const char* file :
       {"../../../etc/passwd", "/dev/zero", "nothing-there.raw", ".", "LIST", "x%03d.raw 1 30 1"}) {
    std::string name = file;
    for (char& c : name) c = c == '/' || c == ' ' ? '_' : c;
    line("data-in-" + name, place, data + file);
  }
  if (isNrrd) {
    line("encoding-bzip2", "encoding", "encoding: bzip2");
    line("encoding-hex", "encoding", "encoding: hex");
    line("encoding-raw", "encoding", "encoding: raw");
    line("encoding-gzip", "encoding", "encoding: gzip");
    line("byte-skip-1e18", "encoding", "encoding: raw\nbyte skip: 1000000000000000000");
    line("byte-skip-minus-1", "encoding", "encoding: raw\nbyte skip: -1");
    line("line-skip-1e9", "encoding", "encoding: raw\nline skip: 1000000000");
  } else {
    line("size-packed-1e18", "CompressedDataSize", "CompressedDataSize = 1000000000000000000");
    line("size-packed-minus-1", "CompressedDataSize", "CompressedDataSize = -1");
    line("packed", "CompressedData ", "CompressedData = True");
    line("not-packed", "CompressedData ", "CompressedData = False");
    line("header-1e18", "NDims", "NDims = 3\nHeaderSize = 1000000000000000000");
  }
}

}  // namespace pneuma::damaged
