#!/usr/bin/env bash
# Installs what is missing, builds the preset `release` with two jobs and runs every check and test,
# those that draw under Xvfb. Closes with ctest's summary; ends with an error if a test failed or
# none ran. Real data are used where ../shared/data stands beside the project, or where
# PNEUMA_TEST_DATA points; without them the tests run on generated data.
#   packaging/test.sh           what CI runs, and what checks the benchmarks' page, which CI does not build
#   packaging/test.sh --full    that and the rest, some hours: every damaged file, every fault, three runs of everything
#                               for each number of threads, commands of the pages as they stand, 1,000 actions by
#                               chance, a window opened and closed 200 times, under sanitizers what neither draws
#                               nor is slow, a minute of fuzzing for each format, and lines that tests run
set -euo pipefail
full=
case ${1:-} in
  '') ;;
  --full) full=1 ;;
  *)
    echo "test.sh: there is no option '$1'; usage: packaging/test.sh [--full]" >&2
    exit 2
    ;;
esac
cd "$(dirname "${BASH_SOURCE[0]}")/.."

step() { printf '\n== %s (at %d s)\n' "$1" "$SECONDS"; }

# A style check that finds something, or cannot look, ends the run in CI and with --full, and is only reported elsewhere.
style_failed() {
  echo "test.sh: $1" >&2
  [[ -z ${CI:-}$full ]] || exit 1
}

# One line for what passed, by the folder of tests/ that it is from, and one for what was skipped.
summary() {
  sed -nE 's/^.* Test +#[0-9]+: ([^ ]+).*\*\*\*Skipped .*$/\1/p' "$1" | awk '{ text = text " " $1 } END { if (NR) print "skipped:" text }'
  sed -nE 's/^.* Test +#[0-9]+: ([a-z0-9-]+).* Passed .*$/\1/p' "$1" | sort | uniq -c |
    awk '{ all += $1; text = text (NR > 1 ? ", " : "") $2 " " $1 } END { print "passed: " all " (" text ")" }'
  echo "test.sh: done after $SECONDS s"
}

step "Dependencies"
# In CI and for --full nothing is left out for want of a tool.
tools=()
[[ -z ${CI:-} ]] || tools=(--style)
[[ -z $full ]] || tools=(--full)
packaging/install-dependencies.sh "${tools[@]}"

if [[ -z ${PNEUMA_TEST_DATA:-} && -d ../shared/data ]]; then
  PNEUMA_TEST_DATA=$(cd ../shared/data && pwd)
fi
export PNEUMA_TEST_DATA=${PNEUMA_TEST_DATA:-}
echo "real data: ${PNEUMA_TEST_DATA:-none, generated data only}"

step "Style"
formatter=$(clang-format --version 2>/dev/null || true)
if [[ $formatter == *'version 14.'* ]]; then
  find modules app tests -name '*.h' -print0 -o -name '*.cpp' -print0 |
    xargs -0 clang-format --dry-run --Werror ||
    style_failed "clang-format would change these places; see CONTRIBUTING.md, Style"
else
  style_failed "clang-format 14 is not installed; formatting is not checked"
fi
if command -v codespell >/dev/null; then
  codespell || style_failed "codespell found words that look misspelt"
else
  style_failed "codespell is not installed; spelling is not checked"
fi

step "Configure"
if [[ -z ${CMAKE_CXX_COMPILER_LAUNCHER:-} ]] && command -v ccache >/dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi
# A first build is a whole one: sources are compiled sixteen at a time. A build that is there stays as it is.
# Benchmarks are no tests: in CI they would cost a minute and show nothing.
how=()
[[ -f build/release/CMakeCache.txt ]] || how=(-DPNEUMA_UNITY=ON)
[[ -z ${CI:-} ]] || how+=(-DPNEUMA_BUILD_BENCHMARKS=OFF)
how+=(-DPNEUMA_FULL_TESTS="$([[ $full ]] && echo ON || echo OFF)")
cmake --preset release -DPNEUMA_TEST_DATA="$PNEUMA_TEST_DATA" "${how[@]}"

step "Build"
cmake --build --preset release

step "Every public header compiles alone"
cmake --build --preset release --target headers_alone

step "Tests"
if [[ -z $full ]]; then
  ctest --preset release --no-label-summary --output-log build/release/tests.log
  summary build/release/tests.log
  exit
fi
export FULL=1 RUNS=3 KILLS=200 PNEUMA_MONKEY_ACTIONS=1000 PNEUMA_SOAK_CYCLES=200
ctest --preset release --no-label-summary --timeout 14400 --output-log build/release/tests.log
summary build/release/tests.log

unset FULL RUNS KILLS PNEUMA_MONKEY_ACTIONS PNEUMA_SOAK_CYCLES

step "Address and undefined-behaviour sanitizers"
export LSAN_OPTIONS=suppressions=$PWD/tests/sanitizers/leaks.supp
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
cmake --workflow --preset asan

step "Thread sanitizer"
export TSAN_OPTIONS=suppressions=$PWD/tests/sanitizers/threads.supp:halt_on_error=1
cmake --workflow --preset tsan

step "Fuzzing"
cmake --workflow --preset fuzz

step "Coverage"
packaging/coverage.sh
