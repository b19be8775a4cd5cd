#!/usr/bin/env bash
# What users do: every command once, its result in text and as JSON that keeps its schema.
# Needs JSON_CHECK (json_check) and SCHEMAS (resources/schemas).
. "$(dirname "$0")/lib.sh"

# keeps SCHEMA: what was printed last is as the schema says.
keeps() { expect "the JSON breaks $1: $("$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$logs/out" 2>&1 | head -n 3)" \
  "$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$logs/out"; }

succeeds "help" help
prints '^  reproduce +Repeat'
for command in run cohort segment lobes fissures check grow breathe estimate study outline measure compare info import repair anonymize render regress export sample thumbnail reproduce doctor completion help version; do
  succeeds "help $command" help "$command"
  prints "^Usage: pneuma $command"
  cp "$logs/out" page
  succeeds "$command --help" "$command" --help
  expect "help $command and $command --help differ" cmp page "$logs/out"
done
succeeds "help grow tells the options of a method" help grow
prints '^  ratio=0.41 \(0.05 to 1\)'
succeeds "version" --version
prints '^pneuma [0-9]+\.[0-9]+\.[0-9]+'
succeeds "version as JSON" version --json
prints '"commit"'
succeeds "doctor" doctor
prints 'ok +self-test: [0-9,]+ terminals grown in .* 0 outside'

succeeds "sample" sample chest --cell 4mm
expect "the truth does not tell of three fissures" test "$(grep -c side_bend_per_mm chest/truth.json)" -eq 3
expect "there are not five lobes" test "$(find chest -name '???.stl' | wc -l)" -eq 5
expect "there are no points upon the fissures" grep -q '"left-oblique"' chest/fissures.json
cp chest/truth.json "$logs/out"
keeps sample
succeeds "sample as a CT" sample scan --cell 6mm --ct --spacing 4mm --thick 6mm --tilt 10deg --gaps 2 --seed 3
prints '^ct.nii.gz, labels.nii.gz, dicom: 102 x 102 x 63 voxels of 4.00 x 4.00 x 6.00 mm, right lung 3[23][0-9]{2}'
prints '^missing in dicom: 2 slices'
cp scan/truth.json "$logs/out"
keeps sample
expect "there are not 61 slices" test "$(find scan/dicom -name '*.dcm' | wc -l)" -eq 61
succeeds "the same sample again" sample again --cell 6mm --ct --spacing 4mm --thick 6mm --tilt 10deg --gaps 2 --seed 3 -j 1
expect "the same seed gives other files" diff -r scan again
succeeds "a mirrored sample" sample mirror --cell 6mm --ct --spacing 5 --thick 10 --mirror --json
keeps sample
succeeds "info of a folder" info chest
prints 'rul.stl: STL surface, right upper lobe'
prints 'central.vtp: VTP tree'
succeeds "info as JSON" info chest --json
keeps info
succeeds "repair of what is sound" repair chest/rul.stl -o mended.ply --json
keeps repair

succeeds "grow" grow chest --central chest/central.vtp --method centroid --terminals 4000 -o tree.vtp --report r.json
prints '^tree.vtp: [0-9,]+ branches, [0-9,]+ terminals, grown by centroid, seed 1'
prints '^outside their lobe: 0 ends, 0 branches'
cp r.json "$logs/out"
keeps growth
expect "terminals are not about 4000" awk '/"terminals"/ { gsub(/[^0-9]/, ""); ok = $0 > 3880 && $0 < 4120; exit !ok }' r.json
succeeds "grow without central airways, JSON" grow chest --terminals 2000 -o t.swc --json
keeps growth
succeeds "grow in an organ" grow --organ right-lung --method centroid --points 5000 -o organ.json --json
keeps growth
succeeds "grow in the thorax" grow --organ thorax --set flow-threshold=0.001 -o thorax.vtp
prints 'outside their lobe: 0 ends, 0 branches'
succeeds "grow in the thorax with a table of one's own" grow --organ thorax --set flow-threshold=0.001 \
  --airway-table "$(dirname "$0")/../../resources/airways/thorax-tuned.json" -o tuned.vtp
succeeds "grow by aggregation" grow chest --central chest/central.vtp --method dla --set particles=20000 -o dla.vtp --points particles.vtp
prints 'grown by dla, seed 1'
prints '^outside their lobe: 0 ends, 0 branches'
expect "the particles have no order of arrival" grep -q 'Name="arrival"' particles.vtp
expect "there are not 20000 particles" grep -q 'NumberOfPoints="20000"' particles.vtp
succeeds "grow by aggregation, JSON" grow chest --method dla --terminals 500 -o dla.swc --json
keeps growth
succeeds "aggregate in the outline" outline --particles 3000 -o outline.vtp --picture outline.png --json
keeps outline
expect "the picture is not there" test -s outline.png
succeeds "aggregate in the outline, text" outline --particles 3000
prints '^3,000 particles of 3,000 walkers'
succeeds "reproduce Zhang's free clusters" reproduce zhang-2003 --table free
prints 'N against radius of gyration'
succeeds "reproduce Santhanam 2003" reproduce santhanam-2003 --json
keeps reproduce
succeeds "reproduce Santhanam 2008" reproduce santhanam-2008 --json
keeps reproduce
succeeds "its steps of volume" reproduce santhanam-2003 --table volume
prints '^1\.5 ml +volume missed'
succeeds "a quiet growth" grow chest --method centroid --points 3000 -o quiet.csv -q
expect "a quiet growth says something" test ! -s "$logs/out" -a ! -s "$logs/err"
succeeds "a talkative growth" grow chest --method centroid --points 3000 -o loud.csv -v
expect "it does not name its steps" grep -q "^pneuma: after .* s: growing" "$logs/err"
succeeds "progress as JSON lines" grow chest --terminals 30000 -o progress.vtp --progress json
expect "no line of progress" grep -Eq '^\{"progress":0\.[0-9]+,"step":"[a-z ]+"\}$' "$logs/err"

succeeds "measure" measure tree.vtp --domain chest
prints 'branching'
succeeds "measure as JSON" measure tree.vtp --domain chest --json
prints '"schema": "pneuma/measure/1"'
[ -f "$SCHEMAS/measure.schema.json" ] && keeps measure
succeeds "measure as CSV" measure organ.json --organ right-lung --csv
prints '^region,quantity,value'
succeeds "measure into a file" measure t.swc -o figures.txt
expect "the figures are not in the file" test -s figures.txt
succeeds "info of a tree" info tree.vtp --json
keeps info

for format in stl ply obj vtp; do
  succeeds "export to $format" export chest/rul.stl -o "rul.$format"
  succeeds "info of $format" info "rul.$format"
  prints 'healthy'
done
for format in swc csv json vtp; do
  succeeds "export of a tree to $format" export tree.vtp -o "copy.$format"
  expect "$format came out empty" test -s "copy.$format"
done
expect "VTP does not come back equal" test "$("$PNEUMA" measure tree.vtp --csv | sha256sum)" = "$("$PNEUMA" measure copy.vtp --csv | sha256sum)"
expect "JSON does not come back equal" test "$("$PNEUMA" measure tree.vtp --csv | sha256sum)" = "$("$PNEUMA" measure copy.json --csv | sha256sum)"
succeeds "export of two lobes" export chest --only RUL,LLL -o two --format ply
expect "the two lobes are not there" test -s two/rul.ply -a -s two/lll.ply
succeeds "export of a part of a tree" export tree.vtp --only RUL -o upper.csv
expect "other lobes are left in" awk -F, '!/^#/ && NR > 1 && ($3 == 3 || $3 == 4) { exit 1 }' upper.csv
succeeds "export in metres" export chest/rul.stl --units m -o rul_m.stl
succeeds "info of metres" info rul_m.stl
prints 'metres|in m|units, guessed +m$'
succeeds "export in RAS" export chest/rul.stl --frame ras -o rul_ras.vtp
succeeds "info of RAS" info rul_ras.vtp
prints 'frame RAS'

succeeds "reproduce" reproduce huang-2004
prints '^0\.41 +terminals'
succeeds "reproduce as JSON" reproduce huang-2004 --json
keeps reproduce
succeeds "a table of a paper" reproduce kitaoka-1999 --table 5
prints '^2\.8 +N +55627 +5[56][0-9]{3} '
prints '^V_r rises +order +1 +1 '
expect "there are other tables" test "$(grep -c '^Table' "$logs/out")" -eq 1
succeeds "a table of a paper as JSON" reproduce kitaoka-1999 --table 5 --json
keeps reproduce
finish
