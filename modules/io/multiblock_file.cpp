#include "io/multiblock_file.h"

#include "io/atomic_file.h"

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

}  // namespace pneuma
