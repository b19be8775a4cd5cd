#pragma once

#include <QString>
#include <filesystem>
#include <string_view>
#include <vector>

#include "core/image.h"

/// Numbers and names as the window spells them; the same everywhere, whatever the system's locale.
namespace pneuma {

/// 29953 -> "29,953"
QString grouped(std::size_t count);

/// 12.345, 1, "mm" -> "12.3 mm"; thousands are grouped.
QString withUnit(double value, int decimals, const char* unit);

/// "1 branch", "29,953 branches"
QString counted(std::size_t count, const char* one, const char* many);

QString qtText(std::string_view utf8);

/// "512 × 512 × 133"
QString sizeText(const ImageGeometry& geometry);

/// "right upper lobe" -> "Right upper lobe"
QString capitalised(std::string_view words);

/// A built-in organ's name for people: "right-lung" -> "Right lung"
QString organTitle(std::string_view name);

/// The last part of a path only: folders often carry a patient's name.
QString fileNameOf(const std::filesystem::path& path);

/// A sentence with options of the command line in brackets, "(--fill-gaps)", that says of which
/// command they are.
QString withCommands(QString sentence);

/// A sentence about files, with the folders of `paths`, and those among them, left out.
QString withoutFolders(QString sentence, const std::vector<std::filesystem::path>& paths);

}  // namespace pneuma
