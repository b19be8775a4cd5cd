#!/usr/bin/env bash
# Nothing that a command writes, prints or leaves knows the person of the CT; the person's folder is named where a file
# has to be found again, and nowhere else. Needs PERSON (person.cpp).
. "$(dirname "$0")/../cli/lib.sh"
: "${PERSON:?puts a person into DICOM files and looks for it}"

succeeds "a chest" sample "PLANTED folder" --ct --spacing 3 -q
rm "PLANTED folder"/*.*
ct="../PLANTED folder/dicom"
"$PERSON" plant "${ct#../}" >/dev/null || fail "the person was not planted"
(cd "PLANTED folder" && cmake -E tar cf ct.zip --format=zip dicom) || fail "no zip"
mkdir out home state
export HOME=$PWD/home XDG_CONFIG_HOME=$PWD/home/.config XDG_STATE_HOME=$PWD/state TMPDIR=$PWD/state
cd out || exit 1

# does NAME CODE COMMAND...: what it prints is kept, to be looked through.
does() {
  ends "$@"
  cat "$logs/out" "$logs/err" >>"printed.$printed"
}
printed=person # what names the person's folder, as it was typed
does "what a CT is worth" 0 info "$ct"
does "the same for programs" 0 info "$ct" --json
does "a CT that is not there" 3 info "$ct/missing"
does "what a zip of it is worth" 0 info "../PLANTED folder/ct.zip" --json
printed=not
does "a zip of it" 0 import "../PLANTED folder/ct.zip" -o zipped.nrrd
does "a volume" 0 import "$ct" -o volume.nii.gz
does "a volume with its text" 0 import "$ct" -o volume.nrrd
does "lungs" 0 segment "$ct" -o labels.nii.gz --surfaces lungs --central central.vtp --report segment.json -v
does "lobes" 0 lobes lungs --ct "$ct" -o lobes
does "a tree" 0 grow lobes --central central.vtp --terminals 300 -o tree.vtp --report tree.json
does "a breath" 0 breathe lobes tree.vtp -o breath.pvd --frames 2
does "slices" 0 render "$ct" --labels labels.nii.gz --slice axial -o slices.png
does "a case" 0 run --ct "$ct" -o case -v --progress json
does "a project" 0 run --ct "$ct" -o case.pneuma
does "a project with its CT" 0 run --ct "$ct" -o packed.pneuma --pack-ct
# A series that is chosen by its UID is kept by a name that does not tell it.
uid=$("$PNEUMA" info "$ct" --phi --json | sed -n 's/.*"SeriesInstanceUID": "\([^"]*\)".*/\1/p')
expect "the series has no UID" test -n "$uid"
echo "{\"schema\": \"pneuma/recipe/1\", \"open\": {\"series\": \"$uid\"}, \"lungs\": {}}" >../chosen.json
does "a series that is chosen" 0 run ../chosen.json --ct "$ct" -o chosen.pneuma
printed=person
does "the same, told" 0 run ../chosen.json --ct "$ct" -o chosen.told --json
printed=not
does "its recipe" 0 export chosen.pneuma --preset recipe -o chosen
for preset in paraview print segmentation tree recipe; do does "$preset" 0 export case.pneuma --preset "$preset" -o "$preset"; done
does "a plan of a cohort" 0 cohort init cohort --cases "../PLANTED folder" --progress none
does "a report" 0 report case.pneuma -o report.json
does "figures" 0 measure tree.vtp --domain lobes --json
does "an output that is there" 6 segment "$ct" -o labels.nii.gz
does "no DICOM of nobody" 0 anonymize "$ct" -o anonymous --key "a long secret"
cd .. || exit 1

# The person's folder, and nothing else of the person, is in these: what finds the CT again, and reports beside results.
cat >expected <<'END'
out/case.pneuma:project.json: PLANTED
out/case/lungs.json: PLANTED
out/chosen.pneuma:project.json: PLANTED
out/chosen.told/lungs.json: PLANTED
out/chosen/recipe.json: PLANTED
out/cohort/README.md: PLANTED
out/cohort/cases.json: PLANTED
out/lobes/lobes.json: PLANTED
out/packed.pneuma:project.json: PLANTED
out/printed.person: PLANTED
out/recipe/recipe.json: PLANTED
out/segment.json: PLANTED
END
mkdir all && mv out home state all/
caseName="who is found"
"$PERSON" find all >found 2>"$logs/err"
cases=$((cases + 1))
diff <(sort expected) <(sort found) >"$logs/out" || fail "the person is found elsewhere"
caseName="what is found"
sed -i 's/PLANTED folder//g' all/out/printed.person all/out/*.json all/out/*/*.json all/out/cohort/README.md
"$PERSON" find all >found 2>"$logs/err"
grep -v '\.pneuma:' found >"$logs/out"
cases=$((cases + 1))
[ ! -s "$logs/out" ] || fail "more than the folder is found"
mkdir project && (cd project && cmake -E tar xf ../all/out/chosen.pneuma)
expect "the project was not opened" test -s project/project.json
expect "the project holds a UID" eval '! grep -rq "2\.25\.77777" project'
expect "the look does not see what is there" test "$("$PERSON" find "PLANTED folder" | wc -l)" -gt 100
finish
