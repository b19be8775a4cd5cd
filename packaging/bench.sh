#!/usr/bin/env bash
# Runs all benchmarks and writes OUT/bench.html and OUT/history/<time>.json: milliseconds, the same in units of a
# calibration loop that is timed before, between and after, and ratios against references of the same run.
#   packaging/bench.sh [OUT]        (default: bench-output)
# Earlier runs in OUT/history are compared with: a benchmark that takes 25 % more units than the median of the last
# ten is marked, and with GATE=1 ends the script with 1.
#   BUILD=build/release   FILTER=REGEX   REPETITIONS=3   MIN_TIME=0.2 (seconds)   GATE=0
# Units make runs of one kind of machine comparable; ratios of one run hold on any. Run it where nothing else runs.
set -euo pipefail
export LC_ALL=C
out=${1:-bench-output}
mkdir -p "$out/history"
out=$(cd "$out" && pwd)
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=${BUILD:-build/release}
folder=$build/tests/benchmarks
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [[ -z ${PNEUMA_TEST_DATA:-} && -d ../shared/data ]]; then
  PNEUMA_TEST_DATA=$(cd ../shared/data && pwd)
fi
export PNEUMA_TEST_DATA=${PNEUMA_TEST_DATA:-}
[[ -x $folder/pneuma_calibration ]] || {
  echo "bench.sh: there are no benchmarks in $folder; build the preset release with -DPNEUMA_BUILD_BENCHMARKS=ON" >&2
  exit 2
}

# What is asserted anywhere: name | ours | the reference, both timed in this run | what the reference is.
ratios="Kitaoka's tree, 55,000 branches, one thread|kitaoka/instructions:*/threads:1/real_time|kitaoka_plainly|the paper's method read plainly
Aggregation in a ball|dla_ball|dla_ball_plainly|every step of every walker
Distances in mm through a CT|distanceMap/process_time/real_time|distanceMapOfVtk/process_time/real_time|VTK's general filter
A breath of 3 million points played back, one thread|playback/1/real_time|copyOfAsManyBytes/1/real_time|a copy of as many bytes
Two lungs of 131,072 triangles each cut into five lobes|fiveLobes/7/process_time|fullCheckOfBothLungs/7/process_time|a full check of both lungs for self-intersections
A CT of DICOM slices read with every check|readCtOfDicom/process_time/real_time|vtkDicomAlone/process_time/real_time|vtk-dicom alone"

calibrate() { "$folder/pneuma_calibration" | tee -a "$work/calibrations"; }

# Rows: program, name, repetition's clock ms, processor ms, calibration by clock, by processor. Skipped ones are told.
: >"$work/rows"
: >"$work/skipped"
before=$(calibrate)
for program in "$folder"/pneuma_*benchmark*; do
  [[ -f $program && -x $program ]] || continue
  name=$(basename "$program")
  echo "$name ..." >&2
  "$program" --benchmark_format=json --benchmark_repetitions="${REPETITIONS:-3}" --benchmark_min_time="${MIN_TIME:-0.2}" \
    --benchmark_filter="${FILTER:-.}" >"$work/told" 2>"$work/err" || {
    cat "$work/err" >&2
    exit 1
  }
  after=$(calibrate)
  # Its CSV cannot hold benchmarks that count different things; of its JSON a field stands on a line.
  awk -v program="$name" -v before="$before" -v after="$after" '
    BEGIN { split(before, a, " "); split(after, b, " "); unit["ns"] = 1e-6; unit["us"] = 1e-3; unit["ms"] = 1; unit["s"] = 1e3 }
    function value() { sub(/^[^:]*: */, ""); sub(/,$/, ""); gsub(/"/, ""); return $0 }
    /^ *"benchmarks": \[/ { on = 1 }
    !on { next }
    /^ *"name": / { name = value(); sub(/\/repeats:[0-9]+/, "", name); kind = "" }
    /^ *"run_type": / { kind = value() }
    /^ *"real_time": / { real = value() }
    /^ *"cpu_time": / { processor = value() }
    /^ *"error_occurred": true/ { kind = "error" }
    /^ *"error_message": / { why[name] = value() }
    /^ *"time_unit": / && kind == "iteration" {
      per = unit[value()]
      printf "%s\t%s\t%.6f\t%.6f\t%.6f\t%.6f\n", program, name, real * per, processor * per, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2
    }
    END { for (name in why) print name ": " why[name] >>skipped }' skipped="$work/skipped" "$work/told" >>"$work/rows"
  before=$after
done
[[ -s $work/rows ]] || {
  echo "bench.sh: no benchmark is called like '${FILTER:-.}'" >&2
  exit 2
}

# Of every benchmark the median, the shortest and the longest: by the clock where Google Benchmark takes that, else of
# the processor; and the processor's alone, for ratios, which a neighbour disturbs less.
awk -F '\t' '
  function median(list, n,   i, j, t) {
    for (i = 2; i <= n; i++) for (j = i; j > 1 && list[j - 1] > list[j]; j--) { t = list[j]; list[j] = list[j - 1]; list[j - 1] = t }
    return n % 2 ? list[(n + 1) / 2] : (list[n / 2] + list[n / 2 + 1]) / 2
  }
  !($2 in n) { order[++count] = $2; program[$2] = $1 }
  {
    real = $2 ~ /real_time$/
    n[$2]++
    ms[$2, n[$2]] = real ? $3 : $4
    cpu[$2, n[$2]] = $4
    calibration[$2] = real ? $5 : $6
  }
  END {
    for (k = 1; k <= count; k++) {
      name = order[k]
      for (i = 1; i <= n[name]; i++) { a[i] = ms[name, i]; c[i] = cpu[name, i] }
      m = median(a, n[name])
      printf "%s\t%s\t%.6g\t%.6g\t%.6g\t%.6g\t%.6g\n", program[name], name, m, a[1], a[n[name]], m / calibration[name], median(c, n[name])
    }
  }' "$work/rows" >"$work/table"

# Ratios; of several instruction sets (a * in the name) the fastest.
while IFS='|' read -r what ours reference is; do
  awk -F '\t' -v what="$what" -v ours="$ours" -v reference="$reference" -v is="$is" '
    BEGIN { pattern = ours; gsub(/[*]/, "[0-9]+", pattern); pattern = "^" pattern "$" }
    $2 ~ pattern && (best == "" || $7 < best) { best = $7; name = $2 }
    $2 == reference { other = $7 }
    END { if (best > 0 && other > 0) printf "%s\t%s\t%s\t%s\t%.3g\n", what, name, reference, is, other / best }' "$work/table"
done <<<"$ratios" >"$work/ratios"

# The units of the last ten runs of each: one line a benchmark in each file, as written below.
find "$out/history" -name '*.json' | sort -r | while read -r file; do
  sed -n 's/.*"name": "\([^"]*\)".*"units": \([0-9.e+-]*\).*/\1\t\2/p' "$file"
done | awk -F '\t' '++n[$1] <= 10' >"$work/earlier"
awk -F '\t' '
  FILENAME == ARGV[1] { k = ++n[$1]; for (; k > 1 && list[$1, k - 1] > $2 + 0; k--) list[$1, k] = list[$1, k - 1]; list[$1, k] = $2 + 0; next }
  { m = n[$2] ? (n[$2] % 2 ? list[$2, (n[$2] + 1) / 2] : (list[$2, n[$2] / 2] + list[$2, n[$2] / 2 + 1]) / 2) : ""
    print $0 "\t" (m == "" ? "" : sprintf("%.4f", $6 / m)) }' "$work/earlier" "$work/table" >"$work/compared"

stamp=$(date -u +%Y%m%dT%H%M%SZ)
version=$("$build/app/cli/pneuma" version 2>/dev/null || echo "core only")
processor=$(sed -n 's/^model name[[:space:]]*: //p' /proc/cpuinfo | head -n 1)
load=$(cut -d ' ' -f 1-3 /proc/loadavg)
json="$out/history/$stamp.json"
{
  printf '{\n "schema": "pneuma/benchmarks/1",\n "time": "%s",\n "version": "%s",\n "processor": "%s",\n "cores": %s,\n "load": "%s",\n' \
    "$stamp" "$version" "$processor" "$(nproc)" "$load"
  printf ' "calibration_ms": [%s],\n "benchmarks": [\n' "$(awk '{ print $1 }' "$work/calibrations" | paste -sd, | sed 's/,/, /g')"
  awk -F '\t' '{ printf "%s  {\"program\": \"%s\", \"name\": \"%s\", \"ms\": %s, \"shortest_ms\": %s, \"longest_ms\": %s, \"units\": %s, \"processor_ms\": %s}", (NR > 1 ? ",\n" : ""), $1, $2, $3, $4, $5, $6, $7 }' "$work/table"
  printf '\n ],\n "ratios": [\n'
  awk -F '\t' '{ printf "%s  {\"what\": \"%s\", \"ours\": \"%s\", \"reference\": \"%s\", \"reference_is\": \"%s\", \"times_as_fast\": %s}", (NR > 1 ? ",\n" : ""), $1, $2, $3, $4, $5 }' "$work/ratios"
  printf '\n ]\n}\n'
} >"$json.part"
mv "$json.part" "$json"

html() { sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g' <<<"$1"; }
{
  cat <<END
<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Pneuma: benchmarks</title><style>
body { font: 15px/1.5 sans-serif; max-width: 72em; margin: 2em auto; padding: 0 1em; color: #1b242d; background: #fff }
table { border-collapse: collapse; width: 100%; margin: 1em 0 2em } th { text-align: left } td, th { padding: .25em .8em .25em 0; border-bottom: 1px solid #dde3e8 }
td.n, th.n { text-align: right; font-variant-numeric: tabular-nums } .slower { color: #b3261e; font-weight: 600 }
</style></head><body><h1>Pneuma: benchmarks</h1>
<p>$(html "$version"), $stamp, $(html "$processor"), $(nproc) cores, load $load.
The calibration loop took $(awk '{ print $1 }' "$work/calibrations" | sort -n | sed -n '1p;$p' | paste -sd ' ' | sed 's/ / to /') ms.</p>
<h2>Against references of the same run</h2>
<table><tr><th>What</th><th>Reference</th><th class="n">times as fast</th></tr>
END
  while IFS=$'\t' read -r what _ _ is ratio; do
    printf '<tr><td>%s</td><td>%s</td><td class="n">%s</td></tr>\n' "$(html "$what")" "$(html "$is")" "$ratio"
  done <"$work/ratios"
  echo '</table><h2>All</h2><table><tr><th>Benchmark</th><th class="n">ms</th><th class="n">shortest</th><th class="n">longest</th><th class="n">calibration units</th><th class="n">against earlier runs</th></tr>'
  while IFS=$'\t' read -r _ name ms low high units _ change; do
    awk -v name="$(html "$name")" -v ms="$ms" -v low="$low" -v high="$high" -v units="$units" -v change="$change" 'BEGIN {
      printf "<tr><td>%s</td><td class=\"n\">%.4g</td><td class=\"n\">%.4g</td><td class=\"n\">%.4g</td><td class=\"n\">%.4g</td><td class=\"n%s\">%s</td></tr>\n",
        name, ms, low, high, units, (change > 1.25 ? " slower" : ""), (change == "" ? "" : sprintf("%+.0f %%", 100 * (change - 1))) }'
  done <"$work/compared"
  echo '</table></body></html>'
} >"$work/bench.html"
mv "$work/bench.html" "$out/bench.html"

awk -F '\t' '{ printf "%-55s %s times as fast as %s\n", $1, $5, $4 }' "$work/ratios"
sort "$work/skipped" | sed 's/^/not run: /'
[[ -n ${FILTER:-} ]] || while IFS='|' read -r what _; do
  grep -qF "$what"$'\t' "$work/ratios" || echo "not compared: $what"
done <<<"$ratios"
slower=$(awk -F '\t' '$8 != "" && $8 > 1.25 { printf "%s takes %.0f %% more units than before\n", $2, 100 * ($8 - 1) }' "$work/compared")
[[ -z $slower ]] || echo "$slower"
echo "$json"
echo "$out/bench.html"
[[ -z $slower || ${GATE:-0} == 0 ]]
