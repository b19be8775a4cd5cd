#pragma once

#include <map>
#include <string>
#include <typeindex>
#include <utility>

#include "core/error.h"
#include "io/member_archive.h"
#include "pipeline/detail/project_values.h"

namespace pneuma {

/// Turns what a ProjectWriter wrote into values again. What is used is taken away, so that in the
/// end the rest is there that this version does not know. What is missing stays as it is.
class ProjectReader {
 public:
  static constexpr bool Reading = true;

  /// @param name of the project in messages, in quotation marks
  ProjectReader(Json root, std::vector<ArchiveMember> members, std::string name)
      : root_(std::move(root)), name_(std::move(name)) {
    for (ArchiveMember& member : members) members_[member.name] = std::move(member);
    if (root_.contains("objects") && root_["objects"].is_object()) {
      objects_ = std::move(root_["objects"]);
      root_.erase("objects");
    }
    stack_ = {&root_};
  }

  template <class T>
  void operator()(const char* key, T& value) {
    Json& parent = *stack_.back();
    if (!parent.contains(key)) return;
    path_.emplace_back(key);
    Json& json = parent[key];
    read(json, value);
    path_.pop_back();
    if (!json.is_object() || json.empty()) parent.erase(key);
  }

  /// Names are for files alone.
  void named(const std::string& /*name*/) {}

  /// The content of the file that the JSON names. @throws InvalidInput if there is none
  std::string file(const char* key) {
    std::string name;
    (*this)(key, name);
    const auto found = members_.find(name);
    if (found == members_.end()) fail("names the file \"" + name + "\", which is not in it");
    std::string content = std::move(found->second.content);
    members_.erase(found);
    return content;
  }

  /// The project and the place in it, for messages.
  std::string where() const {
    std::string where = name_ + " at \"";
    for (std::size_t i = 0; i < path_.size(); ++i) where += (i == 0 ? "" : "/") + path_[i];
    return where + "\"";
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InvalidInput(where() + " " + what + "; it is damaged");
  }

  /// What nobody asked for. Nothing may follow.
  Json rest() {
    if (!objects_.empty()) root_["objects"] = std::move(objects_);
    return std::move(root_);
  }

  std::vector<ArchiveMember> restOfMembers() {
    std::vector<ArchiveMember> rest;
    for (auto& [name, member] : members_) rest.push_back(std::move(member));
    return rest;
  }

 private:
  template <class T>
  void readObject(Json& json, T& value) {
    if (!json.is_object()) fail("should be an object");
    stack_.push_back(&json);
    describe(*this, value);
    stack_.pop_back();
  }

  template <class T>
  void read(Json& json, T& value) {
    if constexpr (std::is_same_v<T, Json>) {
      value = std::exchange(json, nullptr);
    } else if constexpr (std::is_same_v<T, bool>) {
      if (!json.is_boolean()) fail("should be true or false");
      value = json.get<bool>();
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (!json.is_string()) fail("should be a text");
      value = json.get<std::string>();
    } else if constexpr (std::is_integral_v<T>) {
      readWhole(json, value);
    } else if constexpr (std::is_floating_point_v<T>) {
      const auto number = numberOf(json);
      if (!number) fail("should be a number");
      value = *number;
    } else if constexpr (std::is_enum_v<T>) {
      const auto named =
          json.is_string() ? valueOfName(json.get<std::string>(), T{}) : std::optional<T>();
      if (!named) fail("has a name that this version does not know");
      value = *named;
    } else if constexpr (FixedMatrix<T>) {
      requireList(json, static_cast<std::size_t>(T::SizeAtCompileTime));
      for (Eigen::Index i = 0; i < value.size(); ++i) {
        read(json[static_cast<std::size_t>(i)], value.data()[i]);
      }
    } else if constexpr (IsVector<T>) {
      if (!json.is_array()) fail("should be a list");
      value.clear();
      value.resize(json.size());
      for (std::size_t i = 0; i < value.size(); ++i) read(json[i], value[i]);
    } else if constexpr (IsArray<T>) {
      requireList(json, value.size());
      for (std::size_t i = 0; i < value.size(); ++i) read(json[i], value[i]);
    } else if constexpr (IsMap<T>) {
      readMap(json, value);
    } else if constexpr (IsOptional<T>) {
      value.reset();
      if (!json.is_null()) read(json, value.emplace());
    } else if constexpr (IsPair<T>) {
      requireList(json, 2);
      read(json[0], value.first);
      read(json[1], value.second);
    } else if constexpr (IsShared<T>) {
      value = nullptr;
      if (!json.is_null()) readShared(json, value);
    } else if constexpr (Described<ProjectReader, T>) {
      readObject(json, value);
    } else {
      readOptions(json, value);
    }
  }

  template <class T>
  void readWhole(const Json& json, T& value) {
    if (!json.is_number_integer()) fail("should be a whole number");
    const bool fits = json.is_number_unsigned() ? std::in_range<T>(json.get<std::uint64_t>())
                                                : std::in_range<T>(json.get<std::int64_t>());
    if (!fits) fail("should be a whole number that is not so large");
    value = json.is_number_unsigned() ? static_cast<T>(json.get<std::uint64_t>())
                                      : static_cast<T>(json.get<std::int64_t>());
  }

  void requireList(const Json& json, std::size_t size) const {
    if (!json.is_array() || json.size() != size) {
      fail("should be a list of " + std::to_string(size));
    }
  }

  template <class Key, class T>
  void readMap(Json& json, std::map<Key, T>& value) {
    if (!json.is_object()) fail("should be an object");
    value.clear();
    Json rest = Json::object();
    for (auto& [key, one] : json.items()) {
      const auto named = valueOfName(key, Key{});
      if (named) {
        path_.push_back(key);
        read(one, value[*named]);
        path_.pop_back();
      }
      if (!named || (one.is_object() && !one.empty())) rest[key] = std::move(one);
    }
    json = std::move(rest);
  }

  template <HasFields Options>
  void readOptions(Json& json, Options& options) {
    if (!json.is_object()) fail("should be an object");
    forEachField<Options>([&](const auto& field) {
      const std::string key(field.name);
      if (!json.contains(key)) return;
      const Json& value = json[key];
      if (value.is_structured() || value.is_null()) fail("should have numbers and texts alone");
      try {
        setOption(options, key,
                  value.is_string()    ? value.get<std::string>()
                  : value.is_boolean() ? std::string(value.get<bool>() ? "1" : "0")
                                       : value.dump());
      } catch (const InvalidOption& error) {
        throw InvalidInput(where() + ": " + error.what());
      }
      json.erase(key);
    });
  }

  template <class T>
  void readShared(const Json& json, std::shared_ptr<const T>& value) {
    if (!json.is_string()) fail("should name an object");
    const std::string id = json.get<std::string>();
    auto& known = shared_[{typeid(T), id}];
    if (!known) {
      if (!objects_.contains(id)) fail("names an object \"" + id + "\" that is not there");
      Json object = std::move(objects_[id]);
      objects_.erase(id);  // an object within itself is not there
      auto made = std::make_shared<T>();
      readObject(object, *made);
      known = std::move(made);
    }
    value = std::static_pointer_cast<const T>(known);
  }

  Json root_;
  std::string name_;
  Json objects_ = Json::object();
  std::map<std::string, ArchiveMember> members_;
  std::vector<Json*> stack_;
  std::vector<std::string> path_;
  std::map<std::pair<std::type_index, std::string>, std::shared_ptr<const void>> shared_;
};

}  // namespace pneuma
