#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pneuma {

/// Something of several that are opened together.
struct Block {
  std::string name;
  std::vector<std::filesystem::path> files;  ///< relative to the folder of the .vtm; its pieces
};

/// Writes a VTK multi-block file (.vtm) that names others: ParaView opens all of them with it.
/// @throws OutputFailed
void writeMultiblock(const std::filesystem::path& path, const std::vector<Block>& blocks);

/// One file of a series, at a moment.
struct TimedFile {
  double seconds = 0.0;
  int part = 0;                ///< files of one moment have different parts
  std::filesystem::path file;  ///< relative to the folder of the .pvd
};

/// Writes a ParaView collection (.pvd) of files at moments in seconds.
/// @throws OutputFailed
void writeTimeCollection(const std::filesystem::path& path, const std::vector<TimedFile>& files);

/// Reads a ParaView collection (.pvd): the files of every moment, moments in rising order. Nothing
/// of the files themselves is looked at.
/// @throws InputMissing; InvalidInput if it is no collection, names no file, or names one that lies
/// outside its own folder
std::vector<TimedFile> readTimeCollection(const std::filesystem::path& path);

/// Writes a VTK file series (.vtp.series) of the files of one part.
/// @throws OutputFailed
void writeFileSeries(const std::filesystem::path& path, const std::vector<TimedFile>& files,
                     int part);

}  // namespace pneuma
