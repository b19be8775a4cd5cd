#!/usr/bin/env bash
# What is done by clicking and what `pneuma run` does by the recipe that the window exports of it are
# the same files, byte for byte: a lung corrected by a brush, fissures set by points and by a plane,
# two methods of growth.
# Needs PNEUMA, DESKTOP (pneuma-desktop), a CT of thin slices, a display, and a folder OUT for its
# pictures.
set -u
: "${PNEUMA:?}" "${DESKTOP:?}" "${CT:?}" "${OUT:?}"
FOLDER=$(mktemp -d)
trap 'rm -rf "$FOLDER"' EXIT
export FOLDER CT
rm -rf "$OUT"

fail() {
  echo "FAILED: $1"
  exit 1
}

# export_step PRESET: the clicks that export a preset into a folder of its name.
export_step() {
  mkdir -p "$FOLDER/$1"
  cat <<END
 {"do": "click", "name": "export_${1%%-*}"}, {"do": "click", "name": "exportCase"},
 {"do": "set", "name": "fileNameEdit", "value": "$FOLDER/$1"}, {"do": "pause", "seconds": 0.5},
 {"do": "key", "name": "fileNameEdit", "keys": "Return"}, {"do": "wait"},
END
}

{
  cat <<'END'
[{"do": "scenario", "name": "a lung is painted, fissures are set, a tree is grown, for a recipe"},
 {"do": "open", "paths": ["${CT}"]}, {"do": "wait", "seconds": 600},
 {"do": "click", "name": "stepLungs"}, {"do": "click", "name": "brush"},
 {"do": "set", "name": "brushRadius", "value": 8}, {"do": "set", "name": "brushLung", "value": "Right"},
 {"do": "drag-point", "name": "slice_coronal", "from": [-20, 10, -100], "to": [-10, 10, -110]},
 {"do": "wait", "seconds": 300}, {"do": "expect", "state": "lungEdits", "equals": 1},
 {"do": "click", "name": "stepLobes"}, {"do": "click", "name": "edit_right-oblique"},
 {"do": "click-point", "name": "slice_axial", "point": [-75.6, 14.3, 0]},
 {"do": "trigger", "name": "actionPlacePoints"},
 {"do": "click-point", "name": "slice_sagittal", "point": [-75.6, -37.7, -97.4]},
 {"do": "click-point", "name": "slice_sagittal", "point": [-75.6, 2.3, -60.0]},
 {"do": "click-point", "name": "slice_coronal", "point": [-103.6, 14.3, -55.8]},
 {"do": "click-point", "name": "slice_sagittal", "point": [-75.6, 66.3, 25.6]},
 {"do": "trigger", "name": "actionPlacePoints"},
 {"do": "click", "name": "edit_left-oblique"}, {"do": "click", "name": "plane_left-oblique"},
 {"do": "set", "name": "tilt_left-oblique", "value": 52},
 {"do": "click", "name": "splitLobes"}, {"do": "wait", "seconds": 300},
 {"do": "expect", "state": "surfaces", "equals": 5},
 {"do": "click", "name": "stepAirways"}, {"do": "click", "name": "method_centroid"},
 {"do": "set", "name": "option_terminals", "value": 300},
 {"do": "click", "name": "grow"}, {"do": "wait", "seconds": 300},
 {"do": "click", "name": "stepExport"},
END
  for preset in tree segmentation recipe print; do export_step $preset; done
  cat <<'END'
 {"do": "screenshot", "file": "01_recipe"},
 {"do": "scenario", "name": "another method in a recipe"},
 {"do": "click", "name": "stepAirways"}, {"do": "click", "name": "method_kitaoka"},
 {"do": "set", "name": "option_terminals", "value": 500},
 {"do": "click", "name": "grow"}, {"do": "wait", "seconds": 300},
 {"do": "click", "name": "stepExport"},
END
  for preset in tree-kitaoka recipe-kitaoka; do export_step $preset; done
  cat <<'END'
 {"do": "expect", "name": "errorCard", "property": "visible", "equals": false}]
END
} >"$FOLDER/script.json"
"$DESKTOP" --play "$FOLDER/script.json" --screenshots "$OUT" || fail "the window"

cat "$FOLDER/recipe/recipe.json" "$FOLDER/recipe/fissures.json"
grep -q '"tilt\|"plane' "$FOLDER/recipe/fissures.json" || fail "the plane is not in the recipe"
grep -q '"paint"' "$FOLDER/recipe/lung-edits.json" || fail "the stroke is not in the recipe"
"$PNEUMA" run "$FOLDER/recipe/recipe.json" -o "$FOLDER/again" || fail "run"
cmp "$FOLDER/tree/tree.vtp" "$FOLDER/again/tree.vtp" || fail "run grows another tree"
cmp "$FOLDER/segmentation/labels.nii.gz" "$FOLDER/again/lobes/labels.nii.gz" ||
  fail "run labels other lobes"
for lobe in rul rml rll lul lll; do
  "$PNEUMA" export "$FOLDER/again/lobes/$lobe.vtp" -o "$FOLDER/$lobe.stl" -q || fail "export"
  cmp "$FOLDER/print/$lobe.stl" "$FOLDER/$lobe.stl" || fail "run cuts another $lobe"
done
"$PNEUMA" run "$FOLDER/recipe-kitaoka/recipe.json" -o "$FOLDER/again" || fail "run"
cmp "$FOLDER/tree-kitaoka/tree.vtp" "$FOLDER/again/tree.vtp" || fail "run grows another tree"
echo "done"
