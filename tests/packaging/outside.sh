#!/usr/bin/env bash
# An outside project finds Pneuma where it was installed, and README's "From C++" compiles, links and runs there.
# Needs CMAKE, BUILD (the build folder), PNEUMA (the program).
set -u
: "${CMAKE:?}" "${BUILD:?}" "${PNEUMA:?}"
HERE=$(cd "$(dirname "$0")" && pwd)
. "$HERE/lib.sh"

"$CMAKE" --install "$BUILD" --component dev --prefix "$FOLDER/pre fix" >"$FOLDER/install.log" 2>&1 || fail "$(tail -n 5 "$FOLDER/install.log")"
[ ! -e "$FOLDER/pre fix/bin" ] || fail "the component dev installs programs"
# A header that is installed may include of ours only what is installed too.
include="$FOLDER/pre fix/include/pneuma"
[ -s "$include/pipeline/lung_model.h" ] || fail "there are no headers"
missing=$(cd "$include" && grep -rhoE '^#include "[^"]+"' . | sort -u | cut -d '"' -f 2 | while read -r header; do
  [ -e "$header" ] || echo "$header"
done)
[ -z "$missing" ] || fail "headers include what is not installed: $missing"
# No path of the tree that it was built from.
tree=$(cd "$HERE/../.." && pwd)
! grep -rlF "$tree" "$FOLDER/pre fix"/lib*/*/cmake "$FOLDER/pre fix"/lib*/cmake 2>/dev/null || fail "the exported targets name $tree"

mkdir "$FOLDER/build"
awk '/^## From C/ { on = 1 }
  on && /^```$/ { exit }
  on && started && /^#include/ { includes = includes $0 "\n"; next }
  on && started { body = body "  " $0 "\n" }
  on && /^```cpp/ { started = 1 }
  END { printf "%sint main() {\n%s}\n", includes, body }' "$HERE/../../README.md" >"$FOLDER/build/outside.cpp"
grep -q 'pneuma::grow(' "$FOLDER/build/outside.cpp" || fail "README has no example of C++"
"$CMAKE" -S "$HERE/outside" -B "$FOLDER/build" -DCMAKE_PREFIX_PATH="$FOLDER/pre fix" -DCMAKE_BUILD_TYPE=Debug >"$FOLDER/log" 2>&1 ||
  fail "configuring: $(tail -n 20 "$FOLDER/log")"
"$CMAKE" --build "$FOLDER/build" >"$FOLDER/log" 2>&1 || fail "building: $(tail -n 20 "$FOLDER/log")"
cd "$FOLDER" || exit 1
"$PNEUMA" sample chest --cell 4mm -q || fail "no sample chest"
./build/outside >said || fail "the outside program ended with $?"
grep -Eq '^(29|30|31)[0-9]{3} terminals$' said || fail "the outside program says: $(cat said)"
./build/core_alone || fail "what links core alone"
./build/render_alone || fail "what links render alone"
echo "an outside project builds against $(find "$include" -name '*.h' | wc -l) headers; README's example says: $(cat said)"
