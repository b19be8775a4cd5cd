// person plant FOLDER: puts a person into every DICOM file of the folder, in place: names, numbers,
// dates, places,
//   UIDs and private text, each of which can be told from everything else.
// person find FOLDER [DIR]: prints every file below the folder, and every member of its zips and
// what is gzipped or packed in a PDF, that
//   holds anything of that person, with DIR (the person's own folder) as one more thing; ends with
//   1 if there is any.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <regex>
#include <string>
#include <vector>

#include <archive.h>
#include <archive_entry.h>
#include <zlib.h>

namespace {

namespace fs = std::filesystem;

struct Planted {
  std::uint32_t tag;
  const char* vr;
  std::string value;  ///< of even length
};

// What a hospital's scanner writes of a person, and of who sent, saw and scanned them.
const std::vector<Planted> Person = {
    {0x00080020, "DA", "19770707"},           {0x00080021, "DA", "19770707"},
    {0x00080050, "SH", "PLANTEDACC"},         {0x00080080, "LO", "PLANTED HOSPITAL"},
    {0x00080081, "ST", "PLANTEDPLACE"},       {0x00080090, "PN", "PLANTED^DOCTOR"},
    {0x00081010, "SH", "PLANTEDSCANS"},       {0x00081070, "PN", "PLANTEDWORKERS"},
    {0x0008103E, "LO", "LUNG^DOEPLANT 1.0 "}, {0x00090010, "LO", "PLANTEDPRIV1"},
    {0x00091001, "LO", "PLANTEDPRIV2"},       {0x00100010, "PN", "DOEPLANT^JANE "},
    {0x00100020, "LO", "PLANTED-ID"},         {0x00100030, "DA", "19310213"},
    {0x00101040, "LO", "PLANTED STREET"},     {0x00102154, "SH", "0800PLANTED77 "},
    {0x00104000, "LT", "PLANTED COMMENTS"},   {0x00180030, "ST", "PLANTEDNOTES"},
    {0x00200010, "SH", "PLANTEDS"},           {0x00321060, "LO", "PLANTED SCAN"},
};

const Planted Inside = {0x00400007, "LO", "PLANTED BY DOEPLANT "};
constexpr std::uint32_t SequenceTag = 0x00400275;

const std::vector<std::string> Traces = {"PLANTED",    "planted",  "DOEPLANT",  "19310213",
                                         "1931-02-13", "19770707", "2.25.77777"};

bool hasLongLength(const std::string& vr) {
  for (const char* name : {"OB", "OW", "OF", "OD", "OL", "SQ", "UN", "UT", "UC", "UR"}) {
    if (vr == name) return true;
  }
  return false;
}

std::uint32_t number(const std::string& bytes, std::size_t at, int size) {
  std::uint32_t value = 0;
  for (int i = 0; i < size; ++i) {
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes.at(at + i))) << (8 * i);
  }
  return value;
}

std::string ofTwoBytes(std::size_t value) {
  return {static_cast<char>(value & 0xFFU), static_cast<char>((value >> 8U) & 0xFFU)};
}

std::string ofFourBytes(std::size_t value) {
  return ofTwoBytes(value & 0xFFFFU) + ofTwoBytes(value >> 16U);
}

std::string bytesOf(std::uint32_t tag) {
  return ofTwoBytes(tag >> 16U) + ofTwoBytes(tag & 0xFFFFU);
}

std::string element(const Planted& planted) {
  return bytesOf(planted.tag) + planted.vr + ofTwoBytes(planted.value.size()) + planted.value;
}

/// A sequence of one item with one element: what was asked for (Request Attributes).
std::string sequence(const Planted& planted) {
  const std::string inside = element(planted);
  const std::string item = bytesOf(0xFFFEE000U) + ofFourBytes(inside.size()) + inside;
  return bytesOf(SequenceTag) + "SQ" + ofTwoBytes(0) + ofFourBytes(item.size()) + item;
}

/// `file` is explicit little endian without sequences, as `pneuma sample --ct` writes it.
std::string withPerson(const std::string& file) {
  const std::size_t Begin = 132;  // after the preamble and DICM
  std::map<std::uint32_t, std::string> elements;
  for (std::size_t at = Begin; at + 8 <= file.size();) {
    const std::uint32_t tag = number(file, at, 2) << 16U | number(file, at + 2, 2);
    const bool isLong = hasLongLength(file.substr(at + 4, 2));
    const std::size_t head = isLong ? 12 : 8;
    const std::size_t size = isLong ? number(file, at + 8, 4) : number(file, at + 6, 2);
    elements[tag] = file.substr(at, head + size);
    at += head + size;
  }
  for (const Planted& planted : Person) elements[planted.tag] = element(planted);
  elements[SequenceTag] = sequence(Inside);
  std::string result = file.substr(0, Begin);
  for (const auto& [tag, bytes] : elements) result += bytes;
  // UIDs keep their length.
  return std::regex_replace(result, std::regex("2\\.25\\.[0-9]{5}"), "2.25.77777");
}

std::string contentOf(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

int plant(const fs::path& folder) {
  int files = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string changed = withPerson(contentOf(entry.path()));
    std::ofstream(entry.path(), std::ios::binary | std::ios::trunc) << changed;
    ++files;
  }
  std::cout << files << " files have a person now\n";
  return files > 0 ? 0 : 2;
}

/// As text and as UTF-16, which settings of Qt may hold.
std::string firstTrace(const std::string& content, const std::vector<std::string>& traces) {
  for (const std::string& trace : traces) {
    std::string wide;
    for (const char c : trace) wide += {c, '\0'};
    wide.pop_back();
    if (content.find(trace) != std::string::npos || content.find(wide) != std::string::npos) {
      return trace;
    }
  }
  return "";
}

/// What the packed streams of a PDF hold.
std::string unpackedPdf(const std::string& content) {
  std::string text;
  const std::string begin = "stream\r\n";
  for (std::size_t at = content.find(begin); at != content.npos; at = content.find(begin, at + 1)) {
    z_stream stream = {};
    if (inflateInit(&stream) != Z_OK) continue;
    std::string packed = content.substr(at + begin.size());
    stream.next_in = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_in = static_cast<uInt>(packed.size());
    std::vector<char> piece(1U << 16U);
    for (int code = Z_OK; code == Z_OK;) {
      stream.next_out = reinterpret_cast<Bytef*>(piece.data());
      stream.avail_out = static_cast<uInt>(piece.size());
      code = inflate(&stream, Z_NO_FLUSH);
      text.append(piece.data(), piece.size() - stream.avail_out);
    }
    inflateEnd(&stream);
  }
  return text;
}

/// (name, content) of what an archive, a gzipped file or a PDF holds.
std::vector<std::pair<std::string, std::string>> members(const std::string& content) {
  std::vector<std::pair<std::string, std::string>> found;
  if (content.starts_with("%PDF")) return {{"text", unpackedPdf(content)}};
  if (!content.starts_with("PK") && !content.starts_with("\x1f\x8b")) return found;
  const std::unique_ptr<archive, decltype(&archive_read_free)> reader(archive_read_new(),
                                                                      archive_read_free);
  archive_read_support_filter_all(reader.get());
  archive_read_support_format_zip(reader.get());
  archive_read_support_format_raw(reader.get());
  if (archive_read_open_memory(reader.get(), content.data(), content.size()) != ARCHIVE_OK) {
    return {{"unreadable", "PLANTED"}};
  }
  archive_entry* entry = nullptr;
  while (archive_read_next_header(reader.get(), &entry) == ARCHIVE_OK) {
    std::string text;
    std::vector<char> piece(1U << 20U);
    for (la_ssize_t n = 0; (n = archive_read_data(reader.get(), piece.data(), piece.size())) > 0;) {
      text.append(piece.data(), static_cast<std::size_t>(n));
    }
    found.emplace_back(archive_entry_pathname(entry), text);
  }
  return found;
}

int find(const fs::path& folder, const std::vector<std::string>& traces) {
  int files = 0;
  int places = 0;
  const auto look = [&](const std::string& name, const std::string& content) {
    const std::string trace = firstTrace(content, traces);
    if (trace.empty()) return;
    std::cout << name << ": " << trace << "\n";
    ++places;
  };
  std::vector<fs::path> paths;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  for (const fs::path& path : paths) {
    const std::string name = path.lexically_relative(folder).string();
    look(name + " (its name)", name);
    if (!fs::is_regular_file(fs::symlink_status(path))) continue;
    ++files;
    const std::string content = contentOf(path);
    look(name, content);
    for (const auto& [member, text] : members(content)) look(name + ":" + member, text);
  }
  std::cerr << files << " files looked through\n";
  if (files == 0) return 2;
  return places > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() == 2 && arguments[0] == "plant") return plant(arguments[1]);
  if (arguments.size() >= 2 && arguments[0] == "find") {
    std::vector<std::string> traces = Traces;
    traces.insert(traces.end(), arguments.begin() + 2, arguments.end());
    return find(arguments[1], traces);
  }
  std::cerr << "usage: person plant FOLDER | person find FOLDER [DIR]\n";
  return 2;
}
