#include "lobes/detail/sentence_text.h"

#include <cmath>

namespace pneuma {

std::string lengthText(double mm) {
  std::string text = std::to_string(std::lround(10.0 * mm));
  const bool minus = text.front() == '-';
  if (minus) text.erase(0, 1);
  if (text.size() < 2) text.insert(0, "0");
  text.insert(text.size() - 1, ".");
  return (minus ? "-" : "") + text + " mm";
}

std::string placeText(const Vec3& p) {
  std::string text = "(";
  for (const double coordinate : p) {
    text += (text.size() > 1 ? ", " : "") + std::to_string(std::lround(coordinate));
  }
  return text + ") mm";
}

}  // namespace pneuma
