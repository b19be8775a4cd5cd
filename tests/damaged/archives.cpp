#include "bytes.h"

/// Zip archives: of DICOM files, and projects.
namespace pneuma::damaged {
namespace {

using Members = std::vector<Member>;

Change members(const std::function<void(Members&)>& change) {
  return [change](const Bytes& archive) {
    Members changed = unzip(archive);
    change(changed);
    return zip(changed);
  };
}

/// Writes behind the last mark "PK\5\6", where the archive says how it ends.
Change end(std::size_t at, const Bytes& part) {
  return [=](const Bytes& archive) {
    return overwritten(archive, archive.rfind("PK\5\6") + at, part);
  };
}

/// Writes behind the first mark "PK\1\2", where the directory says of the first member.
Change directory(std::size_t at, const Bytes& part) {
  return [=](const Bytes& archive) {
    return overwritten(archive, littleAt(archive, archive.rfind("PK\5\6") + 16, 4) + at, part);
  };
}

}  // namespace

void damageZip(Corpus& corpus, const Format& format) {
  const auto add = [&](const std::string& detail, Change change, Wanted wanted = Wanted::Anything) {
    corpus.add(format, "zip", detail, std::move(change), wanted);
  };
  const auto named = [&](const std::string& detail, const std::string& name) {
    add("name-" + detail, members([name](Members& all) { all.push_back({name, "evil"}); }));
  };
  named("up", "../../evil");
  named("up-inside", "a/../../../evil");
  named("from-root", "/etc/evil");
  named("backslashes", "..\\..\\evil");
  named("of-drive", "C:\\evil");
  named("empty", "");
  named("dots", "..");
  named("nul", Bytes("a\0b", 3));
  named("60000", Bytes(60000, 'n'));
  named("folders-10000", repeated("a/", 10000) + "b");
  named("no-utf8", "\xE4\xFF\xFE");
  named("line-break", "a\nb");
  add("link-out", members([](Members& all) {
        all.push_back({"link", "/etc/passwd", false, -1, -1, 0, false, 0xA1FF0000U});
        all.push_back({"link/evil", "x"});
      }));
  add("member-twice", members([](Members& all) { all.push_back(all.front()); }));
  add("no-members", members([](Members& all) { all.clear(); }), Wanted::Refused);
  add("members-60000", members([](Members& all) {
        for (int i = 0; i < 60000; ++i) all.push_back({std::to_string(i) + ".x", "", false});
      }));
  add("bomb-1-gb",
      members([](Members& all) { all.push_back(zeros("zeros", std::size_t{1} << 30)); }));
  add("bomb-says-little", members([](Members& all) {
        all.push_back(zeros("zeros", std::size_t{1} << 28));
        all.back().size = 100;
      }));
  add("bomb-of-100", members([](Members& all) {
        for (int i = 0; i < 100; ++i) all.push_back(zeros(std::to_string(i), std::size_t{1} << 24));
      }));
  for (const std::int64_t size :
       {std::int64_t{0}, std::int64_t{1}, std::int64_t{0x7FFFFFFF}, std::int64_t{0xFFFFFFFE}}) {
    add("size-says-" + std::to_string(size),
        members([size](Members& all) { all.front().size = size; }));
  }
  add("checksum", members([](Members& all) { all.front().crcLies = true; }), Wanted::Refused);
  add("method-99", members([](Members& all) { all.front().method = 99; }));
  add("method-stored", members([](Members& all) { all.front().method = 0; }));
  add("encrypted", members([](Members& all) { all.front().flags = 1; }), Wanted::Refused);
  add("size-behind", members([](Members& all) { all.front().flags = 8; }));
  add("count-0", end(8, little(0, 4)));
  add("count-65535", end(8, little(0xFFFFFFFF, 4)));
  add("directory-size-all", end(12, little(0xFFFFFFFF, 4)));
  add("directory-at-0", end(16, little(0, 4)));
  add("directory-at-end", end(16, little(0xFFFFFFFF, 4)));
  add("comment-longer", end(20, little(0xFFFF, 2)));
  add("packed-size-all", directory(20, little(0xFFFFFFFF, 4)));
  add("name-longer", directory(28, little(0xFFFF, 2)));
  add("extra-longer", directory(30, little(0xFFFF, 2)));
  add("member-at-end", directory(42, little(0xFFFFFFF0, 4)));
  add("member-at-1", directory(42, little(1, 4)));
  add("no-directory", [](const Bytes& archive) {
    return archive.substr(0, littleAt(archive, archive.rfind("PK\5\6") + 16, 4));
  });
  add("in-a-zip", [](const Bytes& archive) { return zip({{"inner.zip", archive}}); });
  for (const std::size_t member : {0U, 1U, 2U}) {
    add("without-member-" + std::to_string(member), members([member](Members& all) {
          if (member < all.size()) all.erase(all.begin() + static_cast<std::ptrdiff_t>(member));
        }));
    add("empty-member-" + std::to_string(member), members([member](Members& all) {
          if (member < all.size()) all[member].content.clear();
        }));
  }
}

void damageProject(Corpus& corpus, const Format& format) {
  // What damages JSON damages the list of everything in the archive.
  const Members sound = unzip(*format.sound);
  Format state = format;
  state.sound = std::make_shared<const Bytes>(sound.front().content);
  Corpus ofState;
  damageJson(ofState, state);
  damageNumbers(ofState, state);
  const auto packInto = [&](const DamagedFile& damaged, std::size_t at) {
    corpus.addWritten(format, "state", damaged.name.substr(0, damaged.name.find(format.extension)),
                      damaged.wanted, [sound, at, damaged](const std::filesystem::path& file) {
                        damaged.write(file);
                        Members changed = sound;
                        changed[at].content = contentOf(file);
                        writeContent(file, zip(changed));
                      });
  };
  for (const DamagedFile& damaged : ofState.files()) packInto(damaged, 0);
  for (std::size_t at = 1; at < sound.size(); ++at) {
    std::string name = sound[at].name;
    for (char& c : name) c = c == '/' ? '_' : c;
    const auto add = [&](const std::string& detail, const std::function<Bytes(Bytes)>& change) {
      corpus.add(format, "member", detail + "-" + name, members([at, change](Members& all) {
                   all[at].content = change(all[at].content);
                 }));
    };
    add("cut", [](Bytes bytes) { return bytes.substr(0, bytes.size() / 2); });
    add("gone", [](const Bytes&) { return Bytes(); });
    add("text", [](const Bytes&) { return Bytes("just some text\n"); });
    add("flipped", [](Bytes bytes) {
      bytes[bytes.size() / 3] ^= 0x41;
      return bytes;
    });
    add("head-flipped", [](Bytes bytes) {
      bytes[std::min<std::size_t>(bytes.size() - 1, 70)] ^= 0x11;
      return bytes;
    });
  }
}

}  // namespace pneuma::damaged
