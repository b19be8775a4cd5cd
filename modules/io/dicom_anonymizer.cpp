#include "io/dicom_anonymizer.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <span>
#include <vector>

#include <openssl/evp.h>
#include <openssl/hmac.h>
#include <vtkDICOMDictionary.h>

#include "io/detail/dicom_elements.h"
#include "io/detail/hex_digits.h"
#include "io/detail/text_fields.h"

namespace pneuma {
namespace {

constexpr std::string_view StandardRoot = "1.2.840.10008.";  // classes and syntaxes of the standard
constexpr std::uint32_t PixelData = 0x7FE00010;
constexpr std::uint32_t SeriesUid = 0x0020000E;

/// Texts that say how a picture was made, not of whom.
constexpr std::array<std::uint32_t, 5> HarmlessTexts = {0x00080070,   // Manufacturer
                                                        0x00081090,   // ManufacturerModelName
                                                        0x00181020,   // SoftwareVersions
                                                        0x00181160,   // FilterType
                                                        0x00181210};  // ConvolutionKernel

/// Descriptions that are cleaned word by word.
constexpr std::array<std::uint32_t, 3> Descriptions = {0x00081030, 0x0008103E, 0x00181030};

/// The sequences that a CT, or an enhanced one, needs to be read and used. Any other may tell of
/// people and places, be it by codes only.
constexpr std::array<std::uint32_t, 35> Sequences = {
    0x00081140,   // ReferencedImageSequence
    0x00082112,   // SourceImageSequence
    0x00082218,   // AnatomicRegionSequence
    0x00082220,   // AnatomicRegionModifierSequence
    0x00089124,   // DerivationImageSequence
    0x00089215,   // DerivationCodeSequence
    0x00180012,   // ContrastBolusAgentSequence
    0x00180014,   // ContrastBolusAdministrationRouteSequence
    0x00189301,   // CTAcquisitionTypeSequence
    0x00189304,   // CTAcquisitionDetailsSequence
    0x00189308,   // CTTableDynamicsSequence
    0x00189312,   // CTGeometrySequence
    0x00189314,   // CTReconstructionSequence
    0x00189321,   // CTExposureSequence
    0x00189325,   // CTXRayDetailsSequence
    0x00189326,   // CTPositionSequence
    0x00189329,   // CTImageFrameTypeSequence
    0x00189341,   // ContrastBolusUsageSequence
    0x00189346,   // CTDIPhantomTypeCodeSequence
    0x00189360,   // CTAdditionalXRaySourceSequence
    0x00209071,   // FrameAnatomySequence
    0x00209111,   // FrameContentSequence
    0x00209113,   // PlanePositionSequence
    0x00209116,   // PlaneOrientationSequence
    0x00209221,   // DimensionOrganizationSequence
    0x00209222,   // DimensionIndexSequence
    0x00283000,   // ModalityLUTSequence
    0x00283010,   // VOILUTSequence
    0x00289110,   // PixelMeasuresSequence
    0x00289132,   // FrameVOILUTSequence
    0x00289145,   // PixelValueTransformationSequence
    0x0040A170,   // PurposeOfReferenceCodeSequence
    0x20500010,   // PresentationLUTSequence
    0x52009229,   // SharedFunctionalGroupsSequence
    0x52009230};  // PerFrameFunctionalGroupsSequence

constexpr std::uint32_t CodingSchemeDesignator = 0x00080102;

/// Value, scheme and meaning of a code.
constexpr std::array<std::uint32_t, 3> Code = {0x00080100, CodingSchemeDesignator, 0x00080104};

/// Designators of code lists that are the same everywhere (PS3.16, table 8-1). Hospitals' own ones
/// (99...) may code people and departments.
constexpr std::array<std::string_view, 8> StandardSchemes = {"DCM",  "SCT", "SRT",    "SNM3",
                                                             "UCUM", "FMA", "RADLEX", "LN"};

/// Words that describe CTs of any person.
constexpr std::array<std::string_view, 44> CommonWords = {
    "abdomen",   "airway",   "angio",       "arterial", "axial",  "bone",       "bronchi",
    "chest",     "contrast", "coronal",     "ct",       "cta",    "expiration", "helical",
    "hr",        "hrct",     "inspiration", "iv",       "kernel", "kv",         "lowdose",
    "lung",      "lungs",    "mediastinum", "mm",       "native", "no",         "of",
    "pulmonary", "recon",    "routine",     "sagittal", "scan",   "scout",      "series",
    "sharp",     "soft",     "standard",    "supine",   "thick",  "thin",       "thorax",
    "venous",    "with"};

bool contains(std::span<const std::uint32_t> tags, std::uint32_t tag) {
  return std::ranges::find(tags, tag) != tags.end();
}

std::string keywordOf(std::uint32_t tag) {
  const vtkDICOMDictEntry entry = vtkDICOMDictionary::FindDictEntry(vtkDICOMTag(
      static_cast<unsigned short>(tag >> 16), static_cast<unsigned short>(tag & 0xFFFF)));
  return entry.IsValid() ? entry.GetName() : "attributes that no dictionary knows";
}

std::vector<unsigned char> hmac(std::string_view text, std::string_view key) {
  std::vector<unsigned char> digest(32);
  unsigned int size = 32;
  HMAC(EVP_sha256(), key.data(), static_cast<int>(key.size()),
       reinterpret_cast<const unsigned char*>(text.data()), text.size(), digest.data(), &size);
  return digest;
}

std::string pseudonym(std::string_view id, std::string_view key) {
  std::string patient = "patient ";
  patient += id;
  const std::vector<unsigned char> digest = hmac(patient, key);
  return "ANON-" + hexDigits({digest.data(), 6}, "0123456789ABCDEF");
}

/// The common words, and numbers of up to three digits with or without a unit.
std::string cleaned(const std::string& description) {
  std::string result;
  std::string_view rest = description;
  for (std::string_view word = takeWord(rest); !word.empty(); word = takeWord(rest)) {
    const std::string lower = lowerCase(word);
    std::string_view letters = lower;
    std::size_t digits = 0;
    while (!letters.empty() && (std::isdigit(static_cast<unsigned char>(letters.front())) != 0 ||
                                letters.front() == '.')) {
      digits += letters.front() == '.' ? 0 : 1;
      letters.remove_prefix(1);
    }
    const bool common = std::ranges::find(CommonWords, letters) != CommonWords.end();
    if (digits <= 3 && (common || (letters.empty() && digits > 0))) {
      if (!result.empty()) result += ' ';
      result += word;
    }
  }
  return result;
}

std::string textAt(const DicomDataSet& data, std::uint32_t tag) {
  const auto found = std::ranges::find(data, tag, &DicomElement::tag);
  return found == data.end() ? "" : found->text();
}

bool hasStandardCode(const DicomDataSet& item) {
  const std::string designator = textAt(item, CodingSchemeDesignator);
  return std::ranges::find(StandardSchemes, designator) != StandardSchemes.end();
}

class Anonymizer {
 public:
  Anonymizer(std::string_view key, AnonymizedDicom& result) : key_(key), result_(result) {}

  /// @param codes the data set is an item of a sequence with a code that may stay
  DicomDataSet dataSet(const DicomDataSet& elements, bool codes = false) {
    DicomDataSet kept;
    for (const DicomElement& element : elements) {
      if (element.isPrivate()) {
        ++result_.privateRemoved;
      } else if (!keep(element, codes, kept)) {
        ++result_.removed[keywordOf(element.tag)];
      }
    }
    return kept;
  }

  /// Replaces every UID of a value that is not the standard's.
  std::string uids(const DicomElement& element) {
    std::string text;
    std::string rest = element.text();
    while (true) {
      const std::size_t end = rest.find('\\');
      const std::string uid(trimmed(rest.substr(0, end)));
      if (uid.empty() || uid.starts_with(StandardRoot)) {
        text += uid;
      } else {
        text += anonymizedUid(uid, key_);
        ++result_.uidsReplaced;
      }
      if (end == std::string::npos) return text;
      text += '\\';
      rest.erase(0, end + 1);
    }
  }

 private:
  /// Puts the element, or what becomes of it, into `kept`; false if it goes.
  bool keep(const DicomElement& element, bool codes, DicomDataSet& kept) {
    const std::uint32_t group = element.tag >> 16;
    const std::string& vr = element.vr;
    // Patients, curves, overlays, texts of overlays, padding, signatures.
    const bool telling = group == 0x0010 || group == 0x0012 || group >> 8 == 0x50 ||
                         group >> 8 == 0x60 || group == 0x4000 || group == 0xFFFC;
    if (telling) return false;
    if (vr == "SQ") {
      if (!contains(Sequences, element.tag)) return false;
      DicomElement sequence = element;
      for (DicomDataSet& item : sequence.items) item = dataSet(item, hasStandardCode(item));
      std::erase_if(sequence.items, [](const DicomDataSet& item) { return item.empty(); });
      if (sequence.items.empty()) return false;
      kept.push_back(std::move(sequence));
      return true;
    }
    if (vr == "UI") {
      kept.push_back(dicomText(element.tag, vr, uids(element)));
      return true;
    }
    if (contains(Descriptions, element.tag)) {
      const std::string words = cleaned(element.text());
      if (words.empty()) return false;
      kept.push_back(dicomText(element.tag, vr, words));
      return words == element.text();
    }
    static constexpr std::array<std::string_view, 11> Numbers = {"CS", "DS", "IS", "US", "SS", "UL",
                                                                 "SL", "FL", "FD", "AT", "OF"};
    const bool number = std::ranges::find(Numbers, vr) != Numbers.end();
    // Pixels and look-up tables are the only bytes that a CT needs.
    const bool bytes = element.tag == PixelData || (group == 0x0028 && vr == "OW");
    const bool harmless =
        contains(HarmlessTexts, element.tag) || (codes && contains(Code, element.tag));
    if (!number && !bytes && !harmless) return false;
    kept.push_back(element);
    return true;
  }

  std::string key_;
  AnonymizedDicom& result_;
};

DicomElement code(const std::string& value, const std::string& meaning) {
  DicomElement element;
  element.items.push_back({dicomText(0x00080100, "SH", value), dicomText(0x00080102, "SH", "DCM"),
                           dicomText(0x00080104, "LO", meaning)});
  return element;
}

/// What a file must have all the same, and what says that it was anonymized.
void addRequired(DicomDataSet& data, const std::string& patient) {
  DicomElement method;
  method.tag = 0x00120064;
  method.vr = "SQ";
  method.items = {code("113100", "Basic Application Confidentiality Profile").items.front(),
                  code("113105", "Clean Descriptors Option").items.front()};
  const std::array<DicomElement, 15> required = {
      dicomText(0x00080020, "DA", ""),  // StudyDate
      dicomText(0x00080030, "TM", ""),  // StudyTime
      dicomText(0x00080050, "SH", ""),  // AccessionNumber
      dicomText(0x00080090, "PN", ""),  // ReferringPhysicianName
      dicomText(0x00100010, "PN", patient),
      dicomText(0x00100020, "LO", patient),
      dicomText(0x00100030, "DA", ""),     // PatientBirthDate
      dicomText(0x00100040, "CS", ""),     // PatientSex
      dicomText(0x00120062, "CS", "YES"),  // PatientIdentityRemoved
      dicomText(0x00120063, "LO", "Pneuma: PS3.15 Basic Profile, Clean Descriptors"),
      method,
      dicomText(0x00200010, "SH", ""),         // StudyID
      dicomText(0x00280303, "CS", "REMOVED"),  // LongitudinalTemporalInformationModified
      dicomText(0x00080023, "DA", ""),         // ContentDate
      dicomText(0x00080033, "TM", "")};        // ContentTime
  for (const DicomElement& element : required) {
    std::erase_if(data, [&](const DicomElement& e) { return e.tag == element.tag; });
    data.push_back(element);
  }
  std::ranges::stable_sort(data, {}, &DicomElement::tag);
}

std::string burnedInReason(const DicomDataSet& data) {
  if (textAt(data, 0x00280301) == "YES") return "its header says that text is drawn into it";
  if (textAt(data, 0x00080016).starts_with("1.2.840.10008.5.1.4.1.1.7")) {
    return "it is a secondary capture (a copy of a screen)";
  }
  return "";
}

}  // namespace

std::string anonymizedUid(std::string_view uid, std::string_view key) {
  std::vector<unsigned char> number = hmac(uid, key);
  number.resize(16);
  number[6] = static_cast<unsigned char>((number[6] & 0x0F) | 0x40);  // as a random UUID has it
  number[8] = static_cast<unsigned char>((number[8] & 0x3F) | 0x80);
  std::string digits;
  while (std::ranges::any_of(number, [](unsigned char byte) { return byte != 0; })) {
    unsigned rest = 0;
    for (unsigned char& byte : number) {
      const unsigned value = rest << 8 | byte;
      byte = static_cast<unsigned char>(value / 10);
      rest = value % 10;
    }
    digits += static_cast<char>('0' + rest);
  }
  std::ranges::reverse(digits);
  std::string result = "2.25.";
  result += digits;
  return result;
}

AnonymizedDicom anonymizedDicom(std::string_view file, std::string_view key,
                                const std::string& name) {
  const DicomElements from = dicomElements(file, name);
  AnonymizedDicom result;
  Anonymizer anonymizer(key, result);
  DicomElements to;
  to.isExplicit = from.isExplicit;
  for (const DicomElement& element : from.meta) {
    // The class, the instance and the syntax; who sent it to whom goes.
    if (element.tag == 0x00020002 || element.tag == 0x00020003 || element.tag == 0x00020010) {
      to.meta.push_back(dicomText(element.tag, "UI", anonymizer.uids(element)));
    } else if (element.tag == 0x00020001) {
      to.meta.push_back(element);
    }
  }
  to.meta.push_back(dicomText(0x00020012, "UI", anonymizedUid("Pneuma", "implementation")));
  std::ranges::stable_sort(to.meta, {}, &DicomElement::tag);
  to.data = anonymizer.dataSet(from.data);
  addRequired(to.data, pseudonym(textAt(from.data, 0x00100020), key));
  result.hasPixels = std::ranges::find(to.data, PixelData, &DicomElement::tag) != to.data.end();
  result.seriesUid = textAt(to.data, SeriesUid);
  result.burnedIn = burnedInReason(from.data);
  result.content = dicomFile(to);
  return result;
}

}  // namespace pneuma
