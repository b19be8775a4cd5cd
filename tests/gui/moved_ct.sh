#!/usr/bin/env bash
# The CT of a project moves: the project opens without it, is told where it is, and remembers that.
# Needs PNEUMA, DESKTOP (pneuma-desktop), CT (a folder of DICOM), a display, and a folder OUT for its pictures.
set -u
: "${PNEUMA:?}" "${DESKTOP:?}" "${CT:?}" "${OUT:?}"
. "$(dirname "$0")/lib.sh"

mkdir "$FOLDER/before" "$FOLDER/after" "$FOLDER/others"
cp -r "$CT" "$FOLDER/before/scan"
cat >"$FOLDER/make.json" <<'END'
[{"do": "scenario", "name": "a project links its CT"},
 {"do": "open", "paths": ["${FOLDER}/before/scan"]}, {"do": "wait", "seconds": 300},
 {"do": "trigger", "name": "actionSaveProject"},
 {"do": "set", "name": "fileNameEdit", "value": "${FOLDER}/case.pneuma"},
 {"do": "pause", "seconds": 0.5},
 {"do": "key", "name": "fileNameEdit", "keys": "Return"}, {"do": "wait", "seconds": 300},
 {"do": "expect", "state": "project", "equals": "case.pneuma"}]
END
"$DESKTOP" --play "$FOLDER/make.json" --screenshots "$OUT" || fail "the project was not made"
mv "$FOLDER/before/scan" "$FOLDER/after/scan"
# As large as the CT, but for one voxel the same.
cp -r "$FOLDER/after/scan" "$FOLDER/others/scan"
first=$(find "$FOLDER/others/scan" -type f | sort | head -n 1)
size=$(stat -c %s "$first")
printf '\1' | dd of="$first" bs=1 seek=$((size - 1000)) conv=notrunc status=none

"$PNEUMA" info "$FOLDER/case.pneuma" >"$FOLDER/info.txt" || fail "info of a project without its CT"
grep -q 'not found' "$FOLDER/info.txt" || fail "info does not say that the CT is missing"

cat >"$FOLDER/locate.json" <<'END'
[{"do": "scenario", "name": "a CT that moved: another one is refused"},
 {"do": "open", "paths": ["${FOLDER}/case.pneuma"]}, {"do": "wait", "seconds": 300},
 {"do": "expect", "name": "errorCard", "property": "visible", "equals": true},
 {"do": "expect", "name": "errorSentence", "contains": "is not where it was"},
 {"do": "expect", "name": "stepOpen", "property": "accessibleName", "contains": "CT not found"},
 {"do": "expect", "state": "lungs", "above": 1000},
 {"do": "screenshot", "file": "01_missed"},
 {"do": "click", "name": "errorHelp"},
 {"do": "set", "name": "fileNameEdit", "value": "${FOLDER}/others/scan"},
 {"do": "screenshot", "file": "02_locating"},
 {"do": "key", "name": "fileNameEdit", "keys": "Return"}, {"do": "wait", "seconds": 300},
 {"do": "expect", "name": "errorSentence", "contains": "is another CT"},
 {"do": "screenshot", "file": "03_another"},
 {"do": "click", "name": "errorClose"},
 {"do": "scenario", "name": "a CT that moved: it is found and remembered"},
 {"do": "click", "name": "stepOpen"},
 {"do": "click", "name": "locateCt"},
 {"do": "set", "name": "fileNameEdit", "value": "${FOLDER}/after/scan"},
 {"do": "pause", "seconds": 0.5},
 {"do": "key", "name": "fileNameEdit", "keys": "Return"}, {"do": "wait", "seconds": 300},
 {"do": "wait-until", "state": "modified", "equals": false, "seconds": 120},
 {"do": "wait", "seconds": 300},
 {"do": "expect", "name": "errorCard", "property": "visible", "equals": false},
 {"do": "expect", "name": "slice_axial", "property": "visible", "equals": true},
 {"do": "expect", "name": "locateCt", "property": "visible", "equals": false},
 {"do": "screenshot", "file": "04_found"}]
END
"$DESKTOP" --play "$FOLDER/locate.json" --screenshots "$OUT" || fail "the CT was not found again"
"$PNEUMA" info "$FOLDER/case.pneuma" >"$FOLDER/info.txt" || fail "info of the project"
grep -q "after/scan'\$" "$FOLDER/info.txt" || fail "the new place was not saved: $(grep CT "$FOLDER/info.txt")"
echo "done"
