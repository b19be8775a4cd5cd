#include <algorithm>
#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/quality/qualityssim.hpp>

#include "core/error.h"
#include "render/picture.h"

namespace pneuma {
namespace {

constexpr double SmoothingSigma = 1.0;  // pixels; takes out grain and where an edge falls
constexpr double ForegroundContrast =
    4.0;  // of Lab units within a window: something is drawn there
constexpr double WorstShare = 0.05;
constexpr double WorstWeight = 0.15;
constexpr double FullColourDifference = 20.0;  // Lab units that count as "nothing in common"
constexpr int WindowSide = 11;                 // as OpenCV's SSIM
constexpr double WindowSigma = 1.5;

/// The picture in Lab, scaled to 0 .. 255 as SSIM's constants expect, slightly smoothed.
cv::Mat scaledLab(const Picture& picture) {
  const cv::Mat bytes(picture.height, picture.width, CV_8UC3,
                      const_cast<std::uint8_t*>(picture.rgb.data()));
  cv::Mat lab;
  bytes.convertTo(lab, CV_32FC3, 1.0 / 255.0);
  cv::cvtColor(lab, lab, cv::COLOR_RGB2Lab);
  cv::GaussianBlur(lab, lab, cv::Size(), SmoothingSigma, SmoothingSigma, cv::BORDER_REPLICATE);
  std::vector<cv::Mat> channels;
  cv::split(lab, channels);
  channels[0] *= 2.55;
  channels[1] += 128.0;
  channels[2] += 128.0;
  cv::merge(channels, lab);
  return lab;
}

cv::Mat windowMeans(const cv::Mat& image) {
  cv::Mat means;
  cv::GaussianBlur(image, means, cv::Size(WindowSide, WindowSide), WindowSigma, WindowSigma,
                   cv::BORDER_REPLICATE);
  return means;
}

/// Largest of the three channels, pixel by pixel.
cv::Mat largestChannel(const cv::Mat& image) {
  std::vector<cv::Mat> channels;
  cv::split(image, channels);
  return cv::max(cv::max(channels[0], channels[1]), channels[2]);
}

/// True where either picture shows something: windows whose content varies.
cv::Mat foreground(const cv::Mat& a, const cv::Mat& b) {
  const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_ELLIPSE, {WindowSide, WindowSide});
  cv::Mat mask = cv::Mat::zeros(a.size(), CV_8U);
  for (const cv::Mat& image : {a, b}) {
    cv::Mat contrast;
    cv::morphologyEx(image, contrast, cv::MORPH_GRADIENT, kernel);
    mask |= largestChannel(contrast) > ForegroundContrast;
  }
  return mask;
}

std::vector<float> valuesIn(const cv::Mat& map, const cv::Mat& mask) {
  std::vector<float> values;
  for (int y = 0; y < map.rows; ++y) {
    for (int x = 0; x < map.cols; ++x) {
      if (mask.at<std::uint8_t>(y, x) != 0) values.push_back(map.at<float>(y, x));
    }
  }
  return values;
}

double mean(const std::vector<float>& values, std::size_t first) {
  double sum = 0.0;
  for (std::size_t i = first; i < values.size(); ++i) sum += values[i];
  return values.size() > first ? sum / static_cast<double>(values.size() - first) : 0.0;
}

Picture heatPicture(const cv::Mat& error) {
  cv::Mat bytes;
  error.convertTo(bytes, CV_8U, 255.0);
  Picture picture{error.cols, error.rows, {}};
  picture.rgb.reserve(static_cast<std::size_t>(error.cols) * static_cast<std::size_t>(error.rows) *
                      3);
  for (int y = 0; y < bytes.rows; ++y) {
    for (int x = 0; x < bytes.cols; ++x) {
      picture.rgb.insert(picture.rgb.end(), 3, bytes.at<std::uint8_t>(y, x));
    }
  }
  return picture;
}

}  // namespace

PictureDifference compare(const Picture& picture, const Picture& reference) {
  if (picture.width != reference.width || picture.height != reference.height ||
      picture.rgb.empty()) {
    throw InvalidInput("the pictures cannot be compared: one is " + std::to_string(picture.width) +
                       "x" + std::to_string(picture.height) + " pixels, the other " +
                       std::to_string(reference.width) + "x" + std::to_string(reference.height));
  }
  const cv::Mat a = scaledLab(picture);
  const cv::Mat b = scaledLab(reference);
  cv::Mat similarity;
  cv::quality::QualitySSIM::compute(b, a, similarity);
  cv::Mat structure = cv::Scalar::all(1.0) - similarity;
  structure = cv::max(cv::min(largestChannel(structure), 1.0), 0.0);
  structure.convertTo(structure, CV_32F);

  // SSIM compares the pattern of windows and hardly their level; a veil that is a little thicker
  // everywhere shows in the windows' mean colours.
  cv::Mat difference;
  cv::absdiff(windowMeans(a), windowMeans(b), difference);
  cv::Mat colour = cv::min(largestChannel(difference) / FullColourDifference, 1.0);

  const cv::Mat mask = foreground(a, b);
  std::vector<float> structures = valuesIn(structure, mask);
  const std::vector<float> colours = valuesIn(colour, mask);
  std::sort(structures.begin(), structures.end());
  const std::size_t worst =
      structures.size() -
      static_cast<std::size_t>(WorstShare * static_cast<double>(structures.size()));
  PictureDifference result;
  result.error =
      std::max({mean(structures, 0), WorstWeight * mean(structures, worst), mean(colours, 0)});
  result.difference = heatPicture(cv::max(structure, colour));
  return result;
}

}  // namespace pneuma
