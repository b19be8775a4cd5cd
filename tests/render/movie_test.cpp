#include "render/movie.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <opencv2/videoio.hpp>
#include <unistd.h>

#include "core/error.h"

namespace pneuma {
namespace {

constexpr int FilmWidth = 150;  // no multiple of 16, which the codec's blocks are
constexpr int FilmHeight = 90;

/// Grey on the left, one colour on the right, in the upper half brighter.
Picture moment(int n) {
  Picture picture{FilmWidth, FilmHeight, {}};
  for (int y = 0; y < FilmHeight; ++y) {
    for (int x = 0; x < FilmWidth; ++x) {
      const int level = y < FilmHeight / 2 ? 200 : 80;
      const bool grey = x < FilmWidth / 2;
      picture.rgb.push_back(static_cast<std::uint8_t>(level));
      picture.rgb.push_back(static_cast<std::uint8_t>(grey ? level : 20 * n));
      picture.rgb.push_back(static_cast<std::uint8_t>(grey ? level : 0));
    }
  }
  return picture;
}

/// What another library decodes of the film.
std::vector<cv::Mat> framesOf(const std::string& film) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                     ("pneuma_movie_test_" + std::to_string(::getpid()) + ".ogv");
  std::ofstream(path, std::ios::binary) << film;
  cv::VideoCapture capture(path.string());
  EXPECT_NEAR(capture.get(cv::CAP_PROP_FPS), 20.0, 0.01);
  std::vector<cv::Mat> frames;
  for (cv::Mat frame; capture.read(frame);) frames.push_back(frame.clone());
  std::filesystem::remove(path);
  return frames;
}

TEST(Movie, HoldsEveryPictureInOrderAndUpright) {
  Movie movie(20);
  for (int n = 0; n < 10; ++n) movie.add(moment(n));
  const std::vector<cv::Mat> frames = framesOf(movie.finish());
  ASSERT_EQ(frames.size(), 10U);
  for (int n = 0; n < 10; ++n) {
    const cv::Mat& frame = frames[static_cast<std::size_t>(n)];
    ASSERT_EQ(frame.cols, FilmWidth);
    ASSERT_EQ(frame.rows, FilmHeight);
    for (const auto& [x, y] : {std::pair{20, 20}, {20, 70}, {130, 20}, {130, 70}}) {
      const auto pixel = frame.at<cv::Vec3b>(y, x);  // blue, green, red
      const std::size_t at = 3 * static_cast<std::size_t>(y * FilmWidth + x);
      const Picture truth = moment(n);
      for (std::size_t channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(pixel[static_cast<int>(2 - channel)], truth.rgb[at + channel], 12)
            << "frame " << n << " at " << x << ", " << y << ", channel " << channel;
      }
    }
  }
}

TEST(Movie, IsTheSameEveryTime) {
  std::string first;
  for (int round = 0; round < 2; ++round) {
    Movie movie(20);
    for (int n = 0; n < 3; ++n) movie.add(moment(n));
    const std::string film = movie.finish();
    if (round == 0) first = film;
    EXPECT_EQ(film, first);
    // The number of the stream (RFC 3533), of which VTK takes another in every run.
    EXPECT_EQ(film.substr(14, 4), std::string("\1\0\0\0", 4));
  }
}

TEST(Movie, RefusesWhatIsNoFilm) {
  EXPECT_THROW(Movie(0), InvalidOption);
  EXPECT_THROW(Movie(121), InvalidOption);
  Movie movie(25);
  EXPECT_THROW(movie.finish(), InvalidInput);
  movie.add(moment(0));
  EXPECT_THROW(movie.add(Picture{2, 1, std::vector<std::uint8_t>(6)}), InvalidInput);
}

}  // namespace
}  // namespace pneuma
