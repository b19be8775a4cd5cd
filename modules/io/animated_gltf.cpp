#include "io/animated_gltf.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string_view>

#include "core/error.h"
#include "io/json.h"

namespace pneuma {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

// Numbers that glTF takes from OpenGL.
constexpr int ArrayBuffer = 34962;
constexpr int ElementArrayBuffer = 34963;
constexpr int UnsignedByte = 5121;
constexpr int UnsignedInt = 5125;
constexpr int Float = 5126;

constexpr double MetresPerMm = 0.001;
constexpr std::size_t PieceBytes = std::size_t{8}
                                   << 20;  // written between two looks whether to stop

/// Turns LPS (z up, the patient faces -y) to y up, facing z: a quarter about x.
const Json Turn = {-std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)};

/// Colours of glTF are linear.
double linear(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

/// The binary part, and the views and accessors into it.
class Buffer {
 public:
  Buffer(Json& views, Json& accessors) : views_(views), accessors_(accessors) {}

  /// @returns the accessor's index
  std::size_t addVectors(const std::vector<float>& values) {
    const std::size_t index = add(values, ArrayBuffer, Float, "VEC3", 3);
    // Of positions readers want the box.
    std::array<float, 3> low;
    std::array<float, 3> high;
    low.fill(std::numeric_limits<float>::max());
    high.fill(std::numeric_limits<float>::lowest());
    for (std::size_t n = 0; n < values.size(); ++n) {
      low[n % 3] = std::min(low[n % 3], values[n]);
      high[n % 3] = std::max(high[n % 3], values[n]);
    }
    accessors_[index]["min"] = low;
    accessors_[index]["max"] = high;
    return index;
  }

  /// Rows begin at multiples of four bytes: the fourth number is 1.
  std::size_t addColours(const std::vector<std::uint8_t>& srgb) {
    std::vector<std::uint8_t> values;
    values.reserve(srgb.size() / 3 * 4);
    for (std::size_t n = 0; n < srgb.size(); ++n) {
      values.push_back(static_cast<std::uint8_t>(std::lround(255.0 * linear(srgb[n] / 255.0))));
      if (n % 3 == 2) values.push_back(255);
    }
    const std::size_t index = add(values, ArrayBuffer, UnsignedByte, "VEC4", 4);
    accessors_[index]["normalized"] = true;
    return index;
  }

  std::size_t addTriangles(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    std::vector<std::uint32_t> corners;
    corners.reserve(3 * triangles.size());
    for (const auto& triangle : triangles) {
      corners.insert(corners.end(), triangle.begin(), triangle.end());
    }
    return add(corners, ElementArrayBuffer, UnsignedInt, "SCALAR", 1);
  }

  std::size_t addNumbers(const std::vector<double>& numbers) {
    const std::vector<float> values(numbers.begin(), numbers.end());
    const std::size_t index = add(values, 0, Float, "SCALAR", 1);
    const auto [low, high] = std::ranges::minmax_element(values);
    accessors_[index]["min"] = {*low};
    accessors_[index]["max"] = {*high};
    return index;
  }

  const std::string& bytes() const { return bytes_; }

 private:
  template <class T>
  std::size_t add(const std::vector<T>& values, int target, int type, const char* shape,
                  std::size_t numbers) {
    const std::size_t length = values.size() * sizeof(T);
    Json view = {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", length}};
    if (target != 0) view["target"] = target;
    accessors_.push_back({{"bufferView", views_.size()},
                          {"componentType", type},
                          {"count", values.size() / numbers},
                          {"type", shape}});
    views_.push_back(std::move(view));
    bytes_.append(reinterpret_cast<const char*>(values.data()), length);
    bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
    return accessors_.size() - 1;
  }

  Json& views_;
  Json& accessors_;
  std::string bytes_;
};

Json materialOf(const MorphingMesh& mesh) {
  const auto& [r, g, b, opacity] = mesh.colour;
  const bool byPoint = !mesh.colours.empty();
  Json material = {{"name", mesh.name},
                   {"pbrMetallicRoughness",
                    {{"baseColorFactor",
                      {byPoint ? 1.0 : linear(r), byPoint ? 1.0 : linear(g),
                       byPoint ? 1.0 : linear(b), opacity}},
                     {"metallicFactor", 0.0},
                     {"roughnessFactor", 0.6}}}};
  if (opacity < 1.0) material["alphaMode"] = "BLEND";
  return material;
}

Json meshOf(const MorphingMesh& mesh, std::size_t material, Buffer& buffer) {
  Json attributes = {{"POSITION", buffer.addVectors(mesh.points)},
                     {"NORMAL", buffer.addVectors(mesh.normals)}};
  if (!mesh.colours.empty()) attributes["COLOR_0"] = buffer.addColours(mesh.colours);
  Json target = {{"POSITION", buffer.addVectors(mesh.displacement)},
                 {"NORMAL", buffer.addVectors(mesh.normalSlope)}};
  return {{"name", mesh.name},
          {"primitives",
           {{{"attributes", std::move(attributes)},
             {"indices", buffer.addTriangles(mesh.triangles)},
             {"material", material},
             {"targets", Json::array({std::move(target)})}}}},
          {"weights", {0.0}}};
}

/// Of a chunk whose length is a multiple of four bytes.
std::string chunkHead(std::size_t size, const char* kind) {
  const auto length = static_cast<std::uint32_t>(size);
  std::string text(8, '\0');
  std::memcpy(text.data(), &length, 4);
  std::memcpy(text.data() + 4, kind, 4);
  return text;
}

std::string chunk(std::string content, const char* kind, char padding) {
  content.resize((content.size() + 3) / 4 * 4, padding);
  return chunkHead(content.size(), kind) + content;
}

}  // namespace

void writeAnimatedGltf(const std::filesystem::path& path, const std::vector<MorphingMesh>& meshes,
                       const std::vector<double>& seconds, const std::vector<MorphWeights>& motions,
                       Existing existing, const Progress& progress) {
  if (meshes.empty() || seconds.empty()) throw InvalidInput("there is nothing that moves to write");
  Json file = {{"asset", {{"version", "2.0"}, {"generator", "Pneuma"}}},
               {"scene", 0},
               {"scenes", {{{"nodes", {0}}}}},
               {"nodes", Json::array()},
               {"meshes", Json::array()},
               {"materials", Json::array()},
               {"animations", Json::array()},
               {"buffers", Json::array()},
               {"bufferViews", Json::array()},
               {"accessors", Json::array()}};
  Buffer buffer(file["bufferViews"], file["accessors"]);
  Json children = Json::array();
  Json channels = Json::array();
  file["nodes"].push_back(
      {{"name", "Lungs"}, {"rotation", Turn}, {"scale", {MetresPerMm, MetresPerMm, MetresPerMm}}});
  for (const MorphingMesh& mesh : meshes) {
    progress.throwIfStopped();
    const std::size_t node = file["nodes"].size();
    file["nodes"].push_back({{"name", mesh.name}, {"mesh", file["meshes"].size()}});
    file["meshes"].push_back(meshOf(mesh, file["materials"].size(), buffer));
    file["materials"].push_back(materialOf(mesh));
    children.push_back(node);
    channels.push_back(
        {{"sampler", mesh.motion}, {"target", {{"node", node}, {"path", "weights"}}}});
  }
  file["nodes"][0]["children"] = std::move(children);
  const std::size_t times = buffer.addNumbers(seconds);
  Json samplers = Json::array();
  for (const MorphWeights& weights : motions) {
    samplers.push_back(
        {{"input", times}, {"output", buffer.addNumbers(weights)}, {"interpolation", "LINEAR"}});
  }
  file["animations"].push_back(
      {{"name", "Breath"}, {"samplers", std::move(samplers)}, {"channels", std::move(channels)}});
  file["buffers"].push_back({{"byteLength", buffer.bytes().size()}});

  std::string content = chunk(file.dump(), "JSON", ' ');
  constexpr std::size_t Head = 12;
  const std::size_t whole = Head + content.size() + 8 + buffer.bytes().size();
  if (whole > std::numeric_limits<std::uint32_t>::max()) {
    throw InvalidInput("an animation of " + std::to_string(whole >> 20) +
                       " MB does not fit into one glTF file, which ends at 4 GB; use coarser "
                       "surfaces or fewer branches");
  }
  const std::array<std::uint32_t, 2> head = {2, static_cast<std::uint32_t>(whole)};
  std::string text = "glTF";
  text.append(reinterpret_cast<const char*>(head.data()), sizeof(head));
  text += content;
  AtomicFile target(path, existing);
  target.write(text);
  target.write(chunkHead(buffer.bytes().size(), "BIN\0"));
  const std::string_view bytes = buffer.bytes();
  for (std::size_t at = 0; at < bytes.size(); at += PieceBytes) {
    progress.report(static_cast<double>(at) / static_cast<double>(bytes.size()));
    target.write(bytes.substr(at, PieceBytes));
  }
  progress.report(1.0);
  target.commit();
}

}  // namespace pneuma
