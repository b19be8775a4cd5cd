#pragma once

#include <map>
#include <set>
#include <string>
#include <typeindex>
#include <utility>

#include "io/atomic_file.h"
#include "io/member_archive.h"
#include "pipeline/detail/project_values.h"

namespace pneuma {

/// Turns values into the JSON of a project and the files beside it. What several pointers share is
/// saved once, under "objects", and so is what they hold alike: lobes that were made twice.
class ProjectWriter {
 public:
  static constexpr bool Reading = false;

  /// Names that stand for something else already.
  void reserve(const std::string& name) { used_.insert(name); }

  /// A member of the value that is described.
  template <class T>
  void operator()(const char* key, const T& value) {
    const Enter entered(*this, key);
    Json json = jsonFor(value);  // may put others in place, so that references move
    here()[key] = std::move(json);
  }

  /// What the value that is described is called in names of files, in place of its number.
  void named(const std::string& name) {
    if (!path_.empty()) path_.back() = name;
  }

  /// A file beside project.json; the JSON has its name.
  /// @param extension with its dot
  void file(const char* key, const std::string& folder, const std::string& extension,
            std::string content) {
    const std::string stem = this->stem();
    const std::string name = unusedName(stem.empty() ? folder : folder + "/" + stem, extension);
    here()[key] = name;
    members_.push_back({name, std::move(content), true});
  }

  /// The JSON of the whole. Nothing may follow.
  Json take() {
    Json root = std::move(stack_.front());
    root["objects"] = std::move(objects_);
    return root;
  }

  std::vector<ArchiveMember>& members() { return members_; }

 private:
  /// While a member is being written, for the names of files.
  class Enter {
   public:
    Enter(ProjectWriter& writer, const std::string& key) : writer_(writer) {
      writer_.path_.push_back(key);
    }

    ~Enter() { writer_.path_.pop_back(); }

    Enter(const Enter&) = delete;
    Enter& operator=(const Enter&) = delete;

   private:
    ProjectWriter& writer_;
  };

  /// While another path is in place. Whatever is thrown, each Enter meets the path that it began
  /// with.
  class Elsewhere {
   public:
    Elsewhere(std::vector<std::string>& path, const std::string& begin)
        : path_(path), before_{begin} {
      path_.swap(before_);
    }

    ~Elsewhere() { path_.swap(before_); }

    Elsewhere(const Elsewhere&) = delete;
    Elsewhere& operator=(const Elsewhere&) = delete;

   private:
    std::vector<std::string>& path_;
    std::vector<std::string> before_;
  };

  Json& here() { return stack_.back(); }

  template <class T>
  Json object(const T& value) {
    stack_.push_back(Json::object());
    describe(*this, value);
    Json json = std::move(stack_.back());
    stack_.pop_back();
    return json;
  }

  /// The same, with a path of its own for the names of files.
  template <class T>
  Json objectNamed(const std::string& id, const T& value) {
    const Elsewhere elsewhere(path_, id);
    return object(value);
  }

  template <class T>
  Json jsonFor(const T& value) {
    if constexpr (std::is_same_v<T, Json>) {
      return value;
    } else if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::string> ||
                         std::is_integral_v<T>) {
      return value;
    } else if constexpr (std::is_floating_point_v<T>) {
      return jsonOf(value);
    } else if constexpr (std::is_enum_v<T>) {
      return projectName(value);
    } else if constexpr (FixedMatrix<T>) {
      Json list = Json::array();
      for (Eigen::Index i = 0; i < value.size(); ++i) list.push_back(jsonOf(value.data()[i]));
      return list;
    } else if constexpr (IsVector<T> || IsArray<T>) {
      Json list = Json::array();
      for (std::size_t i = 0; i < value.size(); ++i) {
        const Enter entered(*this, std::to_string(i + 1));
        list.push_back(jsonFor(value[i]));
      }
      return list;
    } else if constexpr (IsMap<T>) {
      Json json = Json::object();
      for (const auto& [key, one] : value) {
        const Enter entered(*this, projectName(key));
        json[projectName(key)] = jsonFor(one);
      }
      return json;
    } else if constexpr (IsOptional<T>) {
      return value ? jsonFor(*value) : Json();
    } else if constexpr (IsPair<T>) {
      return Json::array({jsonFor(value.first), jsonFor(value.second)});
    } else if constexpr (IsShared<T>) {
      return value ? Json(shared(value)) : Json();
    } else if constexpr (Described<ProjectWriter, const T>) {
      return object(value);
    } else {
      return toJson(value);
    }
  }

  /// The name of an object, which is written when it is met for the first time.
  template <class T>
  std::string shared(const std::shared_ptr<const T>& value) {
    const auto [known, isNew] = names_.try_emplace({typeid(T), value.get()});
    if (!isNew) return known->second;
    const std::string id = unusedName(stem(), "");
    known->second = id;
    const std::size_t files = members_.size();
    Json json = objectNamed(id, *value);
    alive_.push_back(value);
    const auto alike = alike_.try_emplace({typeid(T), withContents(json, files)}, id);
    if (!alike.second) {
      // An object within it would be a new one, so that all these files are its own.
      for (std::size_t i = files; i < members_.size(); ++i) used_.erase(members_[i].name);
      members_.resize(files);
      used_.erase(id);
      return known->second = alike.first->second;
    }
    objects_[id] = std::move(json);
    return id;
  }

  /// The text of an object with the hash of its files' contents in place of their names.
  /// @param files how many there were before it
  std::string withContents(Json json, std::size_t files) const {
    std::map<std::string, const std::string*> contents;
    for (std::size_t i = files; i < members_.size(); ++i) {
      contents[members_[i].name] = &members_[i].content;
    }
    replaceNames(json, contents);
    return sha256(json.dump(-1, ' ', false, Json::error_handler_t::replace));
  }

  static void replaceNames(Json& json, const std::map<std::string, const std::string*>& contents) {
    if (json.is_string()) {
      const auto found = contents.find(json.get_ref<const std::string&>());
      if (found != contents.end()) json = "sha256 " + sha256(*found->second);
    } else if (json.is_structured()) {
      for (Json& part : json) replaceNames(part, contents);
    }
  }

  /// The two innermost names that tell something, such as "undo-RUL".
  std::string stem() const {
    static const std::set<std::string> saysNothing = {"complex", "mesh",     "model", "result",
                                                      "state",   "surfaces", "tree"};
    std::vector<std::string> names;
    for (const std::string& name : path_) {
      if (!saysNothing.contains(name)) names.push_back(name);
    }
    std::string stem;
    for (std::size_t i = names.size() > 2 ? names.size() - 2 : 0; i < names.size(); ++i) {
      stem += (stem.empty() ? "" : "-") + names[i];
    }
    return stem;
  }

  std::string unusedName(const std::string& wanted, const std::string& extension) {
    std::string name = wanted + extension;
    for (int i = 2; !used_.insert(name).second; ++i) {
      name = wanted + "-" + std::to_string(i) + extension;
    }
    return name;
  }

  std::vector<Json> stack_ = {Json::object()};  ///< values that are being described
  std::vector<std::string> path_;
  Json objects_ = Json::object();
  std::vector<ArchiveMember> members_;
  std::map<std::pair<std::type_index, const void*>, std::string> names_;  ///< of objects
  std::map<std::pair<std::type_index, std::string>, std::string> alike_;  ///< by what they hold
  std::vector<std::shared_ptr<const void>> alive_;
  std::set<std::string> used_;
};

}  // namespace pneuma
