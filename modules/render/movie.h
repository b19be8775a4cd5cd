#pragma once

#include <memory>
#include <string>

#include "render/picture.h"

namespace pneuma {

/// Pictures of one size as a film without sound: Theora in Ogg (.ogv), which browsers, VLC and mpv
/// play.
class Movie {
 public:
  /// @param framesPerSecond 1 .. 120
  /// @throws InvalidOption for another rate
  explicit Movie(int framesPerSecond);
  ~Movie();
  Movie(const Movie&) = delete;
  Movie& operator=(const Movie&) = delete;

  /// Appends a picture. @throws InvalidInput if it has another size than the first; OutputFailed if
  /// there is no room for temporary files
  void add(const Picture& picture);

  /// The film's file content; nothing may follow. @throws InvalidInput without any picture
  std::string finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pneuma
