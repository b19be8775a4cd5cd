#!/usr/bin/env bash
# A cohort on one machine: three cases that are done, two that fail for reasons of their own; mended, the rest is done;
# killed in the middle, it goes on where it was. What it leaves knows nothing of the person of the CTs (person.cpp).
. "$(dirname "$0")/../cli/lib.sh"
. "$(dirname "$0")/lib.sh"

for seed in 1 2; do
  succeeds "sample $seed" sample "made $seed" --cell 6 --ct --spacing 4 --thick 5 --seed "$seed" -q
  mv "made $seed/dicom" "Ünal $seed"
  "$PERSON" plant "Ünal $seed" >/dev/null || fail "the person was not planted"
done
cp -r 'Ünal 1' cut && head -c 5000 cut/slice-0020.dcm >cut/x && mv cut/x cut/slice-0020.dcm
cp -r 'Ünal 1' gaps && rm gaps/slice-00{20..29}.dcm
cp -r 'Ünal 2' going
printf '{"schema":"pneuma/recipe/1","lobes":{},"airways":{"method":"centroid","terminals":200}}\n' >recipe.json
cat >cases.csv <<'CASES'
case,ct,group
first,Ünal 1,"a, b"
Ünal zwei,Ünal 2,
cut,cut,c
gaps,gaps,c
gone,going,c
CASES
succeeds "init" cohort init study --cases cases.csv --recipe recipe.json -q
sed -i -e 's/ --frames 8/ --frames 2/' -e 's/480x360/160x120/' study/config.yaml
mv going went # after init

caseName="first run"
flow local --cores 2
expect "it does not end with 1 but $code" test "$code" -eq 1
for name in first 'Ünal zwei'; do
  says "$name" status '^done$'
  says "$name" centroid_terminals '^[12][0-9][0-9]$'
  says "$name" right_lung_ml '^3[0-9]{3}\.'
done
says first group '^a, b$'
for name in cut gaps gone; do says "$name" status '^failed$'; done
says cut stage '^info$'
says cut exit_code '^4$'
says cut reason "^'\.\.\.' "
expect "the log does not name the file" grep -q slice-0020.dcm study/logs/cut/info.log
says gone exit_code '^3$'
says gone reason 'there is no file .the CT.'
says gone stage '^info$'
says gaps exit_code '^4$'
says gaps stage '^import$'
says gaps reason 'slices? (is|are) missing'
expect "what failed left files" test -z "$(find study/cases/{cut,gone} -type f)"
expect "the page does not count" grep -q '2 done.*3 failed' study/index.html
expect "something is half written" test -z "$(find study -name '*.part')"
caseName="the person of the CTs"
expect "it is found: $("$PERSON" find study 2>/dev/null | head -n 3)" "$PERSON" find study
caseName="HDF5"
expect "it is not as the CSV" "$python" - study <<'PYTHON'
import csv, sys, h5py
rows = list(csv.DictReader(open("study/table.csv", encoding="utf-8")))
with h5py.File("study/table.h5") as file:
    table = file["table"]
    assert list(table.attrs["columns"]) == list(rows[0])
    for column in rows[0]:
        for row, value in zip(rows, table[column.replace("/", "|")][()]):
            if isinstance(value, bytes):
                assert value.decode() == row[column], (column, value)
            else:
                assert (value != value and row[column] == "") or float(row[column]) == value, (column, value)
    assert file["orders/centroid/first"][0] > 100
PYTHON

caseName="mended"
mv went going && cp 'Ünal 1/slice-0020.dcm' cut/
flow local --cores 2
expect "it does not end with 1 but $code" test "$code" -eq 1
expect "$(ran segment) lungs were found, not 2" test "$(ran segment)" -eq 2
says cut status '^done$'
says gone status '^done$'
says gaps status '^failed$'
results first.sums
expect "the mended case differs from what it was copied of" cmp study/cases/{first,cut}/trees/centroid.vtp

caseName="nothing left to do but the case that cannot be"
flow local --cores 2
expect "$(grep -c '^rule' "$logs/flow") jobs ran, not 1" test "$(grep -c '^rule' "$logs/flow")" -eq 1

caseName="killed in the middle"
rm -r study/{cases,logs,benchmarks,.snakemake} gaps && cp -r 'Ünal 2' gaps
(cd study && PATH=/usr/bin:$PATH exec setsid snakemake --profile profiles/local --cores 2) >"$logs/killed" 2>&1 </dev/null &
head=$!
for _ in $(seq 3000); do
  [ "$(grep -c '^Finished job' "$logs/killed")" -ge 8 ] && break
  sleep 0.1
done
for _ in $(seq 3000); do
  kill -STOP -- "-$head"
  [ -n "$(grep -L '"exit"' study/logs/*/*.exit)" ] && break # something has started, and not ended
  kill -CONT -- "-$head"
  sleep 0.05
done
kill -9 -- "-$head"
wait "$head" 2>/dev/null
finished=$(grep -c '^Finished job' "$logs/killed")
expect "it was not running" test "$finished" -ge 8 -a "$finished" -lt 45
(cd study && PATH=/usr/bin:$PATH snakemake --unlock) >"$logs/flow" 2>&1
flow local table
expect "the table does not tell that something was running: $(cut -d, -f1-8 study/table.csv)" \
  grep -q 'not finished,.*no end was told of what started at 20' study/table.csv
flow local --cores 2
expect "it ends with $code" test "$code" -eq 0
again=$(grep -c '^rule' "$logs/flow")
# Five cases of ten jobs.
expect "$finished jobs and $again after it: something was done twice" test $((finished + again)) -le 50
results second.sums
expect "results differ: $(diff <(grep -v ' ./gaps/' first.sums) <(grep -v ' ./gaps/' second.sums) | head -n 3)" \
  cmp <(grep -v ' ./gaps/' first.sums) <(grep -v ' ./gaps/' second.sums)
finish
