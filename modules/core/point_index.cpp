#include "core/point_index.h"

#include <nanoflann.hpp>

namespace pneuma {
namespace {

struct Cloud {
  std::vector<Vec3> points;

  std::size_t kdtree_get_point_count() const { return points.size(); }

  double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points[i][static_cast<Eigen::Index>(axis)];
  }

  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using KdTree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>,
                                                   Cloud, 3, std::size_t>;

}  // namespace

struct PointIndex::Tree {
  explicit Tree(std::vector<Vec3> points)
      : cloud{std::move(points)}, tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(12)) {}

  Cloud cloud;
  KdTree tree;
};

PointIndex::PointIndex(std::vector<Vec3> points)
    : tree_(std::make_unique<Tree>(std::move(points))) {}

PointIndex::~PointIndex() = default;
PointIndex::PointIndex(PointIndex&&) noexcept = default;
PointIndex& PointIndex::operator=(PointIndex&&) noexcept = default;

const std::vector<Vec3>& PointIndex::points() const { return tree_->cloud.points; }

PointIndex::Neighbour PointIndex::nearest(const Vec3& p) const {
  std::size_t index = 0;
  double squared = 0.0;
  tree_->tree.knnSearch(p.data(), 1, &index, &squared);
  return {index, std::sqrt(squared)};
}

std::vector<PointIndex::Neighbour> PointIndex::nearest(const Vec3& p, std::size_t count) const {
  std::vector<std::size_t> index(count);
  std::vector<double> squared(count);
  const std::size_t found = tree_->tree.knnSearch(p.data(), count, index.data(), squared.data());
  std::vector<Neighbour> result(found);
  for (std::size_t i = 0; i < found; ++i) result[i] = {index[i], std::sqrt(squared[i])};
  return result;
}

std::vector<PointIndex::Neighbour> PointIndex::within(const Vec3& p, double radius) const {
  std::vector<std::pair<std::size_t, double>> matches;
  tree_->tree.radiusSearch(p.data(), radius * radius, matches, nanoflann::SearchParams());
  std::vector<Neighbour> result;
  result.reserve(matches.size());
  for (const auto& [index, squared] : matches) result.push_back({index, std::sqrt(squared)});
  return result;
}

}  // namespace pneuma
