#!/usr/bin/env bash
# Everything that may go wrong with what a person opens, grows in or saves: the window says it in a card, and what
# was there before stays. Makes the bad files, then plays errors.json.
# Needs PNEUMA, DESKTOP (pneuma-desktop), MAKE_DICOM, CT (a folder of slices), a display, and OUT for its pictures.
: "${DESKTOP:?}" "${MAKE_DICOM:?}" "${CT:?}" "${OUT:?}"
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../cli/lib.sh"
rm -rf "$OUT"
export FOLDER=$workFolder CT
stop() {
  echo "FAILED: $1"
  exit 1
}

# Surfaces.
ball 60 >ball.obj
printf 'solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n' >cut.stl
head -c 20000 /dev/zero | tr '\0' 'x' >garbage.stl
printf 'just some text\n' >letter.txt
sed '$d' ball.obj >open.obj
ball 0.06 >metres.obj
mkdir empty
fiveBalls lobes
fiveBalls twice
cp twice/rul.obj twice/case_RUL.obj
# Trees.
printf '{ "schema": "pneuma/tree/1", "branches": [ ' >cut.json
printf '1 2 3000 3000 3000 5 -1\n2 2 3000 3000 2900 5 1\n' >elsewhere.swc
# Projects.
"$PNEUMA" grow ball.obj --method centroid --terminals 100 -o small.vtp -q || stop "no tree"
cp "$here/../data/project_version_1.pneuma" old.pneuma
head -c 15000 old.pneuma >damaged.pneuma
printf 'not a zip\n' >nozip.pneuma
mkdir raw && (cd raw && cmake -E tar xf ../old.pneuma)
sed -E 's#pneuma/project/[0-9]+#pneuma/project/99#' raw/project.json >raw/p && mv raw/p raw/project.json
grep -q 'pneuma/project/99' raw/project.json || stop "the project has no version"
(cd raw && cmake -E tar cf ../newer.pneuma --format=zip project.json)
# CTs.
"$MAKE_DICOM" gap gap && "$MAKE_DICOM" tilt tilt && "$MAKE_DICOM" mr mr && "$MAKE_DICOM" head head || stop "no CT"
mkdir papers && cp letter.txt papers/
"$PNEUMA" import "$CT" -o ct.nii -q || stop "no volume"
head -c 3000 ct.nii >cut.nii
cp -r "$CT" scan
"$PNEUMA" run --ct scan --up-to lungs -o linked.pneuma -q || stop "no project"
"$PNEUMA" export linked.pneuma --preset segmentation -o labels -q || stop "no labels"
mv labels/labels.nii.gz . && mv scan elsewhere
# Fissures, constants and breaths.
printf '{"schema": "pneuma/fissures/1", "fissures": [' >fissures.json
printf '{"schema": "nothing"}' >constants.json
printf 'a,b\n1,2\n' >breath.csv

"$DESKTOP" --play "$here/errors.json" --screenshots "$OUT" || stop "the window"

# A full disk, as a limit on the size of files, which every user can set: what was saved before stays.
cat >full.json <<'END'
[{"do": "scenario", "name": "error: the disk is full while a project is saved"},
 {"do": "trigger", "name": "actionSample"}, {"do": "wait"},
 {"do": "trigger", "name": "actionSaveProject"},
 {"do": "set", "name": "fileNameEdit", "value": "${FOLDER}/full.pneuma"},
 {"do": "key", "name": "fileNameEdit", "keys": "Return"}, {"do": "wait"},
 {"do": "expect", "name": "errorTitle", "equals": "Saving the project"},
 {"do": "expect", "name": "errorSentence", "contains": "full.pneuma"},
 {"do": "expect", "state": "modified", "equals": false},
 {"do": "expect", "state": "surfaces", "equals": 5},
 {"do": "screenshot", "file": "40_full_disk"}]
END
(ulimit -f 1000 && exec "$DESKTOP" --play full.json --screenshots "$OUT") || stop "a full disk"
[ -e full.pneuma ] && stop "half a project was left"
ls -A | grep -q '\.part$' && stop "something was left"
echo "done"
