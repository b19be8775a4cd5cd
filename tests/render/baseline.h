#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "render/picture.h"

namespace pneuma::test {

inline void writePicture(const std::filesystem::path& path, const Picture& picture) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << pngText(picture);
}

/// Fails where a picture does not look like its baseline, and leaves both and their difference.
inline void expectLikeBaseline(const Picture& picture, const std::string& name) {
  constexpr double Threshold = 0.03;
  const std::filesystem::path baseline = std::filesystem::path(PNEUMA_BASELINES) / (name + ".png");
  if (std::getenv("PNEUMA_UPDATE_BASELINES") != nullptr) writePicture(baseline, picture);
  const PictureDifference difference = compare(picture, readPng(baseline));
  EXPECT_LT(difference.error, Threshold);
  if (difference.error >= Threshold) {
    const std::filesystem::path folder(PNEUMA_IMAGE_OUTPUT);
    writePicture(folder / (name + ".actual.png"), picture);
    writePicture(folder / (name + ".diff.png"), difference.difference);
    ADD_FAILURE() << "see " << folder / name << ".actual.png and .diff.png; if it is right, "
                  << "run again with PNEUMA_UPDATE_BASELINES=1";
  }
}

}  // namespace pneuma::test
