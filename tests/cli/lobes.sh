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
succeeds "all checks again" check lobes --json
keeps check
succeeds "all checks again, for people" check lobes
prints '^SHARED-right-oblique +0 +0 +right'
expect "ParaView's file does not name the lobes" grep -q 'name="RML" file="rml.vtp"' lobes/lobes.vtm
succeeds "lobes from lobes" lobes lobes --fractions usual -o joined -q
succeeds "lobes from the CT" lobes chest/ct.nii.gz -o of_ct
prints '^RML +[0-9.]+ ml'
succeeds "checks of them" check of_ct -q
succeeds "labels" segment chest/ct.nii.gz -o labels.nii.gz -q
succeeds "lobes from labels" lobes labels.nii.gz -o of_labels -q
expect "the label map has another size" cmp -s of_ct/labels.nii.gz of_labels/labels.nii.gz
cp -r lobes harmed
cp harmed/rul.vtp harmed/rml.vtp
run check harmed
expect "a harmed folder ends with $code, not 7" test "$code" -eq 7
expect "the overlap is not named" grep -q '^OVERLAP-R .*WRONG' "$logs/out"
refuses "a folder without lobes" 4 'holds no lobes' check lungs
refuses "no folder" 3 'absent' check absent
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

succeeds "lobes along the true fissures" lobes lungs --fissures chest/fissures.json -o true --json
cp "$logs/out" true.json
for pair in RUL:0.355 RML:0.190 RLL:0.455 LUL:0.506 LLL:0.494; do
  expect "share of ${pair%:*}: $(share "${pair%:*}" true.json)" awk -v s="$(share "${pair%:*}" true.json)" -v w="${pair#*:}" 'BEGIN { exit !((s - w) ^ 2 < 1e-4) }'
done

cat >points.json <<'P'
{ "schema": "pneuma/fissures/1", "space": "LPS",
  "fissures": { "left-oblique": { "points": [[70, -60, -120], [80, 60, 30], [110, 0, -50]] } } }
P
succeeds "three points in the left lung" lobes lungs/left.vtp --fissures points.json -o three
prints '^left-oblique +proposal bent through points +3'
expect "nothing is said of the part without points" grep -q 'enclose [0-9]* % of it; the rest is a guess' "$logs/err"
expect "the points were not kept" test -s three/fissures.json
expect "there are lobes of a lung that was not given" test ! -e three/rul.vtp

succeeds "points upon the fissures of these lobes" fissures lobes -o sampled.mrk.json --points 12
prints '^right-oblique +12 .* 0.00 mm +0.00 mm +shared'
prints '^RML RUL +[0-9.]+ cm2 +0.00 mm +0.00 mm +shared'
succeeds "the same again" fissures lobes -o sampled.fcsv --points 12 --json
keeps fissure-contacts
succeeds "lobes along these points" lobes lungs --fissures sampled.mrk.json -o along -q
succeeds "... in the older format" lobes lungs --fissures sampled.fcsv -o older -q
expect "the two formats give other lobes" cmp along/rml.vtp older/rml.vtp
succeeds "random points that miss the fissure" fissures lobes -o drawn.json --seed 2 --noise 1mm -q
succeeds "the same seed" fissures lobes -o again.json --seed 2 --noise 1mm -q
expect "the same seed gives other points" cmp drawn.json again.json
refuses "points that are there" 6 'exists' fissures lobes -o drawn.json
refuses "points to another format" 5 'cannot be written as .*fcsv' fissures lobes -o nowhere.txt
refuses "lobes that lack a neighbour" 4 'RUL, RML and RLL, or LUL and LLL' fissures lobes/rul.vtp lobes/rll.vtp -o nowhere.json
fiveBalls balls
refuses "lobes that do not touch" 4 'do not touch: .* within 5 mm' fissures balls/lul.obj balls/lll.obj -o nowhere.json
refuses "fewer points than three" 2 'points' fissures lobes -o nowhere.json --points 2

cat >planes.json <<'P'
{ "schema": "pneuma/fissures/1", "fissures": {
  "right-oblique": { "plane": { "point": [-80, 10, -70], "tilt_deg": 50 } },
  "right-horizontal": { "plane": { "point": [-80, 0, -40], "normal": [0, 0.1, -1] } },
  "left-oblique": { "plane": { "handles": [[70, -60, -120], [80, 60, 30], [110, 0, -50]] } } } }
P
succeeds "planes" lobes lungs --planes planes.json -o flat --json
keeps lobes
expect "not three planes" test "$(grep -c '"source": "plane"' "$logs/out")" -eq 3
succeeds "planes among fissures" lobes lungs --fissures planes.json -o flat2 -q
expect "the same planes give other lobes" cmp flat/rml.vtp flat2/rml.vtp
cat >equation.json <<'P'
{ "schema": "pneuma/fissures/1", "fissures": {
  "left-oblique": { "equation": { "1": -60, "y": 1.15, "yy": -0.0009 } } } }
P
succeeds "an equation" lobes lungs/left.vtp --fissures equation.json -o equation
prints '^left-oblique +equation'
refuses "an equation for planes" 4 'no plane for the left oblique fissure but an equation' lobes lungs --planes equation.json -o nowhere
refuses "points for planes" 4 'no plane for the left oblique fissure but points' lobes lungs --planes points.json -o nowhere
refuses "planes and fissures" 2 'excludes' lobes lungs --planes planes.json --fissures points.json -o nowhere
sed 's/"tilt_deg": 50/"tilt_deg": 0, "turn_deg": 90/' planes.json >upright.json
refuses "a plane that stands upright" 4 'neither side' lobes lungs --planes upright.json -o nowhere
sed 's/-80, 10, -70/-80, 10, 700/' planes.json >above.json
refuses "a plane above the lung" 4 'right oblique fissure does not cross the lung: all of it lies between' lobes lungs --planes above.json -o nowhere

cat >surfaces.json <<'P'
{ "schema": "pneuma/fissures/1", "fissures": {
  "right-oblique": { "surface": "lobes/fissures/right-oblique.vtp" },
  "right-horizontal": { "surface": "lobes/fissures/right-horizontal.vtp" } } }
P
succeeds "surfaces from files" lobes lungs --fissures surfaces.json -o surfaces --json
keeps lobes
expect "not two surfaces" test "$(grep -c '"source": "surface"' "$logs/out")" -eq 2
cp "$logs/out" surfaces.report
for lobe in RUL RML RLL; do
  expect "share of $lobe: $(share "$lobe" surfaces.report)" awk -v s="$(share "$lobe" surfaces.report)" -v w="$(share "$lobe" lobes/lobes.json)" 'BEGIN { exit !((s - w) ^ 2 < 1e-6) }'
done
succeeds "fissures that are kept name the same surfaces" lobes lungs --fissures surfaces/fissures.json -o surfaces2 -q
expect "they give other lobes" cmp surfaces/rml.vtp surfaces2/rml.vtp
refuses "surfaces onto themselves" 2 'input' lobes lungs --fissures surfaces.json -o lobes -f
cat >disk.json <<'P'
{ "schema": "pneuma/fissures/1", "fissures": { "left-oblique": { "surface": "disk.obj" } } }
P
awk 'BEGIN { print "v 90 0 -50"; for (i = 0; i < 24; i++) print "v", 90 + 20 * cos(i * 0.261799), 20 * sin(i * 0.261799), -50
  for (i = 0; i < 24; i++) print "f", 1, i + 2, (i + 1) % 24 + 2 }' >disk.obj
refuses "a surface that ends inside" 4 'left oblique fissure ends inside the lung: at \(.*\) mm its edge lies [0-9.]+ mm' lobes lungs --fissures disk.json -o nowhere
refuses "more extension than there is" 2 'extend' lobes lungs --fissures disk.json --extend 20 -o nowhere
awk 'BEGIN { for (i = 0; i < 30; i++) { a = i / 6 - 2.5; for (s = -1; s < 2; s += 2) print "v", 80 + 60 * sin(a), 80 * s, -50 + 60 * cos(a) }
  for (i = 1; i < 30; i++) print "f", 2 * i - 1, 2 * i, 2 * i + 2 "\nf", 2 * i - 1, 2 * i + 2, 2 * i + 1 }' >disk.obj
refuses "a surface that folds and ends inside" 4 'left oblique fissure ends inside the lung: at \(' lobes lungs --fissures disk.json -o nowhere
awk 'BEGIN { for (j = -10; j <= 10; j++) for (i = -20; i <= 20; i++) print "v", 82 + 7.8 * j, 10 + 6.4 * i - 60 * sin(i * 0.157080), 3 * i - 60
  for (j = 0; j < 20; j++) for (i = 1; i <= 40; i++) { a = 41 * j + i; print "f", a, a + 41, a + 42 "\nf", a, a + 42, a + 1 } }' >disk.obj
succeeds "a surface that folds" lobes lungs --fissures disk.json -o folding --json
keeps lobes
expect "the surface does not fold" grep -q '"source": "folding surface"' "$logs/out"
succeeds "all checks of it" check folding
prints '^LABELS .* right'
prints '^SHARED-left-oblique +0 +0 +right'
refuses "a surface that folds moved to wanted volumes" 4 'folds, so that it cannot be moved' lobes lungs --fissures disk.json --fractions usual -o nowhere
refuses "a surface that folds as a plane" 4 'no plane for the left oblique fissure but a surface' lobes lungs --planes disk.json -o nowhere
ball 40 90 0 -50 >disk.obj
refuses "a closed surface" 4 'is closed; a fissure' lobes lungs --fissures disk.json -o nowhere
rm disk.obj
refuses "a surface that is not there" 3 'disk.obj' lobes lungs --fissures disk.json -o nowhere

cat >accessory.json <<'P'
{ "schema": "pneuma/fissures/1",
  "accessory": [ { "name": "left-horizontal", "lobe": "lul", "plane": { "point": [90, 0, 0], "tilt_deg": 0 } } ] }
P
succeeds "an accessory fissure" lobes lungs --fissures accessory.json -o more --json
keeps lobes
expect "the lobe did not stay whole" cmp lobes/lul.vtp more/lul.vtp
for part in accessory/left-horizontal_below accessory/left-horizontal_above; do
  succeeds "$part" info "more/$part.vtp"
  prints 'healthy'
done
expect "the fissure is not there" test -s more/fissures/left-horizontal.vtp
cp more/fissures.json "$logs/out"
keeps fissures
sed 's/lul/rul/' accessory.json >elsewhere.json
refuses "an accessory fissure of another lung" 4 'right upper lobe, but there is no such lung' lobes lungs/left.vtp --fissures elsewhere.json -o nowhere
sed 's/90, 0, 0/90, 0, 500/' accessory.json >high.json
refuses "an accessory fissure beside its lobe" 4 'accessory fissure left-horizontal does not cross' lobes lungs --fissures high.json -o nowhere
for name in planes equation surfaces points drawn; do
  cp $name.json "$logs/out"
  keeps fissures
done
succeeds "a CT of thin slices" sample thin --ct --spacing 1.5 --thick 1.5 -q
succeeds "its lungs" segment thin/ct.nii.gz -o thin/found.nii.gz --surfaces thin/lungs -q
succeeds "how much of fissures shows" lobes thin/lungs --ct thin/ct.nii.gz --labels thin/found.nii.gz -o shown
prints '^fissure .* shows'
prints '^left-oblique +proposal .* [0-9]+ %'
expect "the patch says nothing of the fissure" grep -q on_fissure shown/fissures/left-oblique.vtp
succeeds "fissures snapped" lobes thin/lungs --ct thin/ct.nii.gz --snap -o snapped --json
keeps lobes
prints '"completeness"'
prints '"share_after"'
succeeds "thick slices" lobes lungs --ct chest/ct.nii.gz -o thick
expect "nothing is said of the slices" grep -q 'slices are 3.00 mm apart' "$logs/err"
refuses "snapping in thick slices" 5 'slices are 3.00 mm apart' lobes lungs --ct chest/ct.nii.gz --snap -o nowhere
refuses "snapping without a CT" 2 'needs the CT' lobes lungs --snap -o nowhere
refuses "snapping and wanted volumes" 2 'leave one' lobes lungs --ct chest/ct.nii.gz --snap --fractions usual -o nowhere

refuses "lobes that are there" 6 'exists' lobes lungs -o lobes
refuses "a lobe alone" 4 'RML RLL is missing' lobes lobes/rul.vtp -o nowhere
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
sed 's/-120/NaN/' points.json >nan.json
refuses "a point that is no number" 4 'no JSON near byte' lobes lungs --fissures nan.json -o nowhere
printf '# CoordinateSystem = LPS\n# columns = label,x,y,z\nLO-1,70,nan,-120\n' >nan.fcsv
refuses "... among markups" 4 "no number in line 3: 'nan'" lobes lungs --fissures nan.fcsv -o nowhere
sed 's/LPS/IJK/; s/nan/1/' nan.fcsv >ijk.fcsv
refuses "markups in voxels" 4 'frame "IJK"; there are LPS' lobes lungs --fissures ijk.fcsv -o nowhere
sed 's/nan/1/; s/LO-1/F-1/' nan.fcsv >F.fcsv
refuses "markups of no fissure" 4 'does not say upon which fissure .*right-oblique, right-horizontal or left-oblique' lobes lungs --fissures F.fcsv -o nowhere
sed 's/\[\([0-9]\)/[-\1/g' points.json >other.json
refuses "points of the other lung" 4 'left oblique fissure lie far from the lung' lobes lungs --fissures other.json -o nowhere
mkdir ball
ball 50 -60 0 0 >ball/right.obj
cat >top.json <<'P'
{ "schema": "pneuma/fissures/1", "fissures": { "right-oblique": { "plane": { "point": [0, 0, 50], "normal": [0, 0, 1] } } } }
P
refuses "a fissure that touches" 4 'touches the lung and does not cross it' lobes ball --planes top.json -o nowhere
refuses "fractions that are none" 2 'fractions are' lobes lungs --fractions 30,40 -o nowhere
refuses "fractions that do not add up" 4 'sum up to 100' lobes lungs --fractions 30,40,50 -o nowhere
refuses "a file for a folder" 6 'is a file' lobes lungs -o points.json
finish
