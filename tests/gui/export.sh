#!/usr/bin/env bash
# What the window exports is, byte for byte, what the commands make that it copies.
# Needs PNEUMA, DESKTOP (pneuma-desktop), a CT, a display, and a folder OUT for its pictures.
set -u
: "${PNEUMA:?}" "${DESKTOP:?}" "${CT:?}" "${OUT:?}"
FOLDER=$(mktemp -d)
trap 'rm -rf "$FOLDER"' EXIT
export FOLDER CT
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$OUT"

fail() {
  echo "FAILED: $1"
  exit 1
}

# copied NAME: runs the commands that were copied, in a folder of their own.
copied() {
  mkdir -p "$FOLDER/commands" && cd "$FOLDER/commands" || fail "no folder"
  pneuma() {
    if [ "$1" = info ]; then "$PNEUMA" "$@"; else "$PNEUMA" "$@" --force -q; fi
  }
  cat "$OUT/$1.txt"
  set -e
  . "$OUT/$1.txt"
  set +e
}

"$PNEUMA" sample "$FOLDER/chest" --format vtp --cell 4 -q || fail "no sample"
mkdir -p "$FOLDER/window/objs" "$FOLDER/window/paraview" "$FOLDER/window/print" "$FOLDER/window/tree" \
  "$FOLDER/window/share" "$FOLDER/window/film" "$FOLDER/window/cancelled"
echo "from before" >"$FOLDER/window/print/rul.stl"
echo "from before" >"$FOLDER/window/film/breath.ogv"
"$DESKTOP" --play "$here/export.json" --screenshots "$OUT" || fail "the window"

[ -z "$(ls -A "$FOLDER/window/cancelled")" ] || fail "a film that was cancelled left a file"

copied airways
cmp "$FOLDER/window/tree/tree.vtp" tree.vtp || fail "the copied command grows another tree"
copied breathing
for file in breath.csv breath_0001.vtp breath_tree_0001.vtp breath.pvd; do
  cmp "$FOLDER/window/$file" $file || fail "the copied command breathes otherwise"
done
grep -rq "$FOLDER\|central.vtp" "$FOLDER/window/paraview/breath.json" && fail "a report names files"
for preset in paraview print tree; do
  copied $preset
  diff -r -I peak_memory_mb "$FOLDER/window/$preset" $preset || fail "$preset differs"
done
"$PNEUMA" export "$FOLDER/case.pneuma" --preset paraview --largest-file 100K -o pieces | sort >told || fail "no pieces"
find pieces -type f | sort | cmp - told || fail "other files are told than there are"
grep -q '^pieces/breath_tree_0002.vtm$\|^pieces/breath_0002/breath_0002_1.vtp$' told || fail "frames are whole"
[ -z "$(find pieces -name '*.vtp' -size +100k)" ] || fail "there are larger files"
copied share
cmp "$FOLDER/window/share/breath.glb" share/breath.glb || fail "the copied command moves otherwise"
[ "$(head -c 4 share/breath.glb)" = glTF ] || fail "the animation is no glTF"
"$PNEUMA" breathe "$FOLDER/case.pneuma" --frames 3 --period 1 --gltf same.glb -o same.pvd -q
cmp same.glb share/breath.glb || fail "pneuma breathe writes another animation"
copied film
cmp "$FOLDER/window/film/breath.ogv" film/breath.ogv || fail "the copied command makes another film"
[ "$(head -c 4 film/breath.ogv)" = OggS ] || fail "the film is no Ogg"
# It was saved as it was looked at in the beginning, from the front.
"$PNEUMA" export "$FOLDER/case.pneuma" --preset film -o front -q || fail "no film as it was saved"
cmp -s front/breath.ogv film/breath.ogv && fail "the film is the same from everywhere"
copied objs
grep -q -- '--as obj' "$OUT/objs.txt" || fail "the copied command has another format"
for lobe in rul rml rll lul lll; do
  cmp "$FOLDER/window/objs/$lobe.obj" print/$lobe.obj || fail "the shapes differ"
done
copied report
cmp "$FOLDER/window/report.pdf" report.pdf || fail "the report differs"
"$PNEUMA" report "$FOLDER/case.pneuma" -o report.html -q
cmp "$FOLDER/window/report.html" report.html || fail "the page differs"
grep -q "$FOLDER\|rul.vtp" report.html && fail "the report names files"
copied figure
[ -s figure.png ] && [ -s "$FOLDER/window/figure.png" ] || fail "no figure"
[ -z "$(find "$FOLDER" -name '.*' -not -path "$FOLDER" -o -name '*.part')" ] || fail "something was left"

# From a CT on: every command builds on the one before.
cat >"$FOLDER/ct.json" <<'END'
[{"do": "scenario", "name": "commands from a CT to a tree, and its labels exported"},
 {"do": "open", "paths": ["${CT}"]}, {"do": "wait", "seconds": 300},
 {"do": "click", "name": "stepOpen"}, {"do": "click", "name": "copyCommand"},
 {"do": "save-clipboard", "file": "open.txt"},
 {"do": "click", "name": "stepLungs"}, {"do": "click", "name": "copyCommand"},
 {"do": "save-clipboard", "file": "lungs.txt"},
 {"do": "click", "name": "stepLobes"}, {"do": "click", "name": "copyCommand"},
 {"do": "save-clipboard", "file": "lobes.txt"},
 {"do": "click", "name": "splitLobes"}, {"do": "wait", "seconds": 300},
 {"do": "click", "name": "stepAirways"}, {"do": "click", "name": "method_centroid"},
 {"do": "set", "name": "option_terminals", "value": 300},
 {"do": "click", "name": "copyCommand"}, {"do": "save-clipboard", "file": "chain.txt"},
 {"do": "click", "name": "grow"}, {"do": "wait", "seconds": 300},
 {"do": "click", "name": "stepExport"}, {"do": "click", "name": "export_tree"},
 {"do": "click", "name": "exportCase"},
 {"do": "set", "name": "fileNameEdit", "value": "${FOLDER}/ct/grown"},
 {"do": "pause", "seconds": 0.5},
 {"do": "key", "name": "fileNameEdit", "keys": "Return"}, {"do": "wait"},
 {"do": "click", "name": "export_segmentation"}, {"do": "click", "name": "exportCase"},
 {"do": "set", "name": "fileNameEdit", "value": "${FOLDER}/ct/voxels"},
 {"do": "pause", "seconds": 0.5},
 {"do": "key", "name": "fileNameEdit", "keys": "Return"}, {"do": "wait"},
 {"do": "screenshot", "file": "07_ct"},
 {"do": "expect", "name": "errorCard", "property": "visible", "equals": false}]
END
mkdir -p "$FOLDER/ct/grown" "$FOLDER/ct/voxels"
cd "$FOLDER" || exit 1
"$DESKTOP" --play "$FOLDER/ct.json" --screenshots "$OUT" || fail "the window with a CT"
rm -rf "$FOLDER/commands"
copied open >/dev/null
copied lungs
copied lobes
cmp "$FOLDER/ct/voxels/labels.nii.gz" lobes/labels.nii.gz || fail "the lobes are labelled otherwise"
rm -rf "$FOLDER/commands"
copied chain
# Lobes that went through files have volumes that differ in the last digit.
"$PNEUMA" export tree.vtp -o chain.csv -q
[ "$(wc -l <chain.csv)" -gt 500 ] || fail "the chain grows next to nothing"
paste -d, "$FOLDER/ct/grown/tree.csv" chain.csv | awk -F, '
  function off(a, b) { return a - b > 1e-9 * (1 + (a < 0 ? -a : a)) || b - a > 1e-9 * (1 + (a < 0 ? -a : a)) }
  NF % 2 { exit 1 }
  { for (i = 1; i <= NF / 2; ++i) if ($i != $(i + NF / 2) && off($i + 0, $(i + NF / 2) + 0)) exit 1 }' ||
  fail "the chain from the CT grows another tree"
echo "done"
