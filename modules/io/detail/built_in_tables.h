#pragma once

#include <string_view>

/// Files of the folder resources, built into the program (cmake/EmbedText.cmake).
namespace pneuma::detail {

extern const std::string_view ThoraxAirwayTable;  ///< resources/airways/thorax.json

}  // namespace pneuma::detail
