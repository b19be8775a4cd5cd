#include "render/slice_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"
#include "render/colour_map.h"
#include "render/slice_annotations.h"
#include "render/slice_fissures.h"
#include "render/slice_highlight.h"
#include "render/tube_mesh.h"

namespace pneuma {
namespace {

constexpr int MostSamples = 4;  // of a pixel's side
constexpr double HighlightOpacity = 0.45;
constexpr Rgb HighlightColour = rgbOfHex(0x2fd6c3);
constexpr double EdgeOpacity = 0.9;

using Bytes = std::array<std::uint8_t, 3>;

/// Voxel coordinates along a picture: pixel (x, y), counted from its centre, lies at
/// first + x * right + y * down.
struct VoxelSteps {
  Vec3 first;
  Vec3 right;
  Vec3 down;

  VoxelSteps(const ImageGeometry& geometry, const SliceFrame& frame) {
    const Mat3 voxelFromMm = geometry.steps().inverse();
    const ViewAxes axes = axesOf(frame.plane);
    first = voxelFromMm * (frame.pointAt({0.5, 0.5}) - geometry.origin);
    right = voxelFromMm * axes.right * frame.mmPerPixel;
    down = voxelFromMm * -axes.up * frame.mmPerPixel;
  }
};

bool inside(const ImageGeometry& geometry, const Vec3& voxel) {
  for (int axis = 0; axis < 3; ++axis) {
    const int size = geometry.size[static_cast<std::size_t>(axis)];
    if (!(voxel[axis] >= -0.5 && voxel[axis] <= size - 0.5)) return false;
  }
  return true;
}

/// Trilinear. @pre inside(ct.geometry, voxel)
double interpolated(const CtImage& ct, const Vec3& voxel) {
  std::array<std::size_t, 3> low{};
  std::array<std::size_t, 3> step{};
  std::array<double, 3> share{};
  std::size_t stride = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int last = ct.geometry.size[axis] - 1;
    const double at =
        std::clamp(voxel[static_cast<Eigen::Index>(axis)], 0.0, static_cast<double>(last));
    const int below = static_cast<int>(at);
    low[axis] = static_cast<std::size_t>(below) * stride;
    share[axis] = at - below;
    step[axis] = below < last ? stride : 0;
    stride *= static_cast<std::size_t>(ct.geometry.size[axis]);
  }
  const std::int16_t* v = ct.voxels.data() + low[0] + low[1] + low[2];
  const auto row = [&](std::size_t offset) {
    const double a = v[offset];
    return a + (v[offset + step[0]] - a) * share[0];
  };
  const auto plane = [&](std::size_t offset) {
    const double a = row(offset);
    return step[1] == 0 ? a : a + (row(offset + step[1]) - a) * share[1];
  };
  const double a = plane(0);
  return step[2] == 0 || share[2] == 0.0 ? a : a + (plane(step[2]) - a) * share[2];
}

/// @pre inside(image.geometry, voxel)
template <class T>
T nearest(const Image<T>& image, const Vec3& voxel) {
  std::array<int, 3> index{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double at = voxel[static_cast<Eigen::Index>(axis)] + 0.5;
    index[axis] = std::clamp(static_cast<int>(at), 0, image.geometry.size[axis] - 1);
  }
  return image.at(index[0], index[1], index[2]);
}

template <class T>
std::optional<T> valueAt(const Image<T>& image, const Vec3& point) {
  const Vec3 voxel = image.geometry.voxelFromWorld(point);
  if (!inside(image.geometry, voxel)) return std::nullopt;
  return nearest(image, voxel);
}

void mix(std::uint8_t* pixel, const Bytes& colour, double share) {
  for (std::size_t c = 0; c < 3; ++c) {
    pixel[c] = static_cast<std::uint8_t>(pixel[c] + (colour[c] - pixel[c]) * share + 0.5);
  }
}

/// So many samples a side keep fine voxels from flickering in coarse pixels.
int samplesPerSide(const VoxelSteps& steps) {
  const double widest =
      std::max(steps.right.cwiseAbs().maxCoeff(), steps.down.cwiseAbs().maxCoeff());
  return std::clamp(static_cast<int>(std::lround(widest)), 1, MostSamples);
}

void drawCt(const CtImage& ct, const SliceFrame& frame, const SliceLook& look, Picture& picture) {
  const VoxelSteps steps(ct.geometry, frame);
  const int samples = samplesPerSide(steps);
  const Bytes highlightColour = bytesOf(HighlightColour);
  std::optional<SliceHighlight> highlight;
  if (look.highlight) highlight.emplace(ct, frame, *look.highlight);
  const std::size_t width = static_cast<std::size_t>(picture.width);
  parallelFor(static_cast<std::size_t>(picture.height), [&](std::size_t y) {
    std::uint8_t* pixel = picture.rgb.data() + y * width * 3;
    for (std::size_t x = 0; x < width; ++x, pixel += 3) {
      double sum = 0.0;
      int count = 0;
      for (int sample = 0; sample < samples * samples; ++sample) {
        const double right = static_cast<double>(x) + (sample % samples + 0.5) / samples - 0.5;
        const double down = static_cast<double>(y) + (sample / samples + 0.5) / samples - 0.5;
        const Vec3 voxel = steps.first + right * steps.right + down * steps.down;
        if (!inside(ct.geometry, voxel)) continue;
        sum += interpolated(ct, voxel);
        ++count;
      }
      if (count == 0) continue;
      const double hu = sum / count;
      std::fill_n(pixel, 3, look.window.grey(hu));
      if (highlight && highlight->contains(frame.pointAt(
                           {static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5}))) {
        mix(pixel, highlightColour, HighlightOpacity);
      }
    }
  });
}

/// The label of every pixel.
std::vector<std::uint8_t> labelsOf(const LabelImage& labels, const SliceFrame& frame) {
  const VoxelSteps steps(labels.geometry, frame);
  const std::size_t width = static_cast<std::size_t>(frame.width);
  std::vector<std::uint8_t> plane(width * static_cast<std::size_t>(frame.height));
  parallelFor(static_cast<std::size_t>(frame.height), [&](std::size_t y) {
    const Vec3 row = steps.first + static_cast<double>(y) * steps.down;
    for (std::size_t x = 0; x < width; ++x) {
      const Vec3 voxel = row + static_cast<double>(x) * steps.right;
      if (inside(labels.geometry, voxel)) plane[y * width + x] = nearest(labels, voxel);
    }
  });
  return plane;
}

/// @param plane the label of every pixel
void drawLabels(const std::vector<std::uint8_t>& plane, const SliceLook& look, Picture& picture) {
  std::array<Bytes, 256> colours{};
  for (std::size_t value = 0; value < colours.size(); ++value) {
    colours[value] = bytesOf(lobeColour(static_cast<Lobe>(value), Palette::Pneuma));
  }
  const int width = picture.width;
  const int height = picture.height;
  const int thickness = std::max(1, static_cast<int>(std::lround(look.pixelRatio)));
  const auto at = [&](int x, int y) {
    return plane[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(x)];
  };
  const auto isEdge = [&](int x, int y, std::uint8_t label) {
    return at(std::max(x - thickness, 0), y) != label ||
           at(std::min(x + thickness, width - 1), y) != label ||
           at(x, std::max(y - thickness, 0)) != label ||
           at(x, std::min(y + thickness, height - 1)) != label;
  };
  parallelFor(static_cast<std::size_t>(height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    std::uint8_t* pixel = picture.rgb.data() + row * static_cast<std::size_t>(width) * 3;
    for (int x = 0; x < width; ++x, pixel += 3) {
      const std::uint8_t label = at(x, y);
      if (label == 0) continue;
      if (isEdge(x, y, label)) {
        mix(pixel, colours[label], EdgeOpacity);
      } else if (look.labels == LabelStyle::Filled && !look.highlight) {
        mix(pixel, colours[label], look.opacity);
      }
    }
  });
}

}  // namespace

Picture slicePicture(const SliceContents& contents, const SliceFrame& frame,
                     const SliceLook& look) {
  Picture picture{frame.width, frame.height, {}};
  picture.rgb.resize(static_cast<std::size_t>(frame.width) *
                     static_cast<std::size_t>(frame.height) * 3);
  if (contents.ct != nullptr) drawCt(*contents.ct, frame, look, picture);
  std::optional<FissureOverlay> fissures;
  if (contents.fissures != nullptr) fissures.emplace(*contents.fissures, frame);
  if (contents.labels != nullptr && (look.labels != LabelStyle::Hidden || fissures)) {
    std::vector<std::uint8_t> labels = labelsOf(*contents.labels, frame);
    if (fissures) fissures->split(labels);
    if (look.labels != LabelStyle::Hidden) drawLabels(labels, look, picture);
    if (fissures) fissures->drawLines(picture, labels, look.pixelRatio);
  }
  if (fissures) fissures->drawMarks(picture, look.pixelRatio);
  annotate(picture, contents, frame, look);
  return picture;
}

std::optional<int> huAt(const CtImage& ct, const Vec3& point) { return valueAt(ct, point); }

std::optional<std::uint8_t> labelAt(const LabelImage& labels, const Vec3& point) {
  return valueAt(labels, point);
}

}  // namespace pneuma
