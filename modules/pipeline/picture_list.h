#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pneuma {

/// How different from its reference a picture may look, unless a looser limit is given with a
/// reason: compare() of render/picture.h calls more than this different.
inline constexpr double UsualPictureLimit = 0.03;

/// What a folder of pictures that are drawn again is listed in.
inline constexpr const char* PictureListFile = "pictures.json";

/// One picture of a list. Paths are relative to the list's folder.
struct ListedPicture {
  std::string name;  ///< letters, digits, '-', '_', '.': files are called so
  std::vector<std::filesystem::path> inputs;
  std::vector<std::string> options;  ///< as `pneuma render` takes them, word by word
  std::filesystem::path ready;       ///< a picture that is there already; empty: it is drawn
  std::filesystem::path reference;
  double limit = UsualPictureLimit;
  std::string reason;  ///< why the limit is looser than usual
};

/// Pictures that are drawn again and compared ("pneuma/pictures/1",
/// resources/schemas/pictures.schema.json).
struct PictureList {
  std::filesystem::path folder;
  std::filesystem::path file;
  std::string size;  ///< "WIDTHxHEIGHT" of all that do not say otherwise; empty: as `render` has it
  std::vector<ListedPicture> pictures;
};

/// Reads FOLDER/pictures.json, or another list of that form.
/// @param path a folder or a list, whose folder is the one it lies in
/// @throws InputMissing if it is not there; InvalidInput naming the picture and what is wrong:
/// unknown keys, names that are no names or come twice, paths that leave the folder, a looser limit
/// without a reason, no picture at all
PictureList readPictureList(const std::filesystem::path& path);

/// A path of the list as a path of ours.
/// @param picture whose it is, for the message
/// @throws InvalidInput if it is absolute or goes up: a list stays in its folder
std::filesystem::path pathInFolder(const PictureList& list, const std::string& picture,
                                   const std::filesystem::path& path);

}  // namespace pneuma
