#pragma once

#include <vector>

#include "core/progress.h"
#include "pipeline/case_page.h"
#include "pipeline/lung_model.h"

namespace pneuma {

/// The pictures of a case's report: its lungs and airways from four sides, on white as paper is.
/// @throws as fourSides()
std::vector<PagePicture> casePictures(const LungModel& model, const Progress& progress = {});

}  // namespace pneuma
