#include "io/multiblock_file.h"

#include "io/atomic_file.h"
#include "io/detail/text_fields.h"
#include "io/json.h"

namespace pneuma {
namespace {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

}  // namespace

void writeMultiblock(const std::filesystem::path& path, const std::vector<Block>& blocks) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "  <vtkMultiBlockDataSet>\n";
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    text += "    <DataSet index=\"" + std::to_string(i) + "\" name=\"" + escaped(blocks[i].name) +
            "\" file=\"" + escaped(blocks[i].file.generic_string()) + "\"/>\n";
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
            escaped(file.file.generic_string()) + "\"/>\n";
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
  writeFile(path, series.dump(2) + "\n");
}

}  // namespace pneuma
