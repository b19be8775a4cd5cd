#!/usr/bin/env bash
# `pneuma cohort init`: what it writes, and what it refuses before anything starts.
. "$(dirname "$0")/../cli/lib.sh"

# keeps SCHEMA FILE: the file is as the schema says.
keeps() { expect "$2 breaks $1: $("$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$2" 2>&1 | head -n 3)" \
  "$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$2"; }

succeeds "sample" sample made --cell 6 --ct --spacing 5 --thick 10 -q
mkdir 'scans of all' && mv made/dicom 'scans of all/Müller' && cp made/ct.nii.gz 'scans of all/a.nii.gz'
echo x >'scans of all/notes.txt'
cat >recipe.json <<'RECIPE'
{ "schema": "pneuma/recipe/1", "lungs": { "threshold": -600 }, "lobes": {}, "airways": { "method": "centroid", "terminals": 300 } }
RECIPE
sed 's/centroid/weibel/' recipe.json >unknown.json

succeeds "a folder of scans" cohort init study --cases 'scans of all' --recipe recipe.json
prints '^study: workflow for 2 cases, trees by centroid$'
prints 'cd study && snakemake --profile profiles/local'
expect "what was passed over is not told" grep -q '1 of 3 entries of the folder hold no CT' "$logs/err"
keeps cohort study/cases.json
expect "cases have the names of their files" grep -q '"case": "case-002"' study/cases.json
expect "the recipe's threshold is lost" grep -q -- '--threshold=-600' study/cases.json
expect "the program is not named" grep -q '^pneuma: "/.*/pneuma"$' study/config.yaml
expect "there are hidden files" test -z "$(find study -name '.*')"
succeeds "the same as JSON, with names" cohort init named --cases 'scans of all' --names --json
keeps cohort-report "$logs/out"
expect "a case does not have its folder's name" grep -q '"case": "Müller"' named/cases.json

echo 'my: settings' >study/config.yaml
refuses "a workflow that is there" 6 "exists already.*--force" cohort init study --cases 'scans of all'
succeeds "writing it anew" cohort init study --cases 'scans of all' --force
prints '^kept as it was: config.yaml$'
expect "settings are lost" grep -q 'my: settings' study/config.yaml
bash -c "$(tail -n 2 named/README.md)" >"$logs/out" 2>"$logs/err"
caseName="the command in README.md"
expect "it does not work" grep -q '^named: workflow\|/named: workflow for 2 cases' "$logs/out"

printf 'name,file\na,b\n' >columns.csv
refuses "no column for CTs" 4 "columns.csv. has no column \"ct\"" cohort init new --cases columns.csv
printf 'case,ct\na,made/ct.nii.gz\nb,made/ct.nii.gz\na,made/ct.nii.gz\n' >twice.csv
refuses "a name twice" 4 "line 4 names its case 'a', as line 2 does" cohort init new --cases twice.csv
printf 'case,ct\na,made/ct.nii.gz\nb,/nowhere/Ünal 2\n' >missing.csv
refuses "a path that is not there" 3 "line 3 names '/nowhere/Ünal 2'" cohort init new --cases missing.csv
printf 'case,ct,fissures\na,made/ct.nii.gz,made/truth.json\n' >fissures.csv
refuses "fissures that are none" 4 "line 2 names a file that is no good: .*truth.json" cohort init new --cases fissures.csv
printf 'case,ct,recipe\na,made/ct.nii.gz,unknown.json\n' >recipes.csv
refuses "a method that is unknown, in a case's recipe" 2 "line 2 .*weibel" cohort init new --cases recipes.csv
printf 'case,ct\na,made/ct.nii.gz\n' >good.csv
refuses "a method that is unknown, in the recipe" 2 "weibel" cohort init new --cases good.csv --recipe unknown.json
printf 'case,ct\n"../a",made/ct.nii.gz\n' >outside.csv
refuses "a name that leads elsewhere" 4 "which is to become a folder" cohort init new --cases outside.csv
printf 'case,ct\nM\xfcller,made/ct.nii.gz\n' >latin.csv
refuses "a table in Latin-1" 4 "line 2 is not UTF-8" cohort init new --cases latin.csv
refuses "no table" 3 "nothing.csv" cohort init new --cases nothing.csv
refuses "a folder without CTs" 3 "holds no CTs" cohort init new --cases study
refuses "the folder of one case" 4 "holds the slices of CTs themselves" cohort init new --cases 'scans of all/Müller'
refuses "a parent that is not there" 6 "make its parent folder first" cohort init no/where --cases good.csv
refuses "another action" 2 "one action, init" cohort run new --cases good.csv
refuses "names of a table" 2 "names is for a folder" cohort init new --cases good.csv --names
if [ "$(id -u)" -ne 0 ]; then
  mkdir locked && chmod a-w locked
  refuses "a read-only place" 6 "locked" cohort init locked/new --cases good.csv
fi
refuses "a read-only disk" 6 "/proc/new" cohort init /proc/new --cases good.csv
finish
