#!/usr/bin/env bash
# Trees side by side: as text, JSON and CSV, in lobes and without; what is no tree; labels.
# Needs JSON_CHECK (json_check) and SCHEMAS (resources/schemas).
. "$(dirname "$0")/lib.sh"

fiveBalls lobes
mkdir a b
succeeds "a tree by Kitaoka's rules" grow lobes --terminals 1500 -o kitaoka.vtp
succeeds "a tree by centroid splitting" grow lobes --method centroid --terminals 1000 -o centroid.swc
cp kitaoka.vtp a/tree.vtp
cp centroid.swc b/tree.swc
"$PNEUMA" export kitaoka.vtp -o b/tree.vtp >/dev/null

succeeds "two trees" compare kitaoka.vtp centroid.swc
prints '^quantity +kitaoka +centroid +published +source$'
prints '^method +kitaoka +'
prints '^branching angle, deg +[0-9.]+ \+- [0-9.]+ +[0-9.]+ \+- [0-9.]+ +37 to 43 +Horsfield'
expect "a gap was measured in nothing" test -z "$(grep gap "$logs/out")"
cp "$logs/out" two.txt
succeeds "two trees with one thread" compare kitaoka.vtp centroid.swc -j 1
expect "1 and 2 threads give different tables" cmp two.txt "$logs/out"
succeeds "trees in lobes" compare kitaoka.vtp centroid.swc kitaoka.vtp --domain lobes
prints '^quantity +kitaoka +centroid +kitaoka \(2\) '
prints '^gap to the nearest terminal, mean, spacings( +0\.[0-9]{3}){3} +0\.48 to 0\.55'
prints '^ends outside their lobe +0 +0 +0$'
succeeds "trees in an organ" compare kitaoka.vtp centroid.swc --organ simple -q
succeeds "as JSON" compare kitaoka.vtp centroid.swc --domain lobes --json
expect "the JSON breaks compare" "$JSON_CHECK" "$SCHEMAS/compare.schema.json" "$logs/out"
prints '"method": "kitaoka"'
succeeds "as CSV" compare kitaoka.vtp centroid.swc --csv -o figures.csv
expect "the figures are not in the file" grep -q '^region,quantity,"kitaoka","centroid",published_low,' figures.csv
expect "there is a result on standard output too" test ! -s "$logs/out"
for i in 1 2; do
  tree=$(echo kitaoka.vtp centroid.swc | cut -d ' ' -f "$i")
  "$PNEUMA" measure "$tree" --csv | grep ^all | cut -d , -f 1-3 >alone.csv
  grep ^all figures.csv | cut -d , -f "1,2,$((i + 2))" | grep -v ',$' >column.csv
  expect "the column of $tree is not what measure prints" cmp alone.csv column.csv
done

succeeds "equal stems" compare a/tree.vtp b/tree.vtp b/tree.swc
prints '^quantity +a/tree.vtp +b/tree.vtp +b/tree.swc +published'
succeeds "equal stems in two folders" compare a/tree.vtp b/tree.vtp --csv
prints '^region,quantity,"a/tree","b/tree",'
expect "the same tree has two columns" test -z "$(awk -F, 'NR > 1 && $3 != $4' "$logs/out")"
caseName="a tree that leaves the lobes"
cases=$((cases + 1))
ball 20 >small.obj
run compare kitaoka.vtp centroid.swc --domain small.obj -o outside.txt
[ "$code" -eq 0 ] || fail "exit code $code: its branches belong to no lobe here"
"$PNEUMA" grow lobes/rul.obj --terminals 200 -o rul.vtp -q
cp small.obj rul.obj
run compare rul.vtp kitaoka.vtp --domain rul.obj -o outside.txt --force
[ "$code" -eq 7 ] || fail "exit code $code, not 7"
grep -q '^check failed: OUTSIDE-ENDS of rul is ' "$logs/err" || fail "it does not say which tree failed"

refuses "one tree" 2 "FILES.*at least 2.*1" compare kitaoka.vtp
refuses "no tree" 2 "FILES.*required" compare
refuses "a tree that is missing" 3 "missing.vtp" compare kitaoka.vtp missing.vtp
refuses "a surface" 5 "rul.obj.*surface.*airway trees" compare kitaoka.vtp lobes/rul.obj
"$PNEUMA" export lobes/rul.obj -o rul_surface.vtp >/dev/null
refuses "a surface as VTP" 5 "rul_surface.vtp.*surface.*airway trees" compare rul_surface.vtp kitaoka.vtp
head -c 3000 kitaoka.vtp >cut.vtp
refuses "a tree that was cut off" 4 "cut.vtp" compare kitaoka.vtp cut.vtp
echo "no tree" >text.stl
refuses "a damaged surface" 4 "text.stl" compare text.stl kitaoka.vtp
echo "no tree" >text.txt
refuses "a file of another kind" 5 "text.txt.*airway tree" compare kitaoka.vtp text.txt
refuses "a folder" 3 "lobes" compare kitaoka.vtp lobes
refuses "CSV and JSON" 2 "csv.*json" compare kitaoka.vtp centroid.swc --csv --json
refuses "domain and organ" 2 "compare.*not both" compare kitaoka.vtp centroid.swc --organ simple --domain lobes
refuses "a size without an organ" 2 "organ-size is for" compare kitaoka.vtp centroid.swc --organ-size 5
refuses "an open surface to measure in" 4 "open.obj.*not fit to measure in" \
  compare kitaoka.vtp centroid.swc --domain "$(head -n 500 lobes/rul.obj >open.obj; echo open.obj)"
refuses "an output that exists" 6 "figures.csv.*exists.*--force" compare missing.vtp kitaoka.vtp -o figures.csv
refuses "a look without a picture" 2 "view.*picture" compare kitaoka.vtp centroid.swc --view left
refuses "a picture that is none" 5 "trees.jpg.*png" compare kitaoka.vtp centroid.swc --picture trees.jpg
refuses "picture and figures in one file" 2 "same file" compare kitaoka.vtp centroid.swc --picture x.png -o x.png
DISPLAY= refuses "a picture without a display" 10 "xvfb-run" compare kitaoka.vtp centroid.swc --picture trees.png
finish
