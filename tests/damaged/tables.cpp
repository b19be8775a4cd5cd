#include <sstream>

#include "bytes.h"

/// SWC and tables of values.
namespace pneuma::damaged {
namespace {

std::vector<std::string> linesOf(const Bytes& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

Bytes joined(const std::vector<std::string>& lines) {
  Bytes text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

}  // namespace

void damageSwc(Corpus& corpus, const Format& format) {
  // Lines that are not comments: id type x y z radius parent.
  std::vector<std::string> comments;
  std::vector<std::string> points;
  for (const std::string& line : linesOf(*format.sound)) {
    (line.rfind('#', 0) == 0 ? comments : points).push_back(line);
  }
  const auto add = [&](const std::string& detail, std::vector<std::string> changed) {
    corpus.add(format, "swc", detail,
               [text = joined(comments) + joined(changed)](const Bytes&) { return text; });
  };
  const auto with = [&](std::size_t at, const std::string& line) {
    std::vector<std::string> changed = points;
    changed.at(at) = line;
    return changed;
  };
  const std::string last = std::to_string(points.size());
  add("cycle", with(0, "1 0 0 0 100 9 " + last));
  add("own-parent", with(3, "4 0 0 0 100 9 4"));
  add("two-roots", with(5, "6 0 0 0 100 9 -1"));
  add("no-root", with(0, "1 0 0 0 100 9 2"));
  add("parent-missing", with(5, "6 0 0 0 100 9 99999"));
  add("parent-1e18", with(5, "6 0 0 0 100 9 1000000000000000000"));
  add("id-twice", with(5, "5 0 0 0 100 9 1"));
  add("id-negative", with(5, "-7 0 0 0 100 9 1"));
  add("id-1e18", with(points.size() - 1, "1000000000000000000 0 0 0 100 9 1"));
  add("radius-0", with(2, "3 0 0 0 100 0 1"));
  add("radius-negative", with(2, "3 0 0 0 100 -2 1"));
  add("radius-nan", with(2, "3 0 0 0 100 nan 1"));
  add("x-infinite", with(2, "3 0 inf 0 100 2 1"));
  add("x-1e200", with(2, "3 0 1e200 0 100 2 1"));
  add("columns-6", with(2, "3 0 0 0 100 2"));
  add("columns-9", with(2, "3 0 0 0 100 2 1 7 8"));
  add("no-point", {});
  add("one-point", {points[0]});
  std::vector<std::string> chain = {"1 0 0 0 0 5 -1"};
  for (int i = 2; i <= 50000; ++i) {
    const std::string id = std::to_string(i);
    chain.push_back(id + " 0 0 0 " + id + " 5 " + std::to_string(i - 1));
  }
  add("chain-of-50000", chain);
  std::vector<std::string> star = {"1 0 0 0 0 5 -1", "2 0 0 0 50 5 1"};
  for (int i = 3; i <= 5000; ++i)
    star.push_back(std::to_string(i) + " 0 1 " + std::to_string(i) + " 99 1 2");
  add("star-of-5000", star);
}

void damageTable(Corpus& corpus, const Format& format) {
  const std::vector<std::string> lines = linesOf(*format.sound);
  const auto add = [&](const std::string& detail, const auto& change) {
    corpus.add(format, "table", detail, [change, lines](const Bytes&) {
      std::vector<std::string> changed = lines;
      change(changed);
      return joined(changed);
    });
  };
  using Rows = std::vector<std::string>;
  add("no-heading", [](Rows& rows) { rows.erase(rows.begin()); });
  add("heading-alone", [](Rows& rows) { rows.resize(1); });
  add("heading-twice", [](Rows& rows) { rows.insert(rows.begin() + 1, rows[0]); });
  add("column-twice", [](Rows& rows) { rows[0] = rows[0] + "," + rows[0]; });
  add("column-renamed", [](Rows& rows) { rows[0][0] = '?'; });
  add("value-more", [](Rows& rows) { rows.back() += ",5"; });
  add("value-less", [](Rows& rows) { rows.back().erase(rows.back().rfind(',')); });
  add("quotation-open", [](Rows& rows) { rows[1].insert(0, "\""); });
  add("values-100000", [](Rows& rows) { rows[1] += repeated(",1", 100000); });
  add("value-of-1-mb", [](Rows& rows) { rows[1].insert(0, Bytes(1000000, '7')); });
  add("row-twice", [](Rows& rows) { rows.push_back(rows.back()); });
  add("rows-turned", [](Rows& rows) { std::swap(rows[1], rows.back()); });
  add("semicolons", [](Rows& rows) {
    for (std::string& row : rows) {
      for (char& c : row) {
        if (c == ',') c = ';';
      }
    }
  });
  add("decimal-commas", [](Rows& rows) {
    for (std::string& row : rows) {
      for (char& c : row) {
        if (c == '.') c = ',';
      }
    }
  });
  add("nul", [](Rows& rows) { rows[1].insert(2, 1, '\0'); });
}

}  // namespace pneuma::damaged
