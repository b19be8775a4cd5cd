#pragma once

#include <nlohmann/json.hpp>

#include "core/options.h"

namespace pneuma {

/// JSON with the order of keys kept.
using Json = nlohmann::ordered_json;

/// The options as {"name": value, ...} in the order of their fields.
template <HasFields Options>
Json toJson(const Options& options) {
  Json json = Json::object();
  forEachField<Options>([&](const auto& field) {
    using Value = typename std::remove_cvref_t<decltype(field)>::value_type;
    if constexpr (std::is_enum_v<Value>) {
      json[std::string(field.name)] = textOf(options.*(field.member));
    } else {
      json[std::string(field.name)] = options.*(field.member);
    }
  });
  return json;
}

}  // namespace pneuma
