#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <string>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include "core/error.h"
#include "core/memory.h"
#include "render/picture.h"
#include "render/picture_data.h"
#include "render/small_picture.h"
#include "render/vtk_messages.h"

namespace pneuma {
namespace {

constexpr std::uintmax_t LargestFile = 512U << 20;
constexpr std::array<unsigned char, 8> Signature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

std::uint32_t bigEndian(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = (value << 8) | static_cast<unsigned char>(bytes[i]);
  return value;
}

/// CRC-32 as PNG prescribes it (ISO 3309).
std::uint32_t checksum(const char* bytes, std::size_t count) {
  std::uint32_t crc = 0xffffffffU;
  for (std::size_t i = 0; i < count; ++i) {
    crc ^= static_cast<unsigned char>(bytes[i]);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
  }
  return ~crc;
}

/// What a header (IHDR) states.
struct PngHeader {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  unsigned char bits = 0;  ///< of a channel
};

/// Walks through the chunks, so that the reader behind never sees a damaged file: it would print
/// to the terminal and return what it had.
/// @return what is wrong, or "" if nothing is
std::string damage(const std::string& file, std::uint32_t largestSide, PngHeader& header) {
  if (file.size() < Signature.size() ||
      std::memcmp(file.data(), Signature.data(), Signature.size()) != 0) {
    return "it is not a PNG file";
  }
  bool first = true;
  for (std::size_t at = Signature.size();;) {
    if (file.size() - at < 12) return "it ends too early";
    const std::size_t length = bigEndian(file.data() + at);
    if (length > file.size() - at - 12) return "it ends too early";
    const std::string_view kind(file.data() + at + 4, 4);
    if (checksum(file.data() + at + 4, length + 4) != bigEndian(file.data() + at + 8 + length)) {
      return "a part of it is damaged (checksum)";
    }
    if (first) {
      if (kind != "IHDR" || length != 13) return "it has no header";
      header.width = bigEndian(file.data() + at + 8);
      header.height = bigEndian(file.data() + at + 12);
      header.bits = static_cast<unsigned char>(file[at + 16]);
      if (header.width == 0 || header.height == 0 || header.width > largestSide ||
          header.height > largestSide) {
        return "it says it is " + std::to_string(header.width) + "x" +
               std::to_string(header.height) + " pixels, and 1 to " + std::to_string(largestSide) +
               " a side are read";
      }
      first = false;
    }
    if (kind == "IEND") return {};
    at += length + 12;
  }
}

/// @throws Error (OutOfMemory) if the decoded picture would not fit
void requireRoom(const PngHeader& header, const std::string& name) {
  constexpr std::uint64_t Channels = 4;
  const std::uint64_t pixels = std::uint64_t{header.width} * header.height;
  // What VTK decodes, and the picture that is made of it.
  const std::uint64_t bytes = pixels * (Channels * (header.bits > 8 ? 2 : 1) + 3);
  const std::uint64_t available = availableMemoryBytes();
  if (available == 0 || bytes <= available) return;
  throw Error(ExitCode::OutOfMemory, name + " takes " + std::to_string(bytes >> 20) +
                                         " MB of memory, but " + std::to_string(available >> 20) +
                                         " MB are free; " + adviceForMemory());
}

std::string contentOf(const std::filesystem::path& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  const auto throwMissing = [&path] {
    throw InputMissing("the picture '" + path.string() + "' cannot be read; check its name");
  };
  if (error) throwMissing();  // before it is opened: a pipe would wait for somebody who writes
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throwMissing();
  if (size > LargestFile) {
    throw InvalidInput("the picture '" + path.string() + "' is larger than 512 MB");
  }
  std::string content(static_cast<std::size_t>(size), '\0');
  stream.read(content.data(), static_cast<std::streamsize>(size));
  content.resize(static_cast<std::size_t>(stream.gcount()));
  return content;
}

}  // namespace

Picture readPng(const std::filesystem::path& path) {
  return pngPicture(contentOf(path), "the picture '" + path.string() + "'");
}

Picture pngPicture(const std::string& content, const std::string& name, int largestSide) {
  const auto throwDamaged = [&](const std::string& what) {
    throw InvalidInput(name + " cannot be used: " + what);
  };
  PngHeader header;
  const std::string what = damage(content, static_cast<std::uint32_t>(largestSide), header);
  if (!what.empty()) throwDamaged(what);
  requireRoom(header, name);
  VtkMessages messages;
  vtkNew<vtkPNGReader> reader;
  reader->SetMemoryBuffer(content.data());
  reader->SetMemoryBufferLength(static_cast<vtkIdType>(content.size()));
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  const int* size = image->GetDimensions();
  const int type = image->GetScalarType();
  if (!messages.firstError().empty() || image->GetScalarPointer() == nullptr ||
      (type != VTK_UNSIGNED_CHAR && type != VTK_UNSIGNED_SHORT)) {
    throwDamaged("its pixels cannot be decoded");
  }
  Picture picture{size[0], size[1], {}};
  picture.rgb.reserve(static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) * 3);
  const bool grey = image->GetNumberOfScalarComponents() < 3;
  const double toByte = type == VTK_UNSIGNED_SHORT ? 1.0 / 257.0 : 1.0;
  for (int row = size[1] - 1; row >= 0; --row) {
    for (int column = 0; column < size[0]; ++column) {
      for (int channel = 0; channel < 3; ++channel) {
        const double value =
            image->GetScalarComponentAsDouble(column, row, 0, grey ? 0 : channel) * toByte;
        picture.rgb.push_back(static_cast<std::uint8_t>(value + 0.5));
      }
    }
  }
  return picture;
}

std::string pngText(const Picture& picture) {
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(imageDataOf(picture));
  writer->WriteToMemoryOn();
  constexpr int SmallPicture = 1'000'000;  // pixels; beyond, the last percent takes seconds
  writer->SetCompressionLevel(picture.width * picture.height <= SmallPicture ? 9 : 6);
  writer->Write();
  vtkUnsignedCharArray* result = writer->GetResult();
  if (writer->GetErrorCode() != 0 || result == nullptr) {
    throw OutputFailed("the picture cannot be packed as PNG; is there enough memory?");
  }
  return {reinterpret_cast<const char*>(result->GetPointer(0)),
          static_cast<std::size_t>(result->GetNumberOfValues())};
}

}  // namespace pneuma
