#!/usr/bin/env bash
# Where numbers are written with commas, the window reads and writes the same files as where they have dots.
# Needs PNEUMA, DESKTOP (pneuma-desktop), a display, and a folder OUT for its pictures.
set -u
: "${PNEUMA:?}" "${DESKTOP:?}" "${OUT:?}"
. "$(dirname "$0")/lib.sh"
export LOCPATH=$FOLDER
localedef -i de_DE -f UTF-8 "$FOLDER/de_DE.UTF-8" >/dev/null 2>&1 || {
  echo "SKIPPED: the locale de_DE, which this system cannot make"
  exit 77
}
[ "$(LC_ALL=de_DE.UTF-8 bash -c 'printf %.1f 1')" = 1,0 ] || fail "there are no decimal commas"

# Coordinates as text, which a library takes apart.
"$PNEUMA" sample "$FOLDER/chest" --format obj --cell 4 -q || fail "no sample"
cat >"$FOLDER/play.json" <<'END'
[{"do": "scenario", "name": "a desktop with decimal commas: the same files"},
 {"do": "open", "paths": ["${FOLDER}/chest/rul.obj", "${FOLDER}/chest/rml.obj", "${FOLDER}/chest/rll.obj",
                          "${FOLDER}/chest/lul.obj", "${FOLDER}/chest/lll.obj", "${FOLDER}/chest/central.vtp"]},
 {"do": "wait", "seconds": 120},
 {"do": "click", "name": "stepAirways"}, {"do": "click", "name": "method_centroid"},
 {"do": "set", "name": "option_terminals", "value": 300},
 {"do": "click", "name": "copyCommand"}, {"do": "save-clipboard", "file": "airways.txt"},
 {"do": "click", "name": "grow"}, {"do": "wait", "seconds": 120},
 {"do": "click", "name": "stepBreathing"},
 {"do": "set", "name": "option_frames", "value": 3}, {"do": "set", "name": "option_period", "value": 2.5},
 {"do": "click", "name": "breathe"}, {"do": "wait", "seconds": 120},
 {"do": "click", "name": "copyCommand"}, {"do": "save-clipboard", "file": "breathing.txt"},
 {"do": "trigger", "name": "actionSaveBreath"},
 {"do": "set", "name": "fileNameEdit", "value": "${FOLDER}/made/breath.pvd"},
 {"do": "key", "name": "fileNameEdit", "keys": "Return"}, {"do": "wait", "seconds": 120},
 {"do": "trigger", "name": "actionSaveProject"},
 {"do": "set", "name": "fileNameEdit", "value": "${FOLDER}/made/case.pneuma"},
 {"do": "key", "name": "fileNameEdit", "keys": "Return"}, {"do": "wait", "seconds": 120},
 {"do": "click", "name": "stepExport"}, {"do": "click", "name": "export_tree"},
 {"do": "trigger", "name": "actionExportCase"},
 {"do": "set", "name": "fileNameEdit", "value": "${FOLDER}/made/tree"},
 {"do": "pause", "seconds": 0.5},
 {"do": "key", "name": "fileNameEdit", "keys": "Return"}, {"do": "wait", "seconds": 120},
 {"do": "click", "name": "export_report"},
 {"do": "trigger", "name": "actionExportCase"},
 {"do": "set", "name": "fileTypeCombo", "value": "HTML, a page (*.html)"},
 {"do": "set", "name": "fileNameEdit", "value": "${FOLDER}/made/report.html"},
 {"do": "key", "name": "fileNameEdit", "keys": "Return"}, {"do": "wait", "seconds": 120},
 {"do": "expect", "name": "errorCard", "property": "visible", "equals": false},
 {"do": "screenshot", "file": "made"}]
END

# The same folder each time, for outputs name their inputs. A project holds when it was saved.
rm -rf "$OUT"
for locale in C.UTF-8 de_DE.UTF-8; do
  mkdir -p "$FOLDER/made/tree"
  LC_ALL=$locale LANG=$locale "$DESKTOP" --play "$FOLDER/play.json" --screenshots "$OUT/$locale" || fail "the window with $locale"
  mv "$FOLDER/made" "$FOLDER/$locale.made"
done
[ "$(wc -l <"$FOLDER/C.UTF-8.made/breath.csv")" -gt 3 ] || fail "no breath was saved"
diff -r -x case.pneuma -I peak_memory_mb "$FOLDER/C.UTF-8.made" "$FOLDER/de_DE.UTF-8.made" || fail "files differ"
for text in airways breathing; do
  cmp "$OUT/C.UTF-8/$text.txt" "$OUT/de_DE.UTF-8/$text.txt" || fail "the copied commands differ"
done
echo "done"
