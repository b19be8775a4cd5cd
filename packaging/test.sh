#!/usr/bin/env bash
# Installs what is missing, builds the preset `release` with two jobs and runs every check and test,
# those that draw under Xvfb. Closes with ctest's summary; ends with an error if a test failed or
# none ran. Real data are used where ../shared/data stands beside the project, or where
# PNEUMA_TEST_DATA points; without them the tests run on generated data.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

step() { printf '\n== %s (at %d s)\n' "$1" "$SECONDS"; }

# A style check that finds something ends the run in CI, and is only reported elsewhere.
style_failed() {
  echo "test.sh: $1" >&2
  [[ -z ${CI:-} ]] || exit 1
}

step "Dependencies"
packaging/install-dependencies.sh

if [[ -z ${PNEUMA_TEST_DATA:-} && -d ../shared/data ]]; then
  PNEUMA_TEST_DATA=$(cd ../shared/data && pwd)
fi
export PNEUMA_TEST_DATA=${PNEUMA_TEST_DATA:-}
echo "real data: ${PNEUMA_TEST_DATA:-none, generated data only}"

step "Style"
if clang-format --version 2>/dev/null | grep -q 'version 14\.'; then
  find modules app tests -name '*.h' -print0 -o -name '*.cpp' -print0 |
    xargs -0 clang-format --dry-run --Werror ||
    style_failed "clang-format would change these places; see CONTRIBUTING.md, Style"
else
  echo "clang-format 14 is not installed; formatting is not checked"
fi
if command -v codespell >/dev/null; then
  codespell || style_failed "codespell found words that look misspelt"
else
  echo "codespell is not installed; spelling is not checked"
fi

step "Configure"
if [[ -z ${CMAKE_CXX_COMPILER_LAUNCHER:-} ]] && command -v ccache >/dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi
# A first build is a whole one: sources are compiled eight at a time. A build that is there stays as it is.
# Benchmarks are no tests: in CI they would cost a minute and show nothing.
how=()
[[ -f build/release/CMakeCache.txt ]] || how=(-DPNEUMA_UNITY=ON)
[[ -z ${CI:-} ]] || how+=(-DPNEUMA_BUILD_BENCHMARKS=OFF)
cmake --preset release -DPNEUMA_TEST_DATA="$PNEUMA_TEST_DATA" "${how[@]}"

step "Build"
cmake --build --preset release

step "Every public header compiles alone"
cmake --build --preset release --target headers_alone

step "Tests"
ctest --preset release --no-label-summary
