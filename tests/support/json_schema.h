#pragma once

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace pneuma::test {

/// Checks a JSON value against a schema: the part of JSON Schema 2020-12 that ours are written in
/// (type, const, enum, pattern, minimum, required, properties, additionalProperties, items,
/// minItems, and $ref to "#/$defs/..."). A keyword it does not know is an error, not a pass.
class JsonSchema {
 public:
  explicit JsonSchema(nlohmann::json schema) : root_(std::move(schema)) {}

  /// One sentence per fault; empty if `value` is as the schema says.
  std::vector<std::string> faults(const nlohmann::json& value) const {
    std::vector<std::string> found;
    check(value, root_, "$", found);
    return found;
  }

 private:
  using Json = nlohmann::json;
  using Faults = std::vector<std::string>;

  static bool hasType(const Json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "null") return value.is_null();
    if (type == "integer") return value.is_number_integer();
    return type == "number" && value.is_number();
  }

  static bool hasOneType(const Json& value, const Json& types) {
    if (types.is_string()) return hasType(value, types);
    return std::any_of(types.begin(), types.end(),
                       [&](const Json& type) { return hasType(value, type); });
  }

  const Json& resolved(const std::string& reference) const {
    return root_.at(Json::json_pointer(reference.substr(1)));
  }

  void check(const Json& value, const Json& schema, const std::string& path, Faults& faults) const {
    if (schema.is_boolean()) {
      if (!schema.get<bool>()) faults.push_back(path + " must not be there");
      return;
    }
    for (const auto& [keyword, rule] : schema.items()) {
      checkKeyword(value, schema, keyword, rule, path, faults);
    }
  }

  void checkKeyword(const Json& value, const Json& schema, const std::string& keyword,
                    const Json& rule, const std::string& path, Faults& faults) const {
    const auto fault = [&](const std::string& what) {
      faults.push_back(path + " " + what + ", but is " + value.dump().substr(0, 80));
    };
    if (keyword == "$ref") {
      check(value, resolved(rule), path, faults);
    } else if (keyword == "type") {
      if (!hasOneType(value, rule)) fault("must be of type " + rule.dump());
    } else if (keyword == "const") {
      if (value != rule) fault("must be " + rule.dump());
    } else if (keyword == "enum") {
      if (std::find(rule.begin(), rule.end(), value) == rule.end()) {
        fault("must be one of " + rule.dump());
      }
    } else if (keyword == "pattern") {
      if (value.is_string() &&
          !std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>()))) {
        fault("must match " + rule.dump());
      }
    } else if (keyword == "minimum") {
      if (value.is_number() && value.get<double>() < rule.get<double>()) {
        fault("must be at least " + rule.dump());
      }
    } else if (keyword == "required") {
      for (const std::string name : rule) {
        if (value.is_object() && !value.contains(name)) faults.push_back(path + " lacks " + name);
      }
    } else if (keyword == "properties") {
      for (const auto& [name, member] : rule.items()) {
        if (value.is_object() && value.contains(name)) {
          check(value[name], member, path + "." + name, faults);
        }
      }
    } else if (keyword == "additionalProperties") {
      checkOthers(value, schema, rule, path, faults);
    } else if (keyword == "items") {
      for (std::size_t i = 0; value.is_array() && i < value.size(); ++i) {
        check(value[i], rule, path + "[" + std::to_string(i) + "]", faults);
      }
    } else if (keyword == "minItems") {
      if (value.is_array() && value.size() < rule.get<std::size_t>()) {
        fault("must have at least " + rule.dump() + " items");
      }
    } else if (keyword != "$schema" && keyword != "$id" && keyword != "$defs" &&
               keyword != "title" && keyword != "description") {
      faults.push_back("the schema uses the keyword " + keyword + ", which is not known here");
    }
  }

  /// Members that `properties` does not name.
  void checkOthers(const Json& value, const Json& schema, const Json& rule, const std::string& path,
                   Faults& faults) const {
    if (!value.is_object()) return;
    for (const auto& [name, member] : value.items()) {
      if (!schema.contains("properties") || !schema["properties"].contains(name)) {
        check(member, rule, path + "." + name, faults);
      }
    }
  }

  Json root_;
};

}  // namespace pneuma::test
