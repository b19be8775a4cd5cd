#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/progress.h"
#include "io/head_pose_file.h"
#include "io/json.h"
#include "pipeline/lung_model.h"
#include "render/head_view.h"
#include "render/movie.h"
#include "render/pose_replay.h"

namespace pneuma::cli {

/// A replay of head poses as somebody beside the display would film it: at each moment of the film
/// the picture that was finished last by then.
class ReplayFilm {
 public:
  /// @param rate of the replay; the film has the nearest whole number of pictures a second
  explicit ReplayFilm(double rate);

  /// @param finished since the replay's start, s; rises from picture to picture
  void add(Picture picture, double finished);

  /// The film's file content; nothing may follow. @throws InvalidInput without any picture
  std::string finish();

  int rate() const { return rate_; }

  std::size_t pictures() const { return pictures_; }

 private:
  int rate_;
  Movie movie_;
  Picture shown_;
  std::size_t pictures_ = 0;
};

struct ReplayedHead {
  PoseReplay replay;
  Picture last;
};

/// Replays head poses in real time, drawing each offscreen. The first is drawn once before the
/// clock starts, as what is drawn first goes to the graphics card; the clock stands while a picture
/// is put into the film.
/// @param showAt puts into the scene what it shows at a time since the replay's start, s; part of
/// drawing
/// @param film may be null
/// @throws NoRendering, Cancelled, what showAt throws
ReplayedHead replayHead(HeadView& view, const std::vector<HeadPose>& poses, double rate,
                        const std::function<void(double seconds)>& showAt, ReplayFilm* film,
                        const Progress& progress);

/// "pneuma/replay/1", resources/schemas/replay.schema.json.
Json replayReport(const PoseReplay& replay, double rate, const std::vector<InputFile>& inputs,
                  Json parameters);

/// The report for people.
std::string replayText(const Json& report);

}  // namespace pneuma::cli
