#include "pipeline/domain_surface.h"

#include <array>
#include <vector>

#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include "core/parallel.h"
#include "pipeline/contour.h"

namespace pneuma {
namespace {

/// Blurs with the weights 1/4, 1/2, 1/4 along one axis; the border stays as it is.
void blur(std::vector<float>& values, const std::array<std::size_t, 3>& size, std::size_t axis) {
  const std::array<std::size_t, 3> strides = {1, size[0], size[0] * size[1]};
  const std::size_t stride = strides[axis];
  const std::vector<float> before = values;
  for (std::size_t node = 0; node < values.size(); ++node) {
    const std::size_t along = node / stride % size[axis];
    if (along == 0 || along + 1 == size[axis]) continue;
    values[node] = 0.25F * (before[node - stride] + 2.0F * before[node] + before[node + stride]);
  }
}

}  // namespace

TriangleMesh surfaceOf(const Domain& domain, double cellMm) {
  const Box3 box = domain.bounds();
  const Vec3 origin = box.min() - 3.0 * Vec3::Constant(cellMm);
  std::array<std::size_t, 3> size{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    size[axis] =
        static_cast<std::size_t>(box.sizes()[static_cast<Eigen::Index>(axis)] / cellMm) + 8;
  }
  std::vector<float> inside(size[0] * size[1] * size[2]);
  parallelFor(size[2], [&](std::size_t k) {
    for (std::size_t j = 0; j < size[1]; ++j)
      for (std::size_t i = 0; i < size[0]; ++i) {
        const Vec3 p = origin + cellMm * Vec3(static_cast<double>(i), static_cast<double>(j),
                                              static_cast<double>(k));
        inside[i + size[0] * (j + size[1] * k)] = domain.contains(p) ? 1.0F : 0.0F;
      }
  });
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t axis = 0; axis < 3; ++axis) blur(inside, size, axis);
  }
  vtkNew<vtkFloatArray> scalars;
  scalars->SetArray(inside.data(), static_cast<vtkIdType>(inside.size()), 1);  // borrowed
  vtkNew<vtkImageData> image;
  image->SetDimensions(static_cast<int>(size[0]), static_cast<int>(size[1]),
                       static_cast<int>(size[2]));
  image->SetOrigin(origin.x(), origin.y(), origin.z());
  image->SetSpacing(cellMm, cellMm, cellMm);
  image->GetPointData()->SetScalars(scalars);
  return contourOf(*image, 0.5);
}

}  // namespace pneuma
