#!/usr/bin/env bash
# A fissure from a file: taken, extended to the lung's wall, and both undone and done again.
# Needs PNEUMA, DESKTOP (pneuma-desktop), CT (a folder of DICOM in thin slices), a display, and a folder OUT.
set -u
: "${PNEUMA:?}" "${DESKTOP:?}" "${CT:?}" "${OUT:?}"
. "$(dirname "$0")/lib.sh"
export CT

"$PNEUMA" lobes "$CT" -o "$FOLDER/lobes" -q || fail "no lobes of the CT"
"$PNEUMA" export "$FOLDER/lobes/fissures/left-oblique.vtp" -o "$FOLDER/whole.obj" -q || fail "no fissure as OBJ"
# A twelfth smaller about its middle: it ends before the wall.
awk 'NR == FNR { if ($1 == "v") { x += $2; y += $3; z += $4; n++ }; next }
     $1 == "v" { s = 11 / 12; print "v", x / n + s * ($2 - x / n), y / n + s * ($3 - y / n), z / n + s * ($4 - z / n); next }
     { print }' "$FOLDER/whole.obj" "$FOLDER/whole.obj" >"$FOLDER/small.obj"

cat >"$FOLDER/surface.json" <<'END'
[
  {"do": "scenario", "name": "undo: take a surface"},
  {"do": "open", "paths": ["${CT}"]},
  {"do": "wait", "seconds": 300},
  {"do": "wait", "seconds": 300},
  {"do": "click", "name": "stepLobes"},
  {"do": "wait", "seconds": 300},
  {"do": "click", "name": "edit_left-oblique"},
  {"do": "expect", "name": "fissureState_left-oblique", "contains": "Proposed"},
  {"do": "click", "name": "surface_left-oblique"},
  {"do": "set", "name": "fileNameEdit", "value": "${FOLDER}/small.obj"},
  {"do": "pause", "seconds": 0.5},
  {"do": "key", "name": "fileNameEdit", "keys": "Return"},
  {"do": "wait", "seconds": 300},
  {"do": "wait", "seconds": 300},
  {"do": "expect", "name": "actionUndo", "contains": "surface"},
  {"do": "expect", "name": "fissureState_left-oblique", "contains": "ends inside the lung"},
  {"do": "expect", "name": "extend_left-oblique", "property": "visible", "equals": true},
  {"do": "screenshot", "file": "01_taken"},
  {"do": "trigger", "name": "actionUndo"},
  {"do": "wait", "seconds": 300},
  {"do": "expect", "name": "fissureState_left-oblique", "contains": "Proposed"},
  {"do": "expect", "name": "extend_left-oblique", "property": "visible", "equals": false},
  {"do": "trigger", "name": "actionRedo"},
  {"do": "wait", "seconds": 300},
  {"do": "expect", "name": "extend_left-oblique", "property": "visible", "equals": true},

  {"do": "scenario", "name": "undo: extend a surface"},
  {"do": "click", "name": "extend_left-oblique"},
  {"do": "wait", "seconds": 300},
  {"do": "wait", "seconds": 300},
  {"do": "expect", "name": "actionUndo", "contains": "extend a surface"},
  {"do": "expect", "name": "extend_left-oblique", "property": "visible", "equals": false},
  {"do": "screenshot", "file": "02_extended"},
  {"do": "trigger", "name": "actionUndo"},
  {"do": "wait", "seconds": 300},
  {"do": "expect", "name": "extend_left-oblique", "property": "visible", "equals": true},
  {"do": "expect", "name": "actionRedo", "contains": "extend a surface"},
  {"do": "trigger", "name": "actionRedo"},
  {"do": "wait", "seconds": 300},
  {"do": "expect", "name": "extend_left-oblique", "property": "visible", "equals": false},
  {"do": "click", "name": "splitLobes"},
  {"do": "wait", "seconds": 300},
  {"do": "wait", "seconds": 300},
  {"do": "expect", "state": "surfaces", "equals": 5},
  {"do": "screenshot", "file": "03_split"}
]
END
"$DESKTOP" --play "$FOLDER/surface.json" --screenshots "$OUT" || fail "the surface was not taken, extended or undone"
echo "done"
