#!/usr/bin/env bash
# How fast the window is: a table of times and rates for a person's usual acts, by the real program
# under a display. Run by hand on a machine that does nothing else; no test, as times are no gates.
#   tests/benchmarks/window.sh [CT]
# PROGRAM: pneuma-desktop (build/release/app/gui/pneuma-desktop); CT: of a person, or a generated one.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
desktop=$(realpath "${PROGRAM:-build/release/app/gui/pneuma-desktop}")
pneuma=$(dirname "$desktop")/../cli/pneuma
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
ct=${1:-}
if [[ -z $ct ]]; then
  "$pneuma" sample "$work/ct" --ct -q
  ct=$work/ct/ct.nii.gz
fi
ct=$(realpath "$ct")
export XDG_CONFIG_HOME=$work
unset XDG_STATE_HOME

# play NAME: plays the script on standard input; prints its laps.
play() {
  cat >"$work/$1.json"
  "$desktop" --play "$work/$1.json" --screenshots "$work"
}

# From the start of the program until its window is there, does what it is told, and is gone again.
start_of_window() {
  local before after
  before=$(date +%s.%N)
  play empty <<<'[]'
  after=$(date +%s.%N)
  awk -v a="$after" -v b="$before" 'BEGIN { printf "%.3f s\n", a - b }'
}

echo "load before: $(cut -d' ' -f1-3 /proc/loadavg)"
for n in 1 2 3; do echo "start to the first picture and end ($n): $(start_of_window)"; done

play chest <<'END'
[{"do": "lap", "name": "(start)"},
 {"do": "trigger", "name": "actionSample"}, {"do": "wait", "seconds": 60},
 {"do": "lap", "name": "sample chest"},
 {"do": "click", "name": "stepAirways"}, {"do": "click", "name": "method_centroid"},
 {"do": "set", "name": "option_terminals", "value": 15000}, {"do": "lap", "name": "(form)"},
 {"do": "click", "name": "grow"}, {"do": "wait", "seconds": 60}, {"do": "pause", "seconds": 0.001},
 {"do": "lap", "name": "30,000 branches grown and shown"},
 {"do": "expect", "state": "branches", "above": 28000}]
END

"$pneuma" sample "$work/thin" --ct --thick 1.25 --spacing 1 -q
cat >"$work/fissure.json" <<END
[{"do": "open", "paths": ["$work/thin/ct.nii.gz"]}, {"do": "wait", "seconds": 300},
 {"do": "click", "name": "stepLobes"}, {"do": "click", "name": "edit_right-oblique"},
 {"do": "click-point", "name": "slice_axial", "point": [-75.6, 14.3, 0]},
 {"do": "trigger", "name": "actionPlacePoints"},
 {"do": "click-point", "name": "slice_sagittal", "point": [-75.6, -37.7, -97.4]},
 {"do": "click-point", "name": "slice_sagittal", "point": [-75.6, 2.3, -60.0]},
 {"do": "click-point", "name": "slice_coronal", "point": [-103.6, 14.3, -55.8]},
 {"do": "click-point", "name": "slice_sagittal", "point": [-75.6, 66.3, 25.6]}, {"do": "pause", "seconds": 1},
 {"do": "lap", "name": "(points)"},
 {"do": "drag-point", "name": "slice_sagittal", "from": [-75.6, 2.3, -60.0], "to": [-75.6, 2.3, -45.0]},
 {"do": "pause", "seconds": 0.001},
 {"do": "lap", "name": "a fissure point dragged by 4 moves, lobes recoloured at each (0.08 s of it waited)"}]
END
"$desktop" --play "$work/fissure.json" --screenshots "$work"

cat >"$work/ct.json" <<END
[{"do": "lap", "name": "(start)"},
 {"do": "open", "paths": ["$ct"]}, {"do": "wait-until", "state": "axial", "above": -1, "seconds": 120},
 {"do": "lap", "name": "CT to slices"},
 {"do": "wait", "seconds": 300}, {"do": "pause", "seconds": 0.001},
 {"do": "lap", "name": "and to coloured lungs"},
 {"do": "wheel", "name": "slice_axial", "notches": -1, "times": 100},
 {"do": "lap", "name": "100 axial slices with crosshair in the others"},
 {"do": "wheel", "name": "slice_coronal", "notches": -1, "times": 100},
 {"do": "lap", "name": "100 coronal slices"},
 {"do": "wheel", "name": "slice_sagittal", "notches": -1, "times": 100},
 {"do": "lap", "name": "100 sagittal slices"},
 {"do": "click", "name": "stepOpen"}, {"do": "pause", "seconds": 20}]
END
"$desktop" --play "$work/ct.json" --screenshots "$work" &
pid=$!
# The last 20 s of the script do nothing.
sleep_until_idle() {
  local last=-1 now
  while kill -0 $pid 2>/dev/null; do
    now=$(awk '{ print $14 + $15 }' "/proc/$pid/stat")
    ((last >= 0 && now - last == 0)) && return
    last=$now
    sleep 1
  done
}
sleep_until_idle
before=$(awk '{ print $14 + $15 }' "/proc/$pid/stat")
sleep 5
after=$(awk '{ print $14 + $15 }' "/proc/$pid/stat")
echo "processor while nothing is done: $(awk -v a="$after" -v b="$before" 'BEGIN { printf "%.1f %%", (a - b) / 5 }')"
grep -E 'VmHWM' "/proc/$pid/status" | awk '{ printf "most memory: %.0f MB\n", $2 / 1024 }'
wait $pid
