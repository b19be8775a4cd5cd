#!/usr/bin/env bash
# Which lines of the modules their tests run, all together with those of the command line: builds the preset `coverage`,
# runs the tests of every module but `render` and eleven of the program, prints a table. Ends with an error if a module
# falls under 85 % of its lines. Needs gcovr (`apt install gcovr`).
#   packaging/coverage.sh            the table; each line of each file is in build/coverage/lines/index.html
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
least=85
command -v gcovr >/dev/null || {
  echo "coverage.sh: gcovr is not installed; apt install gcovr" >&2
  exit 2
}
find build/coverage -name '*.gcda' -delete 2>/dev/null || true # of runs before
cmake --workflow --preset coverage

mkdir -p build/coverage/lines
gcovr --root . --filter modules/ --exclude modules/render/ --exclude-unreachable-branches -j 2 \
  --csv build/coverage/lines.csv --html-details build/coverage/lines/index.html build/coverage >/dev/null
awk -F, -v least=$least '
  NR == 1 { for (i = 1; i <= NF; i++) column[$i] = i; next }
  {
    split($column["filename"], part, "/")
    lines[part[2]] += $column["line_total"]; run[part[2]] += $column["line_covered"]
    allLines += $column["line_total"]; allRun += $column["line_covered"]
  }
  END {
    printf "%-14s %8s %8s %7s\n", "module", "lines", "run", "%"
    fflush()
    for (module in lines) {
      share = 100 * run[module] / lines[module]
      printf "%-14s %8d %8d %7.1f\n", module, lines[module], run[module], share | "sort"
      if (share < least) under = under " " module
    }
    close("sort")
    if (allLines == 0) { print "coverage.sh: nothing was measured"; exit 1 }
    printf "%-14s %8d %8d %7.1f\n", "all", allLines, allRun, 100 * allRun / allLines
    if (under != "") { print "coverage.sh: under " least " % of lines:" under; exit 1 }
  }' build/coverage/lines.csv
