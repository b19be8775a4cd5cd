#!/usr/bin/env bash
# A person's CT goes through the window: opened, lungs found, saved, exported, missed, copied, killed in the middle. What
# is left in the case, the settings, the kept work and the pictures' texts knows nothing of the person but the folder,
# and that only where the CT is to be found again.
# Needs PNEUMA, DESKTOP (pneuma-desktop), PERSON (person.cpp), a display, and a folder OUT for its pictures.
set -u
: "${PNEUMA:?}" "${DESKTOP:?}" "${PERSON:?}" "${OUT:?}"
. "$(dirname "$0")/../gui/lib.sh"

mkdir -p "$FOLDER/PLANTED folder" "$FOLDER/all/home"
"$PNEUMA" sample "$FOLDER/chest" --ct --spacing 3 -q || fail "no chest"
mv "$FOLDER/chest/dicom" "$FOLDER/PLANTED folder/ct"
"$PERSON" plant "$FOLDER/PLANTED folder/ct" >"$FOLDER/planted" || fail "the person was not planted"
all=$FOLDER/all
export HOME=$all/home XDG_CONFIG_HOME=$all/config XDG_STATE_HOME=$all/state XDG_CACHE_HOME=$all/cache XDG_DATA_HOME=$all/data TMPDIR=$all
cat >"$FOLDER/work.json" <<'END'
[{"do": "scenario", "name": "privacy: the window with the CT of a person"},
 {"do": "key", "name": "welcome", "keys": "Return"},
 {"do": "open", "paths": ["${FOLDER}/PLANTED folder/ct"]}, {"do": "wait", "seconds": 300},
 {"do": "click", "name": "stepLungs"}, {"do": "click", "name": "findLungs"}, {"do": "wait", "seconds": 300},
 {"do": "expect", "state": "lungs", "above": 1000},
 {"do": "screenshot", "file": "01_lungs"},
 {"do": "trigger", "name": "actionSaveProject"},
 {"do": "set", "name": "fileNameEdit", "value": "${FOLDER}/all/case.pneuma"}, {"do": "pause", "seconds": 0.5},
 {"do": "key", "name": "fileNameEdit", "keys": "Return"}, {"do": "wait", "seconds": 300},
 {"do": "expect", "state": "project", "equals": "case.pneuma"},
 {"do": "open", "paths": ["${FOLDER}/PLANTED folder/not there"]}, {"do": "wait", "seconds": 300},
 {"do": "expect", "name": "errorCard", "property": "visible", "equals": true},
 {"do": "screenshot", "file": "02_missed"},
 {"do": "click", "name": "errorCopy"},
 {"do": "save-clipboard", "file": "copied"},
 {"do": "click", "name": "errorClose"},
 {"do": "click", "name": "stepAirways"}, {"do": "click", "name": "method_centroid"},
 {"do": "set", "name": "option_terminals", "value": 300},
 {"do": "click", "name": "grow"}, {"do": "wait", "seconds": 300},
 {"do": "pause", "seconds": 300}]
END
"$DESKTOP" --play "$FOLDER/work.json" --settings "$all/settings.ini" --screenshots "$OUT" >"$all/printed" 2>&1 &
window=$!
kept=$XDG_STATE_HOME/pneuma/recovery
for _ in $(seq 3000); do
  "$PNEUMA" info "$kept"/*.pneuma 2>/dev/null | grep -q 'grown by centroid' && break
  kill -0 $window 2>/dev/null || fail "the window ended on its own: $(tail -n 3 "$all/printed")"
  sleep 0.1
done
kill -9 $window
wait $window 2>/dev/null
grep -q case.pneuma "$all/settings.ini" || fail "the settings do not hold the project"
mv "$OUT/copied" "$all/" && [ -s "$all/copied" ] || fail "no text of the error was copied"
"$PNEUMA" report "$all/case.pneuma" -o "$all/report.html" -q || fail "no report"
"$PNEUMA" report "$all/case.pneuma" -o "$all/report.pdf" -q || fail "no report"

# A report that names the person's file is found to do so.
mkdir "$FOLDER/named" && "$PNEUMA" report "$all/case.pneuma" --identify -o "$FOLDER/named/report.pdf" -q || fail "no report"
"$PERSON" find "$FOLDER/named" | grep -q '^report.pdf:text: PLANTED$' || fail "the look does not see into a PDF"

"$PERSON" find "$all" >"$FOLDER/found"
sed -E 's/^state.*pneuma:/the work that was kept:/' "$FOLDER/found" | sort >"$FOLDER/told"
cat >"$FOLDER/expected" <<'END'
case.pneuma:project.json: PLANTED
the work that was kept:project.json: PLANTED
END
diff "$FOLDER/expected" "$FOLDER/told" || fail "the person is found elsewhere"
echo "nothing of the person but the folder of the linked CT"
