#!/usr/bin/env bash
# Projects: made by a run, told about, taken apart, taken as input, refused when they are bad.
# Needs JSON_CHECK (json_check) and SCHEMAS (resources/schemas).
. "$(dirname "$0")/lib.sh"

keeps() { expect "the JSON breaks $1: $("$JSON_CHECK" "$SCHEMAS/$1.schema.json" "${2:-$logs/out}" 2>&1 | head -n 3)" \
  "$JSON_CHECK" "$SCHEMAS/$1.schema.json" "${2:-$logs/out}"; }

mkdir DOE_JANE
succeeds "a CT" sample DOE_JANE/chest --ct --spacing 3 --thick 5 -q
cat >recipe.json <<'END'
{"schema": "pneuma/recipe/1", "open": {"ct": "DOE_JANE/chest/ct.nii.gz"},
 "lungs": {"triangles": 6000}, "lobes": {"fissures": "DOE_JANE/chest/fissures.json", "smoothness": 0.5},
 "airways": {"method": "centroid", "terminals": 300}}
END
succeeds "a recipe into a project" run recipe.json -o case.pneuma --json
keeps run-report
succeeds "what is in it" info case.pneuma
prints 'Pneuma project of ct.nii.gz'
prints '^ +CT +.*DOE_JANE/chest/ct.nii.gz'
prints 'RUL, RML, RLL, LUL, LLL'
prints '^ +airways +[0-9]+ branches, grown by centroid'
succeeds "the same as JSON" info case.pneuma --json
keeps info
expect "the hash is not the file's" grep -q "$(sha256sum DOE_JANE/chest/ct.nii.gz | cut -c1-64)" "$logs/out"

# Any program opens it: it is a zip archive.
unpack() (mkdir "$2" && cd "$2" && cmake -E tar xf "../$1")
expect "it is no sound zip archive" unpack case.pneuma raw
keeps project raw/project.json
expect "the options of the lobes are not in it" grep -q '"smoothness": 0.5' raw/project.json
succeeds "a surface in it" info raw/surfaces/RUL.ply
prints 'healthy'
succeeds "labels in it" compare raw/labels/lungs-labels.nrrd raw/labels/lungs-labels.nrrd -q
expect "the folder's name is elsewhere than in the link" \
  test "$(grep -rl DOE_JANE raw | tr '\n' ' ')" = "raw/project.json "
expect "the folder's name is in more than the link" test "$(grep -c DOE_JANE raw/project.json)" -eq 2

succeeds "everything of it on a page" report case.pneuma -o case.json -q
keeps case case.json
expect "the report names the folder or the file" test "$(grep -c 'DOE_JANE\|ct.nii' case.json)" -eq 0
for part in '"region": "right middle lobe"' '"of": "lungs"' '"of": "lobes"' '"of": "airways"' 'Huang XY' 'voxels of 3.00 x 3.00 x 5.00'; do
  expect "the report lacks $part" grep -q "$part" case.json
done
succeeds "with names" report case.pneuma --identify -o named.json -q
expect "nothing is named" grep -q DOE_JANE named.json
refuses "a report of another kind" 5 "html" report case.pneuma -o case.txt
refuses "a report of nothing" 4 "nothing to report" report DOE_JANE/chest/ct.nii.gz -o none.json

succeeds "its parts" export case.pneuma -o parts --format stl -q
for file in rul.stl rml.stl rll.stl lul.stl lll.stl right.stl left.stl tree.vtp central.vtp labels.nii.gz \
  fissures.json; do
  expect "no parts/$file" test -s "parts/$file"
done
succeeds "for ParaView" export case.pneuma --preset paraview -o paraview
prints 'paraview/case.vtm'
for file in case.vtm rul.vtp right.vtp tree.vtp central.vtp fissures/right-oblique.vtp; do
  expect "no paraview/$file" test -s "paraview/$file"
done
expect "the collection names a file that is not there" \
  test -z "$(grep -o 'file="[^"]*"' paraview/case.vtm | cut -d'"' -f2 | (cd paraview && xargs ls 2>&1 >"$logs/none"))"
succeeds "in pieces for ParaView" export case.pneuma --preset paraview --largest-file 100K -o pieces
prints 'pieces/rul/rul_1.vtp'
expect "not all that was told is there: $(xargs ls <"$logs/out" 2>&1 >"$logs/none")" xargs ls <"$logs/out"
larger=$(find pieces -size +100k)
expect "larger files: $larger" test -z "$larger"
for piece in rul/rul_1.vtp fissures/right-oblique/right-oblique_1.vtp; do
  expect "the collection does not name $piece" grep -q "file=\"$piece\"" pieces/case.vtm
done
refuses "a folder in pieces" 5 "in pieces for ParaView" grow pieces --terminals 100 -o other.vtp
refuses "surfaces in pieces" 5 "in pieces for ParaView" info pieces
refuses "pieces over what is whole" 6 "rul.vtp' would stand beside this export" export case.pneuma --preset paraview --largest-file 100K -o paraview -f
refuses "what is whole over pieces" 6 "rul_0.vtp' would stand beside this export" export case.pneuma --preset paraview -o pieces -f
refuses "fewer pieces over more" 6 "_[1-9][0-9]*.vtp' would stand beside this export" export case.pneuma --preset paraview --largest-file 150K -o pieces -f
succeeds "the same pieces again" export case.pneuma --preset paraview --largest-file 100K -o pieces -f -q
refuses "pieces over others" 6 '--force' export case.pneuma --preset paraview --largest-file 100K -o pieces
refuses "pieces of nothing" 2 'largest-file is 64K or more' export case.pneuma --preset paraview --largest-file 1K -o other
refuses "pieces of no size" 2 "largest-file" export case.pneuma --preset paraview --largest-file much -o other
refuses "pieces for a printer" 2 'goes with --preset paraview' export case.pneuma --preset print --largest-file 1M -o other
refuses "pieces without a preset" 2 'goes with --preset paraview' export case.pneuma --largest-file 1M -o other
succeeds "for a printer" export case.pneuma --preset print -o print -q
expect "not five surfaces" test "$(ls print | tr '\n' ' ')" = "lll.stl lul.stl rll.stl rml.stl rul.stl "
expect "other surfaces" cmp print/rul.stl parts/rul.stl
succeeds "for another printer" export case.pneuma --preset print --as ply -o plies -q
expect "no plies/rul.ply" test -s plies/rul.ply
expect "both formats" test ! -e plies/rul.stl
succeeds "as labels of MetaImage" export case.pneuma --preset segmentation --as mha -o metas -q
refuses "labels as shapes" 2 "written as nii.gz, nrrd or mha, not as 'stl'" export case.pneuma --preset segmentation --as stl -o other
refuses "a tree in one format" 2 'leave out --as' export case.pneuma --preset tree --as swc -o other
refuses "a format without a preset" 2 'goes with --preset' export case.pneuma --as ply -o other
succeeds "as labels" export case.pneuma --preset segmentation -o labels -q
succeeds "the same voxels in both" compare metas/labels.mha labels/labels.nii.gz --min-dice 1
succeeds "labels have lobes" compare labels/labels.nii.gz labels/labels.nii.gz
prints "^RML +[1-9]"
succeeds "as a tree" export case.pneuma --preset tree -o tree4 -q
expect "not four files" test "$(ls tree4 | tr '\n' ' ')" = "tree.csv tree.json tree.swc tree.vtp "
succeeds "as a recipe" export case.pneuma --preset recipe -o recipe -q
succeeds "which runs" run recipe/recipe.json --dry-run -o other
refuses "no recipe of surfaces" 4 'no lungs that were found in a CT' export parts/rul.stl --preset recipe -o other
refuses "an animation without a breath" 4 "does not breathe.*step Breathing" export case.pneuma --preset share -o other
refuses "a view of a tree" 2 'is of a film' export case.pneuma --preset tree --view left -o other
refuses "a view without a preset" 2 'goes with --preset film' export case.pneuma --view left -o other
DISPLAY=:none refuses "a film without a display" 10 'no picture can be made' export case.pneuma --preset film -o other
DISPLAY=:none refuses "a view that is none" 2 "'lef'" export case.pneuma --preset film --view lef -o other
# The breath is made in the window; as it stands in the project.
breath='{"scenario":"quiet","tidal":0,"period":2,"frames":2,"motion":"scenario","affected":"left","posture":"supine","model":"preset","fit":null,"person":null,"regions":[]}'
sed "s/\"breath\": null/\"breath\": $breath/" raw/project.json >breathing.json
packAll() (cp -r raw breathing && cp breathing.json breathing/project.json && cd breathing && cmake -E tar cf ../breathing.pneuma --format=zip -- *)
expect "cannot pack it" packAll
DISPLAY=:none succeeds "an animation without a display" export breathing.pneuma --preset share -o share
prints 'share/breath.glb'
expect "the animation is no glTF" test "$(head -c 4 share/breath.glb)" = glTF
refuses "over an animation that is there" 6 '--force' export breathing.pneuma --preset share -o share
refuses "over files that are there" 6 '--force' export case.pneuma --preset tree -o tree4
succeeds "over them all the same" export case.pneuma --preset tree -o tree4 -f -q
refuses "no such preset" 2 "did you mean 'print'" export case.pneuma --preset prin -o other
refuses "a preset in a format" 2 'leave out --format' export case.pneuma --preset print --format ply -o other
refuses "nothing to label" 4 'no labels' export parts/rul.stl --preset segmentation -o other
refuses "no airways" 4 'no airways' export parts/rul.stl --preset tree -o other
refuses "a folder without a parent" 6 'folder' export case.pneuma --preset tree -o no/such
succeeds "one lobe" export case.pneuma --only RML -o rml.ply -q
expect "no rml.ply" test -s rml.ply
succeeds "its tree" export case.pneuma -o tree.swc -q
refuses "which surface" 2 'holds 7 things.*--only' export case.pneuma -o some.stl
succeeds "growth in its lobes" grow case.pneuma --method centroid --set terminals=100 -o tree.vtp -q
succeeds "its lobes again" lobes case.pneuma -o again -q
succeeds "breathing of it" breathe case.pneuma --frames 2 -o breath.pvd -q
refuses "with another input" 4 'opened alone' breathe case.pneuma rml.ply -o other.pvd
refuses "over one that is there" 6 '--force' run recipe.json -o case.pneuma
refuses "from the airways on" 2 '--from' run recipe.json -o other.pneuma --from airways
refuses "packed into a folder" 2 '--pack-ct' run recipe.json -o other --pack-ct
succeeds "over one that is there, all the same" run recipe.json -o case.pneuma --up-to lungs --pack-ct --force -q
expect "the one before was not kept" test -s case.pneuma~

# The CT may go away where it is packed, and is missed where it is not.
mv DOE_JANE gone
succeeds "with its CT packed" info case.pneuma
prints '^ +CT +packed in'
cp case.pneuma~ before.pneuma
succeeds "without its CT" info before.pneuma
prints '! The CT .ct.nii.gz. is not where it was'

head -c 2000 case.pneuma >cut.pneuma
refuses "cut off" 4 'damaged' info cut.pneuma
echo text >text.pneuma
refuses "no archive" 4 'damaged' info text.pneuma
refuses "absent" 3 'absent.pneuma' info absent.pneuma
sed -i 's#pneuma/project/1#pneuma/project/9#' raw/project.json
pack() (cd raw && cmake -E tar cf "../$1" --format=zip project.json)
expect "cannot pack" pack newer.pneuma
refuses "of a newer version" 5 'newer Pneuma.*update' info newer.pneuma

finish
