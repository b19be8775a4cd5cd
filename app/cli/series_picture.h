#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "core/progress.h"
#include "pipeline/lung_model.h"
#include "render/scene.h"

namespace pneuma::cli {

/// One moment of a collection (.pvd), as `pneuma breathe` writes it.
struct SeriesMoment {
  double seconds = 0.0;
  std::vector<std::filesystem::path> files;
  std::vector<std::filesystem::path> chestWalls;  ///< around a lung with a pneumothorax
};

/// The moments of a breath. A collection ends with its first moment again, one period later, which
/// is not among them.
struct Series {
  std::vector<SeriesMoment> moments;
  double periodSeconds = 0.0;  ///< of one breath; 0 if there is a single moment

  /// The place of the moment nearest to a time.
  std::size_t nearestTo(double seconds) const;

  /// The place of the moment nearest to a time of breath after breath.
  std::size_t nearestInBreaths(double seconds) const;

  /// Moments a second as they were, 1 .. 120.
  int rate() const;
};

bool isSeries(const std::filesystem::path& path);

/// @throws InputMissing, InvalidInput; Unsupported of frames in pieces
Series readSeries(const std::filesystem::path& pvd);

/// What the files of a moment hold, unexamined: all moments have the triangles of the first, and to
/// look for some that cut each other takes longer than to draw them. Surfaces come as the lobes
/// that their triangles name.
/// @throws InputMissing, InvalidInput
LungModel openMoment(const SeriesMoment& moment);

/// Opens the moments one after the other and draws each by `draw`, all from one place from which
/// the largest is seen whole.
/// @param show puts a model into the scene
/// @param draw may throw
void drawSeries(const std::vector<SeriesMoment>& moments, Scene& scene, ViewDirection view,
                const std::function<void(const LungModel& model)>& show,
                const std::function<void()>& draw, const Progress& progress);

}  // namespace pneuma::cli
