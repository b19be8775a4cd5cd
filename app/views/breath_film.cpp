#include "views/breath_film.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/movie.h"
#include "views/breath_pictures.h"

namespace pneuma {
namespace {

constexpr int FilmWidth = 800;
constexpr int FilmHeight = 600;

}  // namespace

int filmPictures(const BreathingLungs& lungs) {
  return static_cast<int>(std::lround(std::max(FilmRate * lungs.drive.period, 1.0)));
}

std::string breathFilm(const BreathingLungs& lungs, ViewDirection view, const Progress& progress) {
  const int count = filmPictures(lungs);
  std::vector<BreathFrame> moments;
  for (int n = 0; n < count; ++n) {
    moments.push_back(frameAt(lungs, static_cast<double>(n) / count));
  }
  BreathLook look;
  look.view = view;
  look.width = FilmWidth;
  look.height = FilmHeight;
  Movie movie(FilmRate);
  drawBreath(
      lungs, moments, look, [&](int, const Picture& picture) { movie.add(picture); }, progress);
  return movie.finish();
}

}  // namespace pneuma
