// json_check SCHEMA FILE: exit 0 if the JSON in FILE is as SCHEMA says, 1 with the faults
// otherwise.

#include <fstream>
#include <iostream>

#include "support/json_schema.h"

namespace {

nlohmann::json parsed(const char* path) {
  std::ifstream file(path);
  return nlohmann::json::parse(file);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: json_check SCHEMA FILE\n";
    return 2;
  }
  try {
    const auto faults = pneuma::test::JsonSchema(parsed(argv[1])).faults(parsed(argv[2]));
    for (const std::string& fault : faults) std::cerr << argv[2] << ": " << fault << "\n";
    return faults.empty() ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << argv[2] << ": " << error.what() << "\n";
    return 1;
  }
}
