#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/json.h"
#include "pipeline/lung_model.h"
#include "pipeline/picture_list.h"

namespace pneuma {

/// How a picture that was drawn again compares.
enum class PictureOutcome { Same, Differs, Missing };

constexpr std::array<std::string_view, 3> choices(PictureOutcome) {
  return {"same", "differs", "missing"};
}

/// A picture of a list and what became of it. Files are those of the page's folder.
struct ComparedPicture {
  ListedPicture listed;
  PictureOutcome outcome = PictureOutcome::Missing;
  double score = 0.0;    ///< 0 equal, 1 nothing in common; of no meaning where nothing was compared
  std::string note;      ///< why nothing could be compared; a sentence's part
  bool updated = false;  ///< the new one is the reference now

  bool compared() const { return note.empty(); }
};

/// How many of them came out so.
std::size_t countOf(std::span<const ComparedPicture> pictures, PictureOutcome outcome);

/// "pneuma/regress/1", resources/schemas/regress.schema.json.
Json regressReport(const PictureList& list, std::span<const ComparedPicture> pictures,
                   Json parameters);

/// Which of the three pictures of a comparison a file holds.
enum class PagePart { Reference, New, Difference };

/// What a file of the page's folder is called: "left.new.png".
std::string pageFile(const std::string& picture, PagePart part);

/// An HTML page that shows reference, new picture and difference beside each other, those that
/// differ first. It needs the files of its folder and nothing else: no script, no network.
std::string regressPage(const PictureList& list, std::span<const ComparedPicture> pictures);

}  // namespace pneuma
