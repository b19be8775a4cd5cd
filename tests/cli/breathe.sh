#!/usr/bin/env bash
# Lungs that breathe: lobes of the sample chest with a tree grown in them, every scenario, bad input.
# Needs JSON_CHECK (json_check) and SCHEMAS (resources/schemas).
. "$(dirname "$0")/lib.sh"

keeps() { expect "the JSON breaks $1: $("$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$logs/out" 2>&1 | head -n 3)" \
  "$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$logs/out"; }
# column NAME FILE: a column of a table without its head.
column() { awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) c = i; next } { print $c }' "$2"; }

succeeds "a chest" sample chest --cell 5mm -q
succeeds "its lobes, which share their triangles" lobes chest -o lobes -q
succeeds "a tree in it" grow lobes --central chest/central.vtp --method centroid --terminals 500 -o tree.vtp -q
succeeds "quiet breathing" breathe lobes tree.vtp -o breath.pvd --frames 8 --json
keeps breathe
for file in breath.pvd breath.csv breath.json breath.vtp.series breath_0000.vtp breath_0007.vtp breath_tree_0000.vtp breath_tree_0007.vtp; do
  expect "$file is not there" test -s "$file"
done
expect "there are not eight frames" test "$(find . -name 'breath_0*.vtp' | wc -l)" -eq 8
expect "the collection does not end with the first frame" grep -q 'timestep="5" group="" part="0" file="breath_0000.vtp"' breath.pvd
expect "the series does not name the frames" test "$(grep -c '"name"' breath.vtp.series)" -eq 9
expect "the table has not eight rows" test "$(column volume_ml breath.csv | wc -l)" -eq 8
expect "the volume does not go up and down by half a litre" awk -F, '
  NR == 2 { least = $6; most = $6 }
  NR > 1 { if ($6 < least) least = $6; if ($6 > most) most = $6 }
  END { exit most - least > 440 && most - least < 510 ? 0 : 1 }' breath.csv
succeeds "a frame is a healthy surface" info breath_0003.vtp
succeeds "a frame of the airways" info breath_tree_0003.vtp
prints 'branches'
succeeds "again" breathe lobes tree.vtp -o again.pvd --frames 8 --threads 1 -q
for n in 0 3; do
  expect "frame $n depends on the number of threads" cmp "breath_000$n.vtp" "again_000$n.vtp"
done
for scenario in vital-capacity pneumothorax; do
  succeeds "$scenario" breathe lobes -o "$scenario.pvd" --frames 2 --scenario "$scenario" -q
done
succeeds "a volume and a period of its own" breathe lobes -o own.pvd --frames 4 --tidal 800ml --period 4s
prints '800 ml in 4.0 s'
succeeds "one lung" breathe lobes/rul.vtp lobes/rml.vtp lobes/rll.vtp -o right.pvd --frames 2
prints '^ *right '

refuses "a file that is there" 6 'exists' breathe lobes -o breath.pvd
refuses "another format" 5 'end in .pvd' breathe lobes -o breath.vtp
refuses "no frames" 2 'frames must lie in .1' breathe lobes -o none.pvd --frames 0
refuses "a scenario that is none" 2 'scenario.*quiet' breathe lobes -o none.pvd --scenario copdd
refuses "lobes that are not there" 3 'no .*gone' breathe gone -o none.pvd
refuses "a tree and no lung" 4 'no lung' breathe tree.vtp -o none.pvd
refuses "half a lung" 4 'RML|RLL|missing' breathe chest/rul.stl -o none.pvd
mkdir small
for lobe in rul rml rll; do "$PNEUMA" export "chest/$lobe.stl" -o "small/$lobe.stl" --units m -q 2>/dev/null; done
refuses "metres" 4 'mm' breathe small -o none.pvd
finish
