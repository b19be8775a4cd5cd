#!/usr/bin/env bash
# From a CT to a grown tree: the sample chest as DICOM series and volume, lungs, recipe, comparison with the truth.
# Needs JSON_CHECK (json_check) and SCHEMAS (resources/schemas).
. "$(dirname "$0")/lib.sh"

keeps() { expect "the JSON breaks $1: $("$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$logs/out" 2>&1 | head -n 3)" \
  "$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$logs/out"; }

succeeds "the sample chest as CT" sample chest --ct --spacing 1.6 --thick 2.5
cp -r chest/dicom "chest/two  blanks ü"

# Left and right, before anything else is asked.
succeeds "info tells left from right" info chest/ct.nii.gz
prints '^  left and right are as in most people'
succeeds "a mirrored chest" sample mirror --ct --spacing 2.5 --thick 5 --mirror
succeeds "info of a mirrored chest" info mirror/ct.nii.gz
prints '^  ! left and right may be swapped'

# Lungs, from the series and from the volume: the same.
succeeds "lungs of a series" segment "chest/two  blanks ü" -o labels.nii.gz --surfaces lungs --central central.vtp --json
keeps segment
succeeds "lungs of a volume" segment chest/ct.nii.gz -o other.nii.gz
prints '^right +[0-9.]+ ml'
prints '^carina: [RL] [0-9.]+  [AP] [0-9.]+  [SI] [0-9.]+ mm'
succeeds "both have the same lungs" compare labels.nii.gz other.nii.gz --min-dice 1
succeeds "they are those of the truth" compare chest/labels.nii.gz labels.nii.gz --json
keeps compare-shapes
cp "$logs/out" truth.json
# dice NAME: the overlap of a label with the truth.
dice() { awk -v name="$1" '/"name"/ { this = $2 } /"dice"/ && this ~ "\"" name "\"" { gsub(/[^0-9.e-]/, ""); print; exit }' truth.json; }
for lung in right left; do
  expect "Dice of the $lung lung: $(dice $lung)" awk -v d="$(dice $lung)" 'BEGIN { exit !(d >= 0.985) }'
done
for surface in right left; do
  succeeds "the surface of the $surface lung" info "lungs/$surface.vtp"
  prints 'healthy'
done
succeeds "the surface is itself" compare lungs/right.vtp lungs/right.vtp --max-distance 0.001
caseName="two lungs are not one"
cases=$((cases + 1))
run compare lungs/right.vtp lungs/left.vtp --max-distance 5
[ "$code" -eq 8 ] || fail "exit code $code, not 8"
succeeds "fewer triangles" segment chest/ct.nii.gz --surfaces few --triangles 20000 -q
succeeds "they are closed" info few/left.vtp
prints 'fit to grow in|healthy'
succeeds "a tree in the lungs" grow lungs --central central.vtp --method centroid --terminals 2000 -o tree.vtp
prints 'outside their lobe: 0 ends, 0 branches'

# The same in one go.
cat >recipe.json <<'R'
{ "schema": "pneuma/recipe/1",
  "open": { "ct": "chest/dicom" },
  "lungs": { "threshold": "-500HU", "triangles": 40000 },
  "lobes": { "fractions": "usual", "smoothness": 0.05 },
  "airways": { "method": "centroid", "terminals": 2000 },
  "export": { "tree": ["swc"] } }
R
succeeds "what a recipe would do" run recipe.json -o out --dry-run
prints '^ *lungs +to do'
expect "a dry run wrote something" test ! -e out
succeeds "a recipe" run recipe.json -o out --json
keeps run-report
for file in labels.nii.gz right.vtp left.vtp central.vtp lungs.json tree.vtp growth.json tree.swc run.json lobes/rul.vtp \
  lobes/lll.vtp lobes/fissures/right-oblique.vtp lobes/lobes.vtm lobes/labels.nii.gz lobes/lobes.json; do
  expect "$file is not there" test -s "out/$file"
done
"$JSON_CHECK" "$SCHEMAS/segment.schema.json" out/lungs.json || fail "lungs.json breaks its schema"
"$JSON_CHECK" "$SCHEMAS/growth.schema.json" out/growth.json || fail "growth.json breaks its schema"
"$JSON_CHECK" "$SCHEMAS/lobes.schema.json" out/lobes/lobes.json || fail "lobes.json breaks its schema"
succeeds "its lobes are sound" check out/lobes -q
succeeds "again" run recipe.json -o out
prints '^ *lungs +kept'
prints '^ *lobes +kept'
prints '^ *airways +kept'
echo '{ "schema": "pneuma/fissures/1", "fissures": { "right-oblique": { "surface": "out/lobes/fissures/right-oblique.vtp" } } }' >named.json
sed 's/"fractions": "usual"/"fissures": "named.json"/' recipe.json >by-surfaces.json
succeeds "a recipe that gives a fissure by its surface" run by-surfaces.json -o named --up-to lobes -q
succeeds "its fissures name the surface that was given" lobes named/right.vtp named/left.vtp --fissures named/lobes/fissures.json -o from-named -q
sed -i 's/2000/1500/' recipe.json
succeeds "with other options for the tree" run recipe.json -o out
prints '^ *lobes +kept'
prints '^ *airways +done'
prints '^ *export +done'
expect "the tree does not grow in lobes" grep -q '"RML"' out/growth.json
cp out/right.vtp right-before.vtp
echo >>out/left.vtp
refuses "a surface that somebody changed" 6 "left.vtp' was changed since.*--force" run recipe.json -o out --up-to lungs
succeeds "with a surface that was changed, all the same" run recipe.json -o out --up-to lungs --force
prints '^ *lungs +done'
expect "the tree of other lungs is still there" test ! -e out/tree.vtp
expect "lobes of other lungs are still there" test ! -e out/lobes
cmp -s out/right.vtp right-before.vtp || fail "the same options give another surface"
prints '^ *airways +not asked for'
succeeds "from the airways on" run recipe.json -o out --from airways
prints '^ *lungs +kept'
prints '^ *airways +done'
succeeds "without a recipe" run --ct chest/dicom -o plain --up-to lungs -q

# The key is what was read: all slices of a file's series, and nothing else in the folder.
cp -r chest/dicom series
first="series/$(ls series | head -n 1)"
last="series/$(ls series | tail -n 1)"
succeeds "one file of a series" run --ct "$first" -o one --up-to lungs -q
mkdir series/deep && cp labels.nii.gz series/deep
succeeds "with a file beside it that is no part of it" run --ct "$first" -o one --up-to lungs
prints '^ *lungs +kept'
rm "$last"
succeeds "with a slice less" run --ct "$first" -o one --up-to lungs
prints '^ *lungs +done'
echo '{"schema": "pneuma/run/1", "stages": {"lungs": [1]}}' >one/run.json
refuses "a state that is none" 6 'was not left by a run' run --ct series -o one --up-to lungs
mkdir foreign && echo mine >foreign/labels.nii.gz
refuses "a folder with another's labels" 6 "labels.nii.gz' is there already" run --ct series -o foreign --up-to lungs
mkdir itself && cp chest/ct.nii.gz itself/labels.nii.gz
refuses "the CT as its own labels" 6 'is the CT itself' run --ct itself/labels.nii.gz -o itself --up-to lungs --force
long="$(printf 'x%.0s' $(seq 300))"
refuses "a folder whose name is too long" 6 'cannot be made|File name too long' run --ct series -o "$long" --up-to lungs
refuses "a CT whose name is too long" 3 'no .xxx' run --ct "$long" -o nowhere

# What cannot be.
refuses "no recipe and no CT" 2 'needs a recipe' run -o nowhere
echo '{"schema": "pneuma/recipe/1", "open": {"ct": "away.nii"}}' >leads-nowhere.json
refuses "a recipe whose CT is not there" 3 "no 'away.nii', which 'leads-nowhere.json' names as the CT" run leads-nowhere.json -o nowhere
refuses "the same for a project" 3 "no 'away.nii', which 'leads-nowhere.json' names as the CT" run leads-nowhere.json -o nowhere.pneuma
echo '{"schema": "pneuma/recipe/1", "open": {"ct": "series"}, "airways": {"method": "ki4aoka"}}' >odd.json
refuses "a recipe of a method that is none" 2 "^pneuma: 'odd.json': the growth method is one of .*'ki4aoka'" run odd.json -o nowhere
refuses "a recipe that is not there" 3 'no .*absent.json' run absent.json -o nowhere
echo '{' >broken.json
refuses "a recipe that is no JSON" 4 'no JSON near byte' run broken.json -o nowhere
echo '{"schema": "pneuma/recipe/1", "lungs": {"closing": 1e999}}' >large.json
refuses "a recipe with a number that is too large" 4 'number that is too large' run large.json -o nowhere
echo '{"schema": "pneuma/recipe/9"}' >schema.json
refuses "a recipe of another schema" 4 'should be .*pneuma/recipe/1' run schema.json -o nowhere
echo '{"schema": "pneuma/recipe/1", "lngs": {}}' >stage.json
refuses "an unknown stage" 4 'did you mean .*lungs' run stage.json -o nowhere
echo '{"schema": "pneuma/recipe/1", "lungs": {"thresholds": 1}}' >key.json
refuses "an unknown key" 4 'did you mean .*threshold' run key.json -o nowhere
echo '{"schema": "pneuma/recipe/1", "lungs": {"threshold": 5}}' >range.json
refuses "a value out of range" 2 'threshold.*-900.*-200' run range.json -o nowhere
echo '{"schema": "pneuma/recipe/1", "breathing": {}}' >breathing.json
refuses "a stage to come" 5 'breathing.*does not have' run breathing.json -o nowhere
echo '{"schema": "pneuma/recipe/1", "lobes": {"fisures": "f.json"}}' >lobes.json
refuses "an unknown key of lobes" 4 'under "lobes": "fisures"; did you mean "fissures"' run lobes.json -o nowhere
echo '{"schema": "pneuma/recipe/1", "lobes": {"snap": 1}}' >lobes.json
refuses "snap that is a number" 4 'true or false under "snap"' run lobes.json -o nowhere
echo '{"schema": "pneuma/recipe/1", "lobes": {"snap": true, "fractions": "usual"}}' >lobes.json
refuses "fractions with snap" 4 'both "fractions" and "snap"' run lobes.json -o nowhere
echo '{"schema": "pneuma/recipe/1", "lobes": {"fissures": "gone.json"}}' >lobes.json
refuses "fissures that are not there" 3 'no .*gone.json' run lobes.json --ct chest/ct.nii.gz -o nowhere
echo '{"schema": "pneuma/recipe/1", "lobes": {"snap": true}}' >lobes.json
refuses "snapping in thick slices" 5 'slices are .* apart' run lobes.json --ct chest/ct.nii.gz -o thick
echo '{"schema": "pneuma/recipe/1", "open": {"ct": "gone"}}' >gone.json
refuses "a CT that is not there" 3 "no .*gone" run gone.json -o nowhere
echo '{"schema": "pneuma/recipe/1"}' >empty.json
refuses "a recipe without a CT" 4 'names no CT' run empty.json -o nowhere
refuses "an unknown stage to begin with" 2 "did you mean 'lungs'" run recipe.json -o nowhere --from lngs
refuses "a file for a folder" 6 'is a file' run recipe.json -o recipe.json
refuses "lungs of what is not there" 3 'gone.*not there' segment gone
refuses "labels that are there" 6 'exists' segment chest/ct.nii.gz -o labels.nii.gz
refuses "labels in another format" 5 'nii' segment chest/ct.nii.gz -o labels.png
refuses "a threshold that cannot be" 2 'threshold.*-900' segment chest/ct.nii.gz --threshold 100
refuses "labels as a CT" 5 'Hounsfield|HU' segment chest/labels.nii.gz -o x.nii.gz
refuses "labels on other voxels" 4 'same voxels' compare labels.nii.gz "$(
  "$PNEUMA" sample small --ct --spacing 4 --thick 5 -q >/dev/null && echo small/labels.nii.gz)"
refuses "limits for trees" 2 'min-dice' compare tree.vtp tree.vtp --min-dice 0.5
finish
