#include <algorithm>
#include <stdexcept>

#include <sys/stat.h>

#include "bytes.h"

namespace pneuma::damaged {
namespace fs = std::filesystem;

void Corpus::add(const Format& format, const std::string& kind, const std::string& detail,
                 Change change, Wanted wanted) {
  addWritten(format, kind, detail, wanted,
             [sound = format.sound, change = std::move(change)](const fs::path& file) {
               writeContent(file, change(*sound));
             });
}

void Corpus::addWritten(const Format& format, const std::string& kind, const std::string& detail,
                        Wanted wanted, std::function<void(const fs::path&)> write) {
  const std::string name = kind + (detail.empty() ? "" : "-" + detail) + format.extension;
  files_.push_back({format.name, format.role, kind, name, wanted,
                    [beside = format.beside, write = std::move(write)](const fs::path& file) {
                      write(file);
                      if (beside.empty()) return;
                      for (const auto& entry : fs::directory_iterator(beside)) {
                        const fs::path link = file.parent_path() / entry.path().filename();
                        if (!fs::exists(fs::symlink_status(link))) {
                          fs::create_symlink(entry.path(), link);
                        }
                      }
                    }});
}

namespace {

void link(const std::string& to, const fs::path& file) { fs::create_symlink(to, file); }

/// What stands where a file should be.
void addNoFiles(Corpus& corpus, const Format& format) {
  const auto add = [&](const std::string& detail, const auto& write) {
    corpus.addWritten(format, "no-file", detail, Wanted::Refused, write);
  };
  add("pipe", [](const fs::path& file) {
    if (mkfifo(file.c_str(), 0600) != 0) throw std::runtime_error("cannot make a pipe");
  });
  add("device", [](const fs::path& file) { link("/dev/zero", file); });
  add("folder", [](const fs::path& file) { fs::create_directory(file); });
  add("link-to-itself", [](const fs::path& file) { link(file.filename().string(), file); });
  add("link-to-nothing", [](const fs::path& file) { link("is-not-there", file); });
}

void addNames(Corpus& corpus, const Format& format) {
  const Change same = [](const Bytes& sound) { return sound; };
  corpus.add(format, "sound", "", same, Wanted::Read);
  corpus.add(format, "name", "Lunge-ä-肺-\xF0\x9F\xAB\x81", same, Wanted::Read);
  corpus.add(format, "name", "two  blanks ", same, Wanted::Read);
  corpus.add(format, "name", "no-utf8-\xE4\xFF", same, Wanted::Read);
  corpus.add(format, "name", "line\nbreak", same, Wanted::Anything);
}

}  // namespace

void damageAnyFile(Corpus& corpus, const Format& format, bool cutsShow) {
  addNames(corpus, format);
  addNoFiles(corpus, format);
  const Wanted ofCuts = cutsShow ? Wanted::Refused : Wanted::Anything;
  for (const std::size_t part : {1U, 7U, 20U, 33U, 46U, 57U, 63U}) {
    corpus.add(
        format, "cut", std::to_string(part) + "of64",
        [part](const Bytes& sound) { return sound.substr(0, sound.size() * part / 64); }, ofCuts);
  }
  corpus.add(
      format, "cut", "last-3-bytes",
      [](const Bytes& sound) { return sound.substr(0, sound.size() - 3); }, ofCuts);
  corpus.add(
      format, "empty", "", [](const Bytes&) { return Bytes(); }, Wanted::Refused);
  corpus.add(
      format, "one-byte", "", [](const Bytes& sound) { return sound.substr(0, 1); },
      Wanted::Refused);
  corpus.add(
      format, "zeros", "all", [](const Bytes& sound) { return Bytes(sound.size(), '\0'); },
      Wanted::Refused);
  corpus.add(format, "zeros", "first-64", [](const Bytes& sound) {
    return overwritten(sound, 0, Bytes(std::min<std::size_t>(64, sound.size()), '\0'));
  });
  corpus.add(format, "garbage", "", [](const Bytes& sound) {
    Dice dice(sound.size());
    Bytes bytes(std::min<std::size_t>(sound.size(), 5000), ' ');
    for (char& c : bytes) c = static_cast<char>(dice.below(256));
    return bytes;
  });
  corpus.add(
      format, "text", "", [](const Bytes&) { return Bytes("just some text\n"); }, Wanted::Refused);
  corpus.add(format, "doubled", "", [](const Bytes& sound) { return sound + sound; });
  corpus.add(format, "huge-line", "",
             [](const Bytes& sound) { return sound + Bytes(std::size_t{1} << 21, 'A') + "\n"; });
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    corpus.add(format, "bit-flip", std::to_string(seed), [seed](Bytes bytes) {
      Dice dice(seed + bytes.size());
      // Half of them near the beginning, where headers are.
      const std::uint64_t range =
          seed % 2 == 1 ? std::min<std::size_t>(bytes.size(), 400) : bytes.size();
      for (std::uint64_t i = 0; i < seed; ++i) {
        bytes[dice.below(range)] ^= static_cast<char>(1U << dice.below(8));
      }
      return bytes;
    });
  }
}

void damageNumbers(Corpus& corpus, const Format& format) {
  const std::vector<Span> numbers = numbersIn(*format.sound);
  if (numbers.empty()) return;
  std::size_t turn = 0;
  for (const auto& [name, value] : nastyNumbers()) {
    // First, middle and last places take turns, and one is always near the beginning.
    const std::size_t n = numbers.size();
    const std::size_t places[] = {turn % std::min<std::size_t>(n, 7), n / 2 + turn % (n - n / 2)};
    ++turn;
    for (const std::size_t place : places) {
      corpus.add(format, "number", std::to_string(place) + "-" + name,
                 [span = numbers[place], text = value](Bytes bytes) {
                   return bytes.replace(span.at, span.size, text);
                 });
      if (places[0] == places[1]) break;
    }
  }
}

}  // namespace pneuma::damaged
