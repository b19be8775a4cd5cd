#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

/// Files that are damaged, each in one way, made of sound ones; the same every time.
namespace pneuma::damaged {

using Bytes = std::string;
using Change = std::function<Bytes(const Bytes& sound)>;

/// A kind of file that Pneuma reads.
struct Format {
  std::string name;       ///< "stl-binary"
  std::string role;       ///< what commands take it for: "surface", "ct", "tree central", ...
  std::string extension;  ///< with the dot
  std::shared_ptr<const Bytes> sound;
  std::filesystem::path beside;  ///< a folder whose files lie beside it; empty: none
};

/// What Pneuma may do with a file.
enum class Wanted {
  Anything,  ///< refuse it, or read it: what is damaged may be a value among many
  Refused,   ///< nothing of it can be read
  Read,      ///< it is sound
};

struct DamagedFile {
  std::string format;
  std::string role;
  std::string kind;  ///< "cut", "bit-flip", ...
  std::string name;  ///< of the file: kind, what was damaged, extension
  Wanted wanted = Wanted::Anything;
  /// Makes it; the folder exists.
  std::function<void(const std::filesystem::path& file)> write;
};

class Corpus {
 public:
  /// @param detail tells what was damaged, or how much
  void add(const Format& format, const std::string& kind, const std::string& detail, Change change,
           Wanted wanted = Wanted::Anything);
  void addWritten(const Format& format, const std::string& kind, const std::string& detail,
                  Wanted wanted, std::function<void(const std::filesystem::path&)> write);

  const std::vector<DamagedFile>& files() const { return files_; }

 private:
  std::vector<DamagedFile> files_;
};

/// All files, of the sound ones that seeds.sh left in a folder.
Corpus corpusOf(const std::filesystem::path& seeds);

/// What can happen to any file: cut off, emptied, overwritten, flipped bits, and what is no file.
void damageAnyFile(Corpus& corpus, const Format& format, bool cutsShow);

void damageNumbers(Corpus& corpus, const Format& format);
void damageJson(Corpus& corpus, const Format& format);
void damageXml(Corpus& corpus, const Format& format);
void damageStl(Corpus& corpus, const Format& format);
void damageObj(Corpus& corpus, const Format& format);
void damagePly(Corpus& corpus, const Format& format);
void damageSwc(Corpus& corpus, const Format& format);
void damageTable(Corpus& corpus, const Format& format);
void damageNifti(Corpus& corpus, const Format& format);
void damageHeaderLines(Corpus& corpus, const Format& format);
/// The file is one slice of a series; the rest of it lies in `series`.
void damageDicom(Corpus& corpus, const Format& format, const std::filesystem::path& series);
void damageZip(Corpus& corpus, const Format& format);
void damageProject(Corpus& corpus, const Format& format);

/// One way of starting the program with a file. Words of `arguments`: FILE, LOBES (a folder of
/// lobes, one of them the file), LUNGS likewise, SEEDS (the folder of sound files).
struct Command {
  std::string role;
  std::string arguments;
  std::string outputs;  ///< files that must be there if it ends well; "-" for standard output
  bool draws = false;   ///< needs a display
};

const std::vector<Command>& commands();

}  // namespace pneuma::damaged
