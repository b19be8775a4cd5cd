#!/usr/bin/env bash
# Lungs that breathe: lobes of the sample chest with a tree grown in them, bad input.
# Needs JSON_CHECK (json_check) and SCHEMAS (resources/schemas).
. "$(dirname "$0")/lib.sh"

keeps() { expect "the JSON breaks $1: $("$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$logs/out" 2>&1 | head -n 3)" \
  "$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$logs/out"; }
# column NAME FILE: a column of a table without its head.
column() { awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) c = i; next } { print $c }' "$2"; }

succeeds "a chest" sample chest --cell 5mm -q
mkdir parts && cp chest/*.stl parts # a tenth of the triangles
succeeds "its lobes, which share their triangles" lobes chest -o lobes -q
succeeds "a tree in it" grow lobes --central chest/central.vtp --method centroid --terminals 500 -o tree.vtp -q
succeeds "quiet breathing" breathe lobes tree.vtp -o breath.pvd --frames 8 --scenario vital-capacity --json
keeps breathe
for file in breath.pvd breath.csv breath.json breath.vtp.series breath_0000.vtp breath_0007.vtp breath_tree_0000.vtp breath_tree_0007.vtp; do
  expect "$file is not there" test -s "$file"
done
expect "there are not eight frames" test "$(find . -name 'breath_0*.vtp' | wc -l)" -eq 8
expect "the collection does not end with the first frame" grep -q 'timestep="8" group="" part="0" file="breath_0000.vtp"' breath.pvd
expect "the series does not name the frames" test "$(grep -c '"name"' breath.vtp.series)" -eq 9
expect "the table has not eight rows" test "$(column volume_ml breath.csv | wc -l)" -eq 8
expect "the volume does not go up and down by three litres" awk -F, '
  NR == 2 { least = $6; most = $6 }
  NR > 1 { if ($6 < least) least = $6; if ($6 > most) most = $6 }
  END { exit most - least > 2700 && most - least < 3050 ? 0 : 1 }' breath.csv
succeeds "a frame is a healthy surface" info breath_0003.vtp
succeeds "a frame of the airways" info breath_tree_0003.vtp
prints 'branches'

# Frames in pieces, with the chest wall of a pneumothorax.
mkdir pieces
succeeds "frames in pieces" breathe parts tree.vtp -o pieces/air.pvd --frames 2 --scenario pneumothorax --largest-file 100K -q
named=$(cd pieces && grep -ho 'file="[^"]*"' $(grep -o 'file="[^"]*"' air.pvd | cut -d'"' -f2) | cut -d'"' -f2 | sort -u)
for thing in air air_tree air_chest_wall; do
  for file in "${thing}_0000/${thing}_0000_0.vtp" "${thing}_0001/${thing}_0001_1.vtp"; do
    expect "$file is not named" grep -qx "$file" <<<"$named"
  done
done
expect "a part is no .vtm, or not alone at its moment" test \
  "$(grep -o 'timestep="0" group="" part="[0-2]" file="[a-z_]*_0000.vtm"' pieces/air.pvd | cut -d'"' -f6 | tr -d '\n')" = 012
expect "others are named than there are" test "$named" = "$(cd pieces && find . -name '*.vtp' | cut -c3- | sort)"
expect "larger files: $(find pieces -name '*.vtp' -size +100k)" test -z "$(find pieces -name '*.vtp' -size +100k)"
expect "a series of pieces" test ! -e pieces/air.vtp.series
refuses "a whole frame's chest wall over pieces" 6 "exists already" \
  breathe parts -o pieces/air.pvd --frames 2 --scenario pneumothorax
rm pieces/air.{pvd,csv,json}
refuses "pieces over others" 6 "air_0000.vtm' exists already; add --force" \
  breathe parts tree.vtp -o pieces/air.pvd --frames 2 --scenario pneumothorax --largest-file 100K
succeeds "pieces over others, by force" breathe parts tree.vtp -o pieces/air.pvd --frames 2 --scenario pneumothorax --largest-file 100K -q -f
expect "something was left: $(find pieces -name '.*')" test -z "$(find pieces -name '.*')"
refuses "pieces beside a series of what is whole" 6 "breath.vtp.series' would stand beside this breath" \
  breathe parts -o breath.pvd --frames 2 --largest-file 100K -f
# A chest wall larger than what it is around: it is drawn anew, and these lobes share no triangles.
succeeds "coarse lobes" sample coarse --cell 6mm -q
mkdir few wall && cp coarse/*.stl few
succeeds "a chest wall in pieces alone" breathe few -o wall/air.pvd --frames 2 --scenario pneumothorax --largest-file 2500K -q
expect "the frame is in pieces, or the chest wall is not" \
  test -s wall/air_0000.vtp -a -s wall/air_chest_wall_0001.vtm -a -s wall/air_chest_wall_0001/air_chest_wall_0001_1.vtp
refuses "pieces of nothing" 2 'largest-file is 64K or more' breathe parts -o other.pvd --largest-file 1K

# An egg of a right lung's size, in rings of points from pole to pole.
awk 'BEGIN {
  rings = 16; around = 24; pi = atan2(0, -1)
  print "v -70 10 160"
  for (r = 1; r < rings; r++) for (k = 0; k < around; k++)
    printf "v %f %f %f\n", -70 + 60 * sin(pi * r / rings) * cos(2 * pi * k / around),
      10 + 95 * sin(pi * r / rings) * sin(2 * pi * k / around), 30 + 130 * cos(pi * r / rings)
  print "v -70 10 -100"
  for (k = 0; k < around; k++) {
    n = (k + 1) % around
    print "f", 1, 2 + k, 2 + n
    for (r = 0; r < rings - 2; r++) {
      a = 2 + r * around
      print "f", a + k, a + around + k, a + around + n
      print "f", a + k, a + around + n, a + n
    }
    print "f", 2 + (rings - 2) * around + k, 2 + (rings - 1) * around, 2 + (rings - 2) * around + n
  }
}' > right.obj
succeeds "a breath with its curve" breathe right.obj -o copd.pvd --frames 2 --scenario copd --curve curve.png --json
keeps breathe
expect "the curve's picture is no PNG" grep -q PNG curve.png
expect "the curve's table has not 502 lines" test "$(wc -l <curve.csv)" -eq 502
succeeds "a measured breath" breathe right.obj -o fit.pvd --frames 2 --fit curve.csv --curve fitted.png --json
keeps breathe
expect "the fit misses its own curve" grep -q '"rms_percent": 0' "$logs/out"
expect "the breath is not named as measured" grep -q '"scenario": "Measured breath"' "$logs/out"
expect "the fitted volume is another" awk -F, '
  FNR == 2 { least[FILENAME] = most[FILENAME] = $4 }
  FNR > 1 { if ($4 < least[FILENAME]) least[FILENAME] = $4; if ($4 > most[FILENAME]) most[FILENAME] = $4 }
  END { d = (most["curve.csv"] - least["curve.csv"]) / (most["fitted.csv"] - least["fitted.csv"]); exit d > 0.98 && d < 1.02 ? 0 : 1 }' curve.csv fitted.csv
head -n 20 curve.csv >short.csv
cut -d, -f1,4 curve.csv >volumes.csv
sed 's/^0.04,/0.03,/' curve.csv >back.csv
sed '7s/,.*,.*,.*/,x,0,0/' curve.csv >word.csv
sed '100,180d' curve.csv >gap.csv
sed '7s/.*/0.05,nan,0,0/' curve.csv >nan.csv
awk -F, -v OFS=, 'NR > 1 { $2 = -$2 } 1' curve.csv >oesophagus.csv
refuses "a breath of 19 rows" 4 'short.csv. has 19 rows' breathe parts -o none.pvd --fit short.csv
refuses "times that go back" 4 'back.csv., line 7: the time' breathe parts -o none.pvd --fit back.csv
refuses "a pressure that is a word" 4 'word.csv., line 7, column pressure' breathe parts -o none.pvd --fit word.csv
refuses "a pressure that is none" 4 'nan.csv., line 7, column pressure' breathe parts -o none.pvd --fit nan.csv
refuses "a breath with a gap" 4 'gap.csv., line 100: .*missing' breathe parts -o none.pvd --fit gap.csv
refuses "pressures of the oesophagus" 4 'line [0-9]+: .*negative' breathe parts -o none.pvd --fit oesophagus.csv
refuses "a breath without pressures" 4 'no column .pressure_cmh2o' breathe parts -o none.pvd --fit volumes.csv
refuses "a breath that is not there" 3 'gone.csv' breathe parts -o none.pvd --fit gone.csv
refuses "a measured breath of another volume" 2 'leave --tidal' breathe parts -o none.pvd --fit curve.csv --tidal 700
refuses "a curve that is no picture" 5 'png' breathe parts -o none.pvd --curve curve.svg
refuses "a curve in the place of the frames' table" 2 'name the picture otherwise' breathe parts -o none.pvd --curve none.png
succeeds "on the back" breathe right.obj -o supine.pvd --frames 2
prints 'landmarks of people .supine.; typical error'
succeeds "prone" breathe right.obj -o prone.pvd --frames 2 --posture prone --json
keeps breathe
prints 'between supine and prone: reasoned, not measured'
expect "prone is as supine" test "$(cksum < prone_0001.vtp)" != "$(cksum < supine_0001.vtp)"
for model in published continuous; do
  succeeds "the $model model" breathe right.obj -o "$model.pvd" --frames 2 --model "$model" --posture upright
  prints 'of Santhanam 2008.*reasoned, not measured'
done
refuses "constants for a model without any" 2 'Leave one of the two out' breathe right.obj -o none.pvd --model continuous --motion deep
refuses "a posture that is none" 2 'posture.*supine' breathe right.obj -o none.pvd --posture standing
succeeds "a lobe with emphysema" breathe parts -o soft.pvd --frames 2 --emphysema lll --json
keeps breathe
prints '"lobe": "LLL"'
expect "the left lung takes no more of the breath than by its volume" awk '/"least_ml"/ { least = $2 + 0 } /"most_ml"/ { gain[n++] = $2 - least } END { exit gain[1] > 1.05 * gain[0] ? 0 : 1 }' "$logs/out"
succeeds "a pneumothorax" breathe parts tree.vtp -o air.pvd --frames 2 --scenario pneumothorax --json
keeps breathe
expect "the air around the lung is not told" grep -q '"gap_ml": [1-9][0-9][0-9]' "$logs/out"
expect "there is no chest wall" test -s air_chest_wall_0001.vtp
expect "the collection does not name the chest wall" grep -q 'part="2" file="air_chest_wall_0001.vtp"' air.pvd
expect "the air does not keep its volume" awk -F, '
  NR == 1 { for (i = 1; i <= NF; i++) if ($i == "pleural_gap_ml") c = i; next }
  NR == 2 { gap = $c }
  { if ($c < 100 || $c - gap > 1e-3 || gap - $c > 1e-3) exit 1 }' air.csv
refuses "an onion skin without pictures" 2 'onion-skin requires --pictures' breathe parts -o none.pvd --onion-skin
refuses "a region without a factor" 2 'says no stiffness' breathe parts -o none.pvd --stiffness LLL
refuses "a region that is none" 2 'neither a lobe .* nor a ball' breathe parts -o none.pvd --stiffness 1,2,3=5
refuses "a region too stiff" 2 '0.01 to 100' breathe parts -o none.pvd --stiffness LLL=1000
refuses "a ball beside the lungs" 2 'is in no lung' breathe parts -o none.pvd --stiffness 0,0,900,10=5
refuses "emphysema of no lobe" 2 'knows RUL.*spleen' breathe parts -o none.pvd --emphysema spleen
refuses "a lobe of a whole lung" 2 'no left lower lobe' breathe right.obj -o none.pvd --emphysema LLL
refuses "a file that is there" 6 'exists' breathe lobes -o breath.pvd
refuses "another format" 5 'end in .pvd' breathe parts -o breath.vtp
refuses "no frames" 2 'frames must lie in .1' breathe parts -o none.pvd --frames 0
refuses "a scenario that is none" 2 'scenario.*quiet' breathe parts -o none.pvd --scenario copdd
refuses "lobes that are not there" 3 'no .*gone' breathe gone -o none.pvd
refuses "a tree and no lung" 4 'no lung' breathe tree.vtp -o none.pvd
refuses "half a lung" 4 'RML|RLL|missing' breathe chest/rul.stl -o none.pvd
mkdir small
for lobe in rul rml rll; do "$PNEUMA" export "chest/$lobe.stl" -o "small/$lobe.stl" --units m -q 2>/dev/null; done
refuses "metres" 4 'mm' breathe small -o none.pvd
finish
