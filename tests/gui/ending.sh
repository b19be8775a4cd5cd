#!/usr/bin/env bash
# The window is ended by a signal, as at a log-out, while it shows the series of an archive: what was unpacked of it,
# with all that names the person, is gone; and it ends by that signal. Once a series is open, nothing unpacked is kept.
# Needs DESKTOP (pneuma-desktop), SERIES (a folder of several series), a display, and a folder OUT for its pictures.
set -u
: "${DESKTOP:?}" "${SERIES:?}" "${OUT:?}"
. "$(dirname "$0")/lib.sh"
mkdir "$FOLDER/tmp" "$FOLDER/state"
(cd "$SERIES" && cmake -E tar cf "$FOLDER/series.zip" --format=zip .) || fail "no archive"
export TMPDIR=$FOLDER/tmp XDG_STATE_HOME=$FOLDER/state
rm -f "$OUT"/*.png # of a run before
unpacked() { find "$TMPDIR" -mindepth 1 -name '.pneuma-*' | grep -q .; }

# play SCRIPT PICTURE: starts the window, $window, and waits until the script has taken that picture.
play() {
  "$DESKTOP" --play "$FOLDER/$1.json" --screenshots "$OUT" &
  window=$!
  for _ in $(seq 3000); do
    tail -c 12 "$OUT/$2.png" 2>/dev/null | grep -aq IEND && return # all of it is written
    kill -0 $window 2>/dev/null || fail "the window ended on its own"
    sleep 0.1
  done
  fail "$2 was not reached"
}

# end SIGNAL CODE: the window ends by it.
end() {
  kill "-$1" $window
  wait $window 2>/dev/null
  local code=$?
  [ $code -eq "$2" ] || fail "it ends with $code, not by the signal"
}

cat >"$FOLDER/list.json" <<'END'
[{"do": "scenario", "name": "the series of an archive are shown, and the session ends"},
 {"do": "open", "paths": ["${FOLDER}/series.zip"]}, {"do": "wait", "seconds": 120},
 {"do": "expect", "name": "seriesPage", "property": "visible", "equals": true},
 {"do": "screenshot", "file": "01_series"}, {"do": "pause", "seconds": 300}]
END
play list 01_series
unpacked || fail "nothing is unpacked while series are shown; this test sees nothing"
end TERM 143
unpacked && fail "what was unpacked is left: $(ls -A "$TMPDIR")"

cat >"$FOLDER/open.json" <<'END'
[{"do": "scenario", "name": "a series of an archive is opened"},
 {"do": "open", "paths": ["${FOLDER}/series.zip"]}, {"do": "wait", "seconds": 120},
 {"do": "click", "name": "seriesOpen"}, {"do": "wait", "seconds": 300},
 {"do": "expect", "state": "lungs", "above": 1000},
 {"do": "screenshot", "file": "02_opened"}, {"do": "pause", "seconds": 300}]
END
play open 02_opened
unpacked && fail "what was unpacked is kept after a series was opened: $(ls -A "$TMPDIR")"
end HUP 129
