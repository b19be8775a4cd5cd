#include "render/picture_data.h"

#include <algorithm>

#include <vtkImageData.h>

namespace pneuma {

vtkSmartPointer<vtkImageData> imageDataOf(const Picture& picture) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(picture.width, picture.height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const std::size_t stride = static_cast<std::size_t>(picture.width) * 3;
  auto* pixels = static_cast<std::uint8_t*>(image->GetScalarPointer());
  for (int row = 0; row < picture.height; ++row) {
    const auto* line = picture.rgb.data() + static_cast<std::size_t>(row) * stride;
    std::copy_n(line, stride, pixels + static_cast<std::size_t>(picture.height - 1 - row) * stride);
  }
  return image;
}

}  // namespace pneuma
