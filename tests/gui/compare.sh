#!/usr/bin/env bash
# The methods compared in the window give, byte for byte, the table of the commands that it copies.
# Needs PNEUMA, DESKTOP (pneuma-desktop), a display, and a folder OUT for its pictures.
set -u
: "${PNEUMA:?}" "${DESKTOP:?}" "${OUT:?}"
FOLDER=$(mktemp -d)
trap 'rm -rf "$FOLDER"' EXIT
export FOLDER
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$OUT"

fail() {
  echo "FAILED: $1"
  exit 1
}

"$PNEUMA" sample "$FOLDER/chest" --format vtp --cell 4 -q || fail "no sample"
"$DESKTOP" --play "$here/compare.json" --screenshots "$OUT" || fail "the window"
mkdir "$FOLDER/commands" && cd "$FOLDER/commands" || fail "no folder"
pneuma() { "$PNEUMA" "$@" -q; }
cat "$OUT/compare.txt"
set -e
. "$OUT/compare.txt"
set +e
cmp comparison.csv "$FOLDER/window.csv" || fail "the commands give another table"
[ "$(wc -l <comparison.csv)" -gt 100 ] || fail "the table is short"
echo "done"
