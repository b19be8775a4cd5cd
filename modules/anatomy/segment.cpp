#include "anatomy/segment.h"

#include <algorithm>
#include <array>

namespace pneuma {
namespace {

constexpr std::array<Segment, 18> Segments = {{
    {1, "RB1", "apical segment of the right upper lobe", Lobe::RightUpper},
    {2, "RB2", "posterior segment of the right upper lobe", Lobe::RightUpper},
    {3, "RB3", "anterior segment of the right upper lobe", Lobe::RightUpper},
    {4, "RB4", "lateral segment of the right middle lobe", Lobe::RightMiddle},
    {5, "RB5", "medial segment of the right middle lobe", Lobe::RightMiddle},
    {6, "RB6", "superior segment of the right lower lobe", Lobe::RightLower},
    {7, "RB7", "medial basal segment of the right lower lobe", Lobe::RightLower},
    {8, "RB8", "anterior basal segment of the right lower lobe", Lobe::RightLower},
    {9, "RB9", "lateral basal segment of the right lower lobe", Lobe::RightLower},
    {10, "RB10", "posterior basal segment of the right lower lobe", Lobe::RightLower},
    {11, "LB1+2", "apicoposterior segment of the left upper lobe", Lobe::LeftUpper},
    {13, "LB3", "anterior segment of the left upper lobe", Lobe::LeftUpper},
    {14, "LB4", "superior lingular segment of the left upper lobe", Lobe::LeftUpper},
    {15, "LB5", "inferior lingular segment of the left upper lobe", Lobe::LeftUpper},
    {16, "LB6", "superior segment of the left lower lobe", Lobe::LeftLower},
    {18, "LB8", "anteromedial basal segment of the left lower lobe", Lobe::LeftLower},
    {19, "LB9", "lateral basal segment of the left lower lobe", Lobe::LeftLower},
    {20, "LB10", "posterior basal segment of the left lower lobe", Lobe::LeftLower},
}};

}  // namespace

std::span<const Segment> segments() { return Segments; }

std::string_view segmentName(std::uint8_t number) {
  const auto* found = std::ranges::find(Segments, number, &Segment::number);
  return found == Segments.end() ? std::string_view() : found->name;
}

std::optional<std::uint8_t> segmentOfName(std::string_view name) {
  const auto* found = std::ranges::find(Segments, name, &Segment::name);
  if (found == Segments.end()) return std::nullopt;
  return found->number;
}

}  // namespace pneuma
