#!/usr/bin/env bash
# packaging/bench.sh measures, keeps its history and notices what became slower. Short: figures are no gate here.
# Needs BUILD (the build folder), JSON_CHECK (json_check), SCHEMAS.
set -u
: "${BUILD:?}" "${JSON_CHECK:?}" "${SCHEMAS:?}"
HERE=$(cd "$(dirname "$0")" && pwd)
. "$HERE/lib.sh"

bench() { FILTER='dla_ball' REPETITIONS=1 MIN_TIME=0.01 "$HERE/../../packaging/bench.sh" "$FOLDER/out" >"$FOLDER/said" 2>&1; }

# README quotes every ratio that is taken, and no other.
taken=$(awk '/^ratios="/, /"$/' "$HERE/../../packaging/bench.sh" | sed 's/^ratios="//' | cut -d '|' -f 1 | sort)
quoted=$(sed -n '/^## How fast/,/^## Exit/p' "$HERE/../../README.md" | sed -n 's/^| \(.*\) | .* | [0-9.]* |$/\1/p' | sort)
[ "$taken" = "$quoted" ] || fail "README quotes other ratios: $(diff <(echo "$taken") <(echo "$quoted"))"
bench || fail "it ended with $?: $(tail -n 3 "$FOLDER/said")"
json=$(echo "$FOLDER"/out/history/*.json)
"$JSON_CHECK" "$SCHEMAS/bench.schema.json" "$json" || fail "the JSON breaks its schema"
grep -q '"ours": "dla_ball", "reference": "dla_ball_plainly"' "$json" || fail "there is no ratio: $(cat "$json")"
grep -q '<td>dla_ball_plainly</td>' "$FOLDER/out/bench.html" || fail "the page lacks a benchmark"
# Steps that are jumped over cannot take as long as all of them, whatever else the machine does.
awk '/"times_as_fast"/ { sub(/.*"times_as_fast": /, ""); if ($0 + 0 > 5) ok = 1 } END { exit !ok }' "$json" || fail "jumps are worth nothing: $(cat "$json")"
# A past that was a hundred times as fast.
awk '{ if (match($0, /"units": [0-9.e+-]+/)) { u = substr($0, RSTART + 9, RLENGTH - 9) / 100; $0 = substr($0, 1, RSTART - 1) "\"units\": " u substr($0, RSTART + RLENGTH) } print }' \
  "$json" >"$FOLDER/past.json"
mv "$FOLDER/past.json" "$json"
for n in {0..9}; do # runs of something else since then
  echo '{"name": "other", "units": 1}' >"$FOLDER/out/history/2999010${n}T000000Z.json"
done
sleep 1.1
GATE=1 bench && fail "nothing was noticed although all takes a hundred times as long as before"
grep -q '^dla_ball takes [0-9]* % more units' "$FOLDER/said" || fail "it does not say what became slower: $(cat "$FOLDER/said")"
grep -q 'class="n slower"' "$FOLDER/out/bench.html" || fail "the page does not mark what became slower"
FILTER='no such' "$HERE/../../packaging/bench.sh" "$FOLDER/none" >"$FOLDER/said" 2>&1
[ $? -eq 2 ] || fail "a name that nothing has was not refused"
echo "two runs, one of them slower than its past"
