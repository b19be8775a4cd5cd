#!/usr/bin/env bash
# Lungs into lobes: the sample chest's lungs from its CT, proposed fissures, given points, wanted volumes, bad input.
# Needs JSON_CHECK (json_check) and SCHEMAS (resources/schemas).
. "$(dirname "$0")/lib.sh"

keeps() { expect "the JSON breaks $1: $("$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$logs/out" 2>&1 | head -n 3)" \
  "$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$logs/out"; }
# share LOBE: its share of the lung in a report.
share() { awk -v lobe="$1" '/"lobe"/ { this = $2 } /"share_of_lung"/ && this ~ "\"" lobe "\"" { gsub(/[^0-9.e-]/, "", $2); print $2; exit }' "$2"; }

succeeds "a CT" sample chest --ct --spacing 2 --thick 3 -q
succeeds "its lungs" segment chest/ct.nii.gz --surfaces lungs --central central.vtp -q

succeeds "lobes as most people have them" lobes lungs -o lobes
prints '^RUL +[0-9.]+ ml'
prints '^left-oblique +proposal'
for lobe in rul rml rll lul lll; do
  succeeds "$lobe" info "lobes/$lobe.vtp"
  prints 'healthy'
done
succeeds "a fissure" info lobes/fissures/right-oblique.vtp
succeeds "a tree in the lobes" grow lobes --central central.vtp --method centroid --terminals 2000 -o tree.vtp
prints 'outside their lobe: 0 ends, 0 branches'

succeeds "lobes of wanted volumes" lobes lungs --fractions 36,18,46/55,45 -o wanted --json
keeps lobes
cp "$logs/out" wanted.json
for pair in RUL:0.36 RML:0.18 RLL:0.46 LUL:0.55 LLL:0.45; do
  expect "share of ${pair%:*}: $(share "${pair%:*}" wanted.json)" awk -v s="$(share "${pair%:*}" wanted.json)" -v w="${pair#*:}" 'BEGIN { exit !((s - w) ^ 2 < 1e-12) }'
done
succeeds "the same again" lobes lungs --fractions 36,18,46/55,45 -o again -q -j 1
expect "another number of threads gives other lobes" diff -r wanted again -x lobes.json

cat >points.json <<'P'
{ "schema": "pneuma/fissures/1", "space": "LPS",
  "fissures": { "left-oblique": { "points": [[70, -60, -120], [80, 60, 30], [110, 0, -50]] } } }
P
succeeds "three points in the left lung" lobes lungs/left.vtp --fissures points.json -o three
prints '^left-oblique +proposal bent through points +3'
expect "the points were not kept" test -s three/fissures.json
expect "there are lobes of a lung that was not given" test ! -e three/rul.vtp

refuses "lobes that are there" 6 'exists' lobes lungs -o lobes
refuses "no lung" 4 'no whole lung' lobes lobes -o nowhere
refuses "points without their lung" 4 'no left lung' lobes lungs/right.vtp --fissures points.json -o nowhere
sed 's/\[70/[470/' points.json >far.json
refuses "points far away" 4 'far from the lung: they take .* the lung' lobes lungs --fissures far.json -o nowhere
echo '{ "schema": "pneuma/fissures/1", "fissures": { "left-oblique": { "points": [[70, -60, -120], [80, 60, 30]] } } }' >two.json
refuses "two points" 4 'three points' lobes lungs --fissures two.json -o nowhere
echo '{ "schema": "pneuma/fissures/1", "fissures": { "left-oblique": { "points": [[70, -60, -120], [70, -50, -120], [70, -40, -120]] } } }' >line.json
refuses "points on a line" 4 'one line' lobes lungs --fissures line.json -o nowhere
echo '{ "schema": "pneuma/fissures/1", "fissures": { "left": { "points": [] } } }' >name.json
refuses "a fissure that there is not" 4 'names a fissure' lobes lungs --fissures name.json -o nowhere
echo '{ "schema": "pneuma/fissures/1", "fissures": { "left-oblique": { "points": [[1, 2]] } } }' >pair.json
refuses "a point of two numbers" 4 'point 1 of "left-oblique"' lobes lungs --fissures pair.json -o nowhere
echo '{' >broken.json
refuses "no JSON" 4 'no JSON near byte' lobes lungs --fissures broken.json -o nowhere
refuses "points that are not there" 3 'absent' lobes lungs --fissures absent.json -o nowhere
refuses "points in another format" 5 'cannot be read as points' lobes lungs --fissures lungs/left.vtp -o nowhere
refuses "fractions that are none" 2 'fractions are' lobes lungs --fractions 30,40 -o nowhere
refuses "fractions that do not add up" 4 'sum up to 100' lobes lungs --fractions 30,40,50 -o nowhere
refuses "a file for a folder" 6 'is a file' lobes lungs -o points.json
finish
