#!/usr/bin/env bash
# The first start asks once what is chosen, and says what Pneuma is for; later starts remember.
# Needs DESKTOP (pneuma-desktop), a display, and a folder OUT for its pictures.
set -u
: "${DESKTOP:?}" "${OUT:?}"
. "$(dirname "$0")/lib.sh"

play() {
  "$DESKTOP" --play "$FOLDER/$1.json" --settings "$FOLDER/settings.ini" --screenshots "$OUT" || fail "$2"
}

cat >"$FOLDER/closed.json" <<'END'
[{"do": "scenario", "name": "first run: welcome, and closed without accepting"},
 {"do": "expect", "name": "welcome", "property": "visible", "equals": true},
 {"do": "screenshot", "file": "01_welcome"},
 {"do": "key", "name": "welcome", "keys": "Esc"}]
END
cat >"$FOLDER/chosen.json" <<'END'
[{"do": "scenario", "name": "first run: asked again, light and a mouse chosen"},
 {"do": "expect", "name": "welcome", "property": "visible", "equals": true},
 {"do": "click", "name": "welcomeLight"},
 {"do": "click", "name": "welcomeMouse_radiology"},
 {"do": "screenshot", "file": "02_chosen"},
 {"do": "click", "name": "welcomeStart"},
 {"do": "expect", "name": "welcome", "property": "visible", "equals": false}]
END
cat >"$FOLDER/later.json" <<'END'
[{"do": "scenario", "name": "first run: not asked later, and what was chosen is kept"},
 {"do": "expect", "name": "actionTheme", "property": "checked", "equals": true},
 {"do": "expect", "name": "actionMouse_radiology", "property": "checked", "equals": true},
 {"do": "screenshot", "file": "03_later"},
 {"do": "trigger", "name": "actionWelcome"},
 {"do": "click", "name": "welcomeTour"},
 {"do": "expect", "name": "tourCount", "contains": "1 of"},
 {"do": "screenshot", "file": "04_tour"}]
END
play closed "the welcome was not shown"
grep -q welcomed "$FOLDER/settings.ini" 2>/dev/null && fail "what nobody accepted was remembered"
play chosen "nothing could be chosen"
play later "what was chosen was not kept"
echo '[{"do": "click", "name": "welcomeStart"}]' >"$FOLDER/unasked.json"
"$DESKTOP" --play "$FOLDER/unasked.json" --settings "$FOLDER/settings.ini" --screenshots "$OUT" 2>"$FOLDER/said" &&
  fail "the welcome came although it was accepted"
grep -q "nothing is called 'welcomeStart'" "$FOLDER/said" || fail "the window did not start: $(cat "$FOLDER/said")"
echo "done"
