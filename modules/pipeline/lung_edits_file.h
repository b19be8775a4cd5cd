#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "pipeline/lung_corrections.h"

namespace pneuma {

/// Reads corrections of lungs ("pneuma/lung-edits/1", resources/schemas/lung-edits.schema.json):
/// {"schema": "pneuma/lung-edits/1", "edits": [
///   {"tool": "paint", "lung": "right", "radius_mm": 5, "points": [[x, y, z], ...]}, ...]},
/// points in mm, LPS. Whether points lie in an image is not looked at.
/// @throws InputMissing, InvalidInput (no JSON, another schema, an unknown word, a value out of
/// range; naming the edit by its number)
std::vector<LungEdit> readLungEdits(const std::filesystem::path& path);

/// Before lungs are looked for, which takes long.
/// @param file that the edits were read from, for the message
/// @throws InvalidInput if an edit cannot be one of this image
void requireWithin(std::span<const LungEdit> edits, const ImageGeometry& geometry,
                   const std::filesystem::path& file);

/// The same as withLungEdits() for edits that were read from a file. @throws likewise, naming it
LungModel withLungEdits(const LungModel& model, std::span<const LungEdit> edits,
                        const std::filesystem::path& file, double thresholdHu,
                        const Progress& progress = {});

/// The same as it stands in a file. Numbers come back to the bit.
std::string lungEditsText(std::span<const LungEdit> edits);

}  // namespace pneuma
