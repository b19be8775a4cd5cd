#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "render/scene.h"

namespace pneuma {

/// An RGB picture, 8 bits a channel, row by row from the top.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  ///< width * height * 3
};

/// True if offscreen rendering can work here: an X display that answers and has OpenGL.
bool canRender();

/// Renders a scene offscreen; it goes back to its window afterwards. Pictures up to 2.1 megapixels
/// are drawn at twice the size and averaged. @param width, height in pixels, 16 .. 8192
/// @throws InvalidOption for other sizes; NoRendering where there is no display, saying how to get
/// one (xvfb-run)
Picture renderPicture(Scene& scene, int width, int height);

/// @throws InputMissing, InvalidInput
Picture readPng(const std::filesystem::path& path);

/// PNG file content.
std::string pngText(const Picture& picture);

/// Several pictures of one size beside each other, `columns` a row, with captions of one or more
/// lines under them. A caption too wide for its picture is written smaller, then cut in its middle.
/// @param legend stands at the right end of every row, as high as the pictures; may be empty
/// @throws InvalidInput unless there is a caption for each and they have one size
Picture contactSheet(const std::vector<Picture>& pictures, int columns,
                     const std::vector<std::string>& captions, const Picture& legend = {});

/// Pixels between the pictures of tiled().
inline constexpr int TileLine = 2;

/// Pictures of one size in rows of `columns`, a thin line between them; places left over are black.
/// @throws InvalidInput if there is none, or they differ in size
Picture tiled(const std::vector<Picture>& pictures, int columns);

/// How different two pictures look: 0 equal, 1 nothing in common; from 0.03 on they count as
/// different. Both are taken to CIE Lab and smoothed by one pixel against grain. Where either shows
/// something, the error is the largest of
///   - the mean of 1 - SSIM (11 x 11 windows, the worst channel),
///   - 0.15 times its mean over the worst 5 % of the windows,
///   - the mean difference of the windows' colours, with 20 Lab units counting as 1; SSIM hardly
///     notices a veil that is a little thicker everywhere.
struct PictureDifference {
  double error = 0.0;
  Picture difference;  ///< bright where they differ
};

/// @throws InvalidInput if the sizes differ
PictureDifference compare(const Picture& picture, const Picture& reference);

}  // namespace pneuma
