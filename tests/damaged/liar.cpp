// A program that fails as LIAR says, whatever it is asked to do: what the runner must notice.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

int main(int argc, char** argv) {
  const char* said = std::getenv("LIAR");
  const std::string way = said == nullptr ? "" : said;
  std::string file;
  std::string output;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.rfind("in/", 0) == 0) file = word;
    if (word == "-o" && i + 1 < argc) output = argv[i + 1];
  }
  const auto refuse = [&](const std::string& name) {
    std::fprintf(stderr, "pneuma: \"%s\" is damaged\n", name.c_str());
  };
  if (way == "signal") std::raise(SIGSEGV);
  if (way == "hang") std::this_thread::sleep_for(std::chrono::seconds(60));
  if (way == "memory") {
    const std::vector<char> much(std::size_t{200} << 20, 'x');
    refuse(file + (much[much.size() / 2] == 'x' ? "" : " "));
    return 4;
  }
  if (way == "nothing") return 0;
  if (way == "empty-output") {
    if (output.empty()) return 0;
    std::ofstream(output).flush();
    return 0;
  }
  if (way == "silent") return 4;
  if (way == "two-lines") refuse(file);
  if (way == "nameless") {
    refuse("something");
    return 4;
  }
  if (way == "bug") return 1;
  if (way == "left-behind") std::ofstream("half-a-tree.vtp") << "x";
  if (way == "temporary") std::ofstream(std::string(std::getenv("TMPDIR")) + "/x") << "x";
  if (way == "beside-input") std::ofstream("in/x") << "x";
  if (way == "result") std::puts("a result");
  if (way == "reads-all") {
    std::puts("a result");
    if (!output.empty()) std::ofstream(output) << "x";
    return 0;
  }
  refuse(file);
  return 4;
}
