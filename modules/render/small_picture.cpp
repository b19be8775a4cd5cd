#include "render/small_picture.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace pneuma {

Picture fitted(const Picture& picture, int edge) {
  const int longer = std::max(picture.width, picture.height);
  if (longer <= edge) return picture;
  const auto side = [&](int pixels) {
    return std::max(1, static_cast<int>(std::lround(static_cast<double>(pixels) * edge / longer)));
  };
  Picture small{side(picture.width), side(picture.height), {}};
  small.rgb.resize(static_cast<std::size_t>(small.width) * static_cast<std::size_t>(small.height) *
                   3);
  // OpenCV has no view of what may not be changed; it only reads.
  const cv::Mat from(picture.height, picture.width, CV_8UC3,
                     const_cast<std::uint8_t*>(picture.rgb.data()));
  cv::Mat to(small.height, small.width, CV_8UC3, small.rgb.data());
  cv::resize(from, to, to.size(), 0.0, 0.0, cv::INTER_AREA);
  return small;
}

}  // namespace pneuma
