#pragma once

#include <string>

#include "io/dicom_series.h"

namespace pneuma {

/// A description (UTF-8) as people type it, without the words that name the person of a CT, or
/// those around: "..." stands in their place. Taken for such are the words of the names and numbers
/// among the identifiers, in any case (Latin, Greek, Cyrillic); two of a name glued together, or
/// one with the other's initial; names of five letters within a word; numbers and the date of birth
/// with any punctuation, without leading zeros, in any order of day, month and year. Rather too
/// much is left out than too little. Of texts longer than 1 KB, which DICOM does not allow, the
/// beginning is taken.
std::string withoutPerson(const std::string& description, const Identifiers& identifiers);

}  // namespace pneuma
