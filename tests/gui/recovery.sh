#!/usr/bin/env bash
# The window is killed in the middle of work, and offers that work when it is started again.
# Needs PNEUMA, DESKTOP (pneuma-desktop), a display, and a folder OUT for its pictures.
set -u
: "${PNEUMA:?}" "${DESKTOP:?}" "${OUT:?}"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export XDG_STATE_HOME=$folder/state
kept=$XDG_STATE_HOME/pneuma/recovery

fail() {
  echo "FAILED: $1"
  exit 1
}

cat >"$folder/work.json" <<'END'
[{"do": "trigger", "name": "actionSample"}, {"do": "wait"},
 {"do": "click", "name": "stepAirways"}, {"do": "click", "name": "method_centroid"},
 {"do": "set", "name": "option_terminals", "value": 300},
 {"do": "click", "name": "grow"}, {"do": "wait"}, {"do": "pause", "seconds": 300}]
END
"$DESKTOP" --play "$folder/work.json" &
window=$!
for _ in $(seq 600); do
  "$PNEUMA" info "$kept"/*.pneuma 2>/dev/null | grep -q 'grown by centroid' && break
  kill -0 $window 2>/dev/null || fail "the window ended on its own"
  sleep 0.1
done
kill -9 $window
wait $window 2>/dev/null
"$PNEUMA" info "$kept"/*.pneuma | grep -q 'grown by centroid' || fail "the work was not kept"
[ "$(stat -c %a "$kept")" = 700 ] || fail "others may look into the folder"

cat >"$folder/again.json" <<'END'
[{"do": "scenario", "name": "work that was lost is offered and recovered"},
 {"do": "expect", "name": "recoverQuestion", "property": "visible", "equals": true},
 {"do": "screenshot", "file": "01_offered"},
 {"do": "click", "name": "recoverOpen"}, {"do": "wait"},
 {"do": "expect", "name": "errorCard", "property": "visible", "equals": false},
 {"do": "expect", "state": "surfaces", "equals": 5},
 {"do": "expect", "state": "grown", "above": 500},
 {"do": "expect", "state": "modified", "equals": true},
 {"do": "expect", "state": "project", "equals": ""},
 {"do": "trigger", "name": "actionUndo"},
 {"do": "expect", "state": "grown", "equals": 0},
 {"do": "trigger", "name": "actionRedo"},
 {"do": "expect", "state": "grown", "above": 500},
 {"do": "screenshot", "file": "02_recovered"}]
END
"$DESKTOP" --play "$folder/again.json" --screenshots "$OUT" || fail "the work did not come back"

# Whoever quits was asked: nothing is offered any more once the work is given up.
cat >"$folder/discard.json" <<'END'
[{"do": "scenario", "name": "work that was lost is thrown away"},
 {"do": "click", "name": "recoverDiscard"}, {"do": "pause", "seconds": 0.1}]
END
if ls "$kept"/*.pneuma >/dev/null 2>&1; then
  "$DESKTOP" --play "$folder/discard.json" || fail "it cannot be thrown away"
fi
ls "$kept"/*.pneuma >/dev/null 2>&1 && fail "something is left"

# Killed at any moment while steps follow one another: what was kept is whole, or nothing was kept yet. KILLS says
# how often, SEED when.
RANDOM=${SEED:-8}
cat >"$folder/steps.json" <<END
[{"do": "trigger", "name": "actionSample"}, {"do": "wait"},
 {"do": "click", "name": "stepAirways"}, {"do": "click", "name": "method_centroid"},
 $(for n in $(seq 40); do
  printf '{"do": "set", "name": "option_terminals", "value": %d}, ' $((200 + 150 * n))
  printf '{"do": "click", "name": "grow"}, {"do": "wait"}, {"do": "pause", "seconds": 0.3},\n'
done)
 {"do": "pause", "seconds": 300}]
END
touch -d '1 hour ago' "$kept/.pneuma-dead.part"
whole=0 nothing=0 half=0
for round in $(seq "${KILLS:-3}"); do
  touch "$kept/.pneuma-alive.part"
  "$DESKTOP" --play "$folder/steps.json" &
  window=$!
  for _ in $(seq 1200); do  # the first of it is being written
    ls -A "$kept" | grep -v 'alive\|dead' | grep -q '\.part$\|\.pneuma$' && break
    kill -0 $window 2>/dev/null || fail "the window ended on its own"
    sleep 0.05
  done
  sleep "$((RANDOM % ${LATEST:-4})).$((RANDOM % 10))$((RANDOM % 10))"
  kill -0 $window 2>/dev/null || fail "the window ended on its own"
  kill -9 $window
  wait $window 2>/dev/null
  ls -A "$kept" | grep -v alive | grep -q '\.part$' && half=$((half + 1))
  if ls "$kept"/*.pneuma >/dev/null 2>&1; then
    whole=$((whole + 1))
    for file in "$kept"/*.pneuma; do
      "$PNEUMA" info "$file" >"$folder/info.txt" || fail "round $round: $file is not whole"
      grep -q 'steps to undo' "$folder/info.txt" || fail "round $round: $file has no steps"
    done
  else
    nothing=$((nothing + 1))
  fi
  [ ! -e "$kept/.pneuma-dead.part" ] || fail "what was half written an hour ago is still there"
  [ -e "$kept/.pneuma-alive.part" ] || fail "what another window may be writing was taken away"
  echo "round $round: $whole whole, $nothing with nothing, $half while writing"
  rm -f "$kept"/*.pneuma "$kept"/*.pneuma~ "$kept"/*.lock "$kept"/.pneuma-????????*.part
done
echo "killed $((whole + nothing)) times: $whole whole, $nothing before anything was kept, $half while writing"
[ $whole -gt 0 ] || fail "nothing was ever kept"
echo "done"
