#include "io/multiblock_file.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include <vtkNew.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/detail/text_fields.h"
#include "io/detail/vtk_errors.h"
#include "io/detail/vtk_xml.h"
#include "io/json.h"
#include "io/markup_text.h"

namespace pneuma {
namespace {

constexpr std::size_t LargestCollection = std::size_t{64} << 20;

std::string attributeOf(vtkXMLDataElement& element, const char* key) {
  const char* value = element.GetAttribute(key);
  return value == nullptr ? std::string() : std::string(value);
}

std::string fileAttribute(const std::filesystem::path& file) {
  return " file=\"" + markupEscaped(file.generic_string()) + "\"";
}

TimedFile timedFile(vtkXMLDataElement& element, const std::string& collection) {
  TimedFile file;
  file.file = attributeOf(element, "file");
  const std::string time = attributeOf(element, "timestep");
  const std::optional<double> seconds = parseDouble(time);
  if (file.file.empty() || !seconds || !std::isfinite(*seconds)) {
    throw InvalidInput(collection + " has an entry without a file or a moment; get it anew");
  }
  const std::filesystem::path inside = file.file.lexically_normal();
  if (inside.is_absolute() || *inside.begin() == "..") {
    throw InvalidInput(collection + " names '" + file.file.string() +
                       "', which lies outside its folder; such files are not followed");
  }
  file.seconds = *seconds;
  file.part = static_cast<int>(parseInteger(attributeOf(element, "part")).value_or(0));
  return file;
}

}  // namespace

std::vector<TimedFile> readTimeCollection(const std::filesystem::path& path) {
  const std::string name = quoted(path);
  const std::string content = readFile(path, LargestCollection);
  requireFlatXml(content, name);
  std::istringstream stream(content);
  vtkNew<vtkXMLDataParser> parser;
  const VtkErrors errors(*parser);
  parser->SetStream(&stream);
  const bool parsed = parser->Parse() != 0 && errors.first().empty();
  vtkXMLDataElement* root = parsed ? parser->GetRootElement() : nullptr;
  vtkXMLDataElement* collection =
      root == nullptr ? nullptr : root->FindNestedElementWithName("Collection");
  if (collection == nullptr) {
    throw InvalidInput(name + " is no ParaView collection of files, or is damaged; get it anew");
  }
  std::vector<TimedFile> files;
  for (int n = 0; n < collection->GetNumberOfNestedElements(); ++n) {
    files.push_back(timedFile(*collection->GetNestedElement(n), name));
  }
  if (files.empty()) throw InvalidInput(name + " names no file; there is nothing to show");
  std::ranges::stable_sort(files, {}, [](const TimedFile& f) { return f.seconds; });
  return files;
}

void writeMultiblock(const std::filesystem::path& path, const std::vector<Block>& blocks) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "  <vtkMultiBlockDataSet>\n";
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const std::string place =
        " index=\"" + std::to_string(i) + "\" name=\"" + markupEscaped(blocks[i].name) + "\"";
    const auto& files = blocks[i].files;
    if (files.size() == 1) {
      text += "    <DataSet" + place + fileAttribute(files.front()) + "/>\n";
      continue;
    }
    text += "    <Piece" + place + ">\n";
    for (std::size_t k = 0; k < files.size(); ++k) {
      text +=
          "      <DataSet index=\"" + std::to_string(k) + "\"" + fileAttribute(files[k]) + "/>\n";
    }
    text += "    </Piece>\n";
  }
  text += "  </vtkMultiBlockDataSet>\n</VTKFile>\n";
  writeFile(path, text);
}

void writeTimeCollection(const std::filesystem::path& path, const std::vector<TimedFile>& files) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (const TimedFile& file : files) {
    text += "    <DataSet timestep=\"";
    appendNumber(text, file.seconds);
    text += "\" group=\"\" part=\"" + std::to_string(file.part) + "\" file=\"" +
            markupEscaped(file.file.generic_string()) + "\"/>\n";
  }
  text += "  </Collection>\n</VTKFile>\n";
  writeFile(path, text);
}

void writeFileSeries(const std::filesystem::path& path, const std::vector<TimedFile>& files,
                     int part) {
  Json series = {{"file-series-version", "1.0"}, {"files", Json::array()}};
  for (const TimedFile& file : files) {
    if (file.part != part) continue;
    series["files"].push_back({{"name", file.file.generic_string()}, {"time", file.seconds}});
  }
  writeFile(path, series.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace pneuma
