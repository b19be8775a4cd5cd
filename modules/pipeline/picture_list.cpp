#include "pipeline/picture_list.h"

#include <algorithm>
#include <set>

#include "core/error.h"
#include "core/options.h"
#include "io/atomic_file.h"
#include "io/json.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view PicturesSchema = "pneuma/pictures/1";
constexpr std::size_t MostListBytes = std::size_t{4} << 20;
constexpr std::size_t LongestName = 100;

bool isPictureName(std::string_view name) {
  constexpr std::string_view Letters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
  return !name.empty() && name.size() <= LongestName && name.front() != '.' &&
         name.find_first_not_of(Letters) == std::string_view::npos;
}

/// Complaints name the file and the picture.
class PictureListReader {
 public:
  explicit PictureListReader(PictureList& list) : list_(list) {}

  void read() {
    Json json;
    try {
      json = Json::parse(readFile(list_.file, MostListBytes));
    } catch (const Json::parse_error& error) {
      fail("is no JSON near byte " + std::to_string(error.byte));
    } catch (const Json::out_of_range&) {
      fail("holds a number that is too large");
    }
    if (!json.is_object()) fail("is no list of pictures: its outermost value is no object");
    if (!json.contains("schema") || json.at("schema") != PicturesSchema) {
      fail("is no list of pictures: its \"schema\" should be \"" + std::string(PicturesSchema) +
           "\"");
    }
    requireKnown(json, {"schema", "size", "references", "pictures"});
    if (json.contains("size")) list_.size = text(json.at("size"), "size");
    if (json.contains("references")) references_ = text(json.at("references"), "references");
    if (!json.contains("pictures") || !json.at("pictures").is_array() ||
        json.at("pictures").empty()) {
      fail("lists no pictures: \"pictures\" should hold one object for each");
    }
    for (const Json& entry : json.at("pictures")) {
      where_ = "picture " + std::to_string(list_.pictures.size() + 1);
      list_.pictures.push_back(picture(entry));
    }
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InvalidInput("'" + list_.file.string() + "' " +
                       (where_.empty() ? what : "cannot be used: " + where_ + " " + what));
  }

  void requireKnown(const Json& object, const std::vector<std::string_view>& keys) const {
    for (const auto& [key, value] : object.items()) {
      if (std::ranges::find(keys, key) != keys.end()) continue;
      const std::string_view nearest = nearestWord(key, keys);
      fail("has an unknown key \"" + key + "\"" +
           (nearest.empty() ? "" : "; did you mean \"" + std::string(nearest) + "\"?"));
    }
  }

  std::string text(const Json& value, const char* key) const {
    if (!value.is_string()) fail(std::string("should have a text under \"") + key + "\"");
    return value.get<std::string>();
  }

  std::vector<std::string> texts(const Json& entry, const char* key) const {
    if (!entry.contains(key)) return {};
    const Json& values = entry.at(key);
    if (!values.is_array() || !std::ranges::all_of(values, &Json::is_string)) {
      fail(std::string("should have a list of texts under \"") + key + "\"");
    }
    return values.get<std::vector<std::string>>();
  }

  ListedPicture picture(const Json& entry) {
    if (!entry.is_object()) fail("is no object");
    ListedPicture picture;
    if (!entry.contains("name")) fail("has no \"name\"");
    picture.name = text(entry.at("name"), "name");
    if (!isPictureName(picture.name)) {
      fail("has the name \"" + picture.name +
           "\"; a name is made of letters, digits, '-', '_' and '.', 100 at most");
    }
    where_ = "\"" + picture.name + "\"";
    if (!names_.insert(picture.name).second) fail("is there twice");
    requireKnown(entry, {"name", "inputs", "options", "picture", "reference", "limit", "reason"});
    for (const std::string& input : texts(entry, "inputs")) picture.inputs.emplace_back(input);
    picture.options = texts(entry, "options");
    if (entry.contains("picture")) picture.ready = text(entry.at("picture"), "picture");
    if (picture.ready.empty() == picture.inputs.empty()) {
      fail("should have either \"inputs\" that are drawn or a \"picture\" that is there");
    }
    if (!picture.ready.empty() && !picture.options.empty()) {
      fail("has options, but its \"picture\" is not drawn");
    }
    picture.reference = entry.contains("reference")
                            ? fs::path(text(entry.at("reference"), "reference"))
                            : references_ / (picture.name + ".png");
    readLimit(entry, picture);
    for (const fs::path& input : picture.inputs) (void)pathInFolder(list_, picture.name, input);
    if (!picture.ready.empty()) (void)pathInFolder(list_, picture.name, picture.ready);
    (void)pathInFolder(list_, picture.name, picture.reference);
    if (picture.reference.extension() != ".png") fail("has a reference that is no .png");
    return picture;
  }

  void readLimit(const Json& entry, ListedPicture& picture) const {
    if (entry.contains("reason")) picture.reason = text(entry.at("reason"), "reason");
    if (!entry.contains("limit")) return;
    const Json& limit = entry.at("limit");
    if (!limit.is_number() || !(limit.get<double>() >= 0.0 && limit.get<double>() <= 1.0)) {
      fail("has a \"limit\" that is no number from 0 to 1");
    }
    picture.limit = limit.get<double>();
    if (picture.limit > UsualPictureLimit && picture.reason.empty()) {
      fail("has a limit looser than " + textOf(UsualPictureLimit) + " and no \"reason\" for it");
    }
  }

  PictureList& list_;
  fs::path references_ = "references";
  std::set<std::string> names_;
  std::string where_;
};

}  // namespace

PictureList readPictureList(const std::filesystem::path& path) {
  std::error_code error;
  PictureList list;
  if (fs::is_regular_file(path, error)) {
    list.folder = folderOf(path);
    list.file = path;
  } else if (fs::is_directory(path, error)) {
    list.folder = path;
    list.file = path / PictureListFile;
    if (!fs::exists(list.file, error)) {
      throw InputMissing("'" + path.string() + "' holds no " + PictureListFile +
                         ", the list of pictures to draw again; docs/pictures.md tells its form");
    }
  } else {
    throw InputMissing("there is no folder or list '" + path.string() + "'; check its name");
  }
  PictureListReader(list).read();
  return list;
}

std::filesystem::path pathInFolder(const PictureList& list, const std::string& picture,
                                   const std::filesystem::path& path) {
  const bool goesUp = std::ranges::find(path, fs::path("..")) != path.end();
  if (path.empty() || path.is_absolute() || goesUp) {
    throw InvalidInput("'" + list.file.string() + "' cannot be used: \"" + picture +
                       "\" names the path '" + path.string() +
                       "'; paths of a list are relative to it and stay in its folder");
  }
  return list.folder / path;
}

}  // namespace pneuma
