#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace pneuma {

/// What was done to a file so that it tells nobody's name.
struct AnonymizedDicom {
  std::string content;                         ///< the new file
  std::string seriesUid;                       ///< the new one
  std::map<std::string, std::size_t> removed;  ///< attributes by keyword, how often
  std::size_t privateRemoved = 0;
  std::size_t uidsReplaced = 0;
  bool hasPixels = false;
  std::string burnedIn;  ///< why names may be drawn into its picture, or ""
};

/// A UID that takes the place of another: the same for the same key, and no way back without it.
/// "2.25." and a number of 122 bits, of HMAC-SHA256 (PS3.5, B.2).
std::string anonymizedUid(std::string_view uid, std::string_view key);

/// A DICOM file without what identifies a person, after DICOM PS3.15 annex E, Basic Application
/// Level Confidentiality Profile with Clean Descriptors. Stricter than its table in one respect:
/// what is not known to be harmless goes. Kept are numbers, references to classes, the maker and
/// the model of the scanner, its kernel and filter, of descriptions the words that are common in
/// naming CTs, and of sequences those that a CT needs, with codes of public code lists only. Names,
/// texts, dates, times, private attributes, overlays and curves go; UIDs of patients' objects are
/// replaced, the same everywhere; PatientName and PatientID become one pseudonym of the key. Pixels
/// stay bit for bit.
/// @param name of the file, for messages
/// @throws InvalidInput, Unsupported (see dicomElements)
AnonymizedDicom anonymizedDicom(std::string_view file, std::string_view key,
                                const std::string& name);

}  // namespace pneuma
