#!/usr/bin/env bash
# What the entry in a desktop's menu offers: the command lines of its actions, as they stand there.
# Needs DESKTOP (pneuma-desktop), a display, and a folder OUT for its pictures.
set -u
: "${DESKTOP:?}" "${OUT:?}"
. "$(dirname "$0")/lib.sh"
entry="$(dirname "$0")/../../packaging/linux/org.pneuma.Pneuma.desktop"

# act ACTION: starts the window as the menu does, and plays the script on standard input in it.
act() {
  cat >"$FOLDER/$1.json"
  words=$(sed -n "/^\[Desktop Action $1\]/,/^\[/s/^Exec=pneuma-desktop //p" "$entry")
  [ -n "$words" ] || fail "the entry has no action $1"
  "$DESKTOP" $words --play "$FOLDER/$1.json" --screenshots "$OUT" || fail "the action $1"
}

act SampleChest <<'END'
[{"do": "scenario", "name": "desktop entry: the sample chest"},
 {"do": "wait", "seconds": 300},
 {"do": "expect", "state": "branches", "above": 5},
 {"do": "screenshot", "file": "01_sample"}]
END
act OpenFolder <<'END'
[{"do": "scenario", "name": "desktop entry: asks for a folder"},
 {"do": "expect", "name": "folderDialog", "property": "visible", "equals": true},
 {"do": "screenshot", "file": "02_folder"},
 {"do": "key", "name": "folderDialog", "keys": "Esc"}]
END
