#!/usr/bin/env bash
# Lungs corrected by a file of strokes and seeds: pneuma segment --edits.
# Needs JSON_CHECK (json_check) and SCHEMAS (resources/schemas).
. "$(dirname "$0")/lib.sh"

keeps() { expect "the JSON breaks $1: $("$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$2" 2>&1 | head -n 3)" \
  "$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$2"; }

# edits FILE EDIT...: a file of corrections.
edits() {
  local file=$1
  shift
  local IFS=,
  echo "{\"schema\": \"pneuma/lung-edits/1\", \"edits\": [$*]}" >"$file"
}

# volume SIDE: of the last report, ml.
volume() { awk -v side="\"$1\":" '$1 == side { there = 1 } there && /"volume_ml"/ { gsub(/[^0-9.]/, "", $2); print $2; exit }' "$logs/out"; }
close() { awk -v a="$1" -v b="$2" -v by="$3" 'BEGIN { exit !(a - b <= by && b - a <= by) }'; }

succeeds "the sample chest as CT" sample chest --ct --spacing 1.6 --thick 2.5
succeeds "lungs as they are found" segment chest/ct.nii.gz -o plain.nii.gz --json
right=$(volume right)
left=$(volume left)

# A ball of 20 mm outside of both lungs, in the abdomen: 33.5 ml.
edits paint.json '{"tool": "paint", "lung": "right", "radius_mm": 20, "points": [[0, -20, -160]]}'
keeps lung-edits paint.json
succeeds "a painted ball" segment chest/ct.nii.gz -o painted.nii.gz --edits paint.json --json
keeps segment "$logs/out"
cp "$logs/out" painted.json
expect "the ball has $(awk -v a="$(volume right)" -v b="$right" 'BEGIN { print a - b }') ml" \
  close "$(volume right)" "$(awk -v r="$right" 'BEGIN { print r + 33.51 }')" 0.5
expect "the other lung changed" close "$(volume left)" "$left" 1e-9
expect "the report does not count the edits" grep -q '"edits": 1' painted.json
expect "the edits are no input" grep -q 'paint.json' painted.json

# Erasing the same takes it back; one lung alone is left by the other's eraser.
ball='"radius_mm": 20, "points": [[0, -20, -160]]'
edits back.json "{\"tool\": \"paint\", \"lung\": \"right\", $ball}" "{\"tool\": \"erase\", $ball}"
succeeds "painted and erased" segment chest/ct.nii.gz -o back.nii.gz --edits back.json
prints '^corrected by hand: 2 edits'
succeeds "as it was" compare plain.nii.gz back.nii.gz --min-dice 1
edits other.json "{\"tool\": \"paint\", \"lung\": \"right\", $ball}" "{\"tool\": \"erase\", \"lung\": \"left\", $ball}"
succeeds "erased of the other lung" segment chest/ct.nii.gz -o other.nii.gz --edits other.json
succeeds "still there" compare painted.nii.gz other.nii.gz --min-dice 1
edits none.json
succeeds "no edits" segment chest/ct.nii.gz -o none.nii.gz --edits none.json
succeeds "change nothing" compare plain.nii.gz none.nii.gz --min-dice 1

# A part of a lung that was taken away comes back by a seed.
hole='"radius_mm": 12, "points": [[-75, 10, -60]]'
edits hole.json "{\"tool\": \"erase\", $hole}"
succeeds "a hole" segment chest/ct.nii.gz -o hole.nii.gz --edits hole.json --json
expect "the hole has $(awk -v a="$(volume right)" -v b="$right" 'BEGIN { print b - a }') ml, not 7.2" \
  close "$(volume right)" "$(awk -v r="$right" 'BEGIN { print r - 7.24 }')" 0.3
edits seed.json "{\"tool\": \"erase\", $hole}" '{"tool": "seed", "lung": "right", "points": [[-75, 10, -60]]}'
keeps lung-edits seed.json
succeeds "a seed" segment chest/ct.nii.gz -o seed.nii.gz --edits seed.json --surfaces lungs --json
# Vessels of the hole are denser than the limit.
expect "the seed filled up to $(volume right), not $right" close "$(volume right)" "$right" 1
expect "the seed took more than was erased" awk -v a="$(volume right)" -v b="$right" 'BEGIN { exit !(a <= b) }'
succeeds "its surface" info lungs/right.vtp
prints 'healthy|fit to grow in'
succeeds "the same with one thread" segment chest/ct.nii.gz -o one.nii.gz --edits seed.json --threads 1
succeeds "has the same labels" compare seed.nii.gz one.nii.gz --min-dice 1

# In a recipe, which does the lungs again when the edits change.
cat >recipe.json <<'R'
{ "schema": "pneuma/recipe/1", "open": { "ct": "chest/ct.nii.gz" }, "lungs": { "edits": "hole.json" } }
R
succeeds "a recipe with edits" run recipe.json -o out -q
succeeds "has their lungs" compare hole.nii.gz out/labels.nii.gz --min-dice 1
cp seed.json hole.json
succeeds "with other edits" run recipe.json -o out
prints '^ *lungs +done'
succeeds "has the others" compare seed.nii.gz out/labels.nii.gz --min-dice 1
succeeds "again" run recipe.json -o out
prints '^ *lungs +kept'
succeeds "as a project" run recipe.json -o case.pneuma -q
succeeds "with the same lungs" export case.pneuma -o case -q
expect "the project exports no labels" test -s case/labels.nii.gz
succeeds "to the voxel" compare seed.nii.gz case/labels.nii.gz --min-dice 1
echo '{"schema": "pneuma/recipe/1", "open": {"ct": "chest/ct.nii.gz"}, "lungs": {"edits": "gone.json"}}' >gone-recipe.json
refuses "a recipe whose edits are not there" 3 'gone.json' run gone-recipe.json -o nowhere

# What cannot be.
echo '{' >broken.json
refuses "no JSON" 4 'no JSON near byte' segment chest/ct.nii.gz --edits broken.json
refuses "no file" 3 'gone.json' segment chest/ct.nii.gz --edits gone.json
echo '{"schema": "pneuma/fissures/1"}' >schema.json
refuses "another schema" 4 'should be .*pneuma/lung-edits/1' segment chest/ct.nii.gz --edits schema.json
echo '{"schema": "pneuma/lung-edits/1", "edits": 3}' >list.json
refuses "no list" 4 'no list under "edits"' segment chest/ct.nii.gz --edits list.json
one='"points": [[-75, 10, -60]]'
edits bad.json "{\"tool\": \"paint\", \"lung\": \"right\", $one}" "{\"tool\": \"paint\", \"lung\": \"middle\", $one}"
refuses "an unknown lung" 4 'right or left, not "middle" in edit 2' segment chest/ct.nii.gz --edits bad.json
edits bad.json "{\"tool\": \"paint\", $one}"
refuses "no lung" 4 'which "lung": right or left in edit 1' segment chest/ct.nii.gz --edits bad.json
edits bad.json "{\"tool\": \"scissors\", $one}"
refuses "an unknown tool" 4 'paint, erase or seed, not "scissors"' segment chest/ct.nii.gz --edits bad.json
edits bad.json "{\"tool\": \"erase\", \"radus_mm\": 5, $one}"
refuses "an unknown key" 4 'unknown key "radus_mm" .*"radius_mm"' segment chest/ct.nii.gz --edits bad.json
edits bad.json "{\"tool\": \"erase\", \"radius_mm\": 500, $one}"
refuses "a radius that cannot be" 4 'not from 0.5 to 100' segment chest/ct.nii.gz --edits bad.json
edits bad.json '{"tool": "erase", "points": []}'
refuses "no points" 4 'has no "points" in edit 1' segment chest/ct.nii.gz --edits bad.json
edits bad.json '{"tool": "erase", "points": [[1, 2]]}'
refuses "a point of two numbers" 4 'three numbers' segment chest/ct.nii.gz --edits bad.json
edits bad.json '{"tool": "erase", "points": [[-75, 10, -60], [-75, 0, 9000]]}'
refuses "a point outside the image" 4 "edit 1 of .*bad.json' has a point at .*9000.* outside the image" \
  segment chest/ct.nii.gz --edits bad.json
edits bad.json "{\"tool\": \"seed\", \"lung\": \"right\", $one}"
refuses "a seed in a lung" 4 "bad.json': the seed at .* lies in the right lung already" \
  segment chest/ct.nii.gz --edits bad.json
edits bad.json '{"tool": "seed", "lung": "right", "points": [[0, -20, -160]]}'
refuses "a seed in tissue" 4 'not less dense than -500 HU' segment chest/ct.nii.gz --edits bad.json
refuses "edits as an output" 2 'bad.json' segment chest/ct.nii.gz --edits bad.json --report bad.json --force
finish
