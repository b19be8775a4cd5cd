#!/usr/bin/env bash
# Files that are not what they should be: one sentence, exit 3, 4 or 5, nothing written.
. "$(dirname "$0")/lib.sh"

ball 60 >ball.obj
: >empty.stl
printf 'solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n' >cut.stl
head -c 600 ball.obj | sed '$d' >cut.obj
head -c 20000 /dev/urandom >garbage.stl
head -c 20000 /dev/urandom >garbage.obj
head -c 20000 /dev/urandom >garbage.ply
head -c 20000 /dev/urandom >garbage.vtp
{ head -c 80 /dev/zero; printf '\377\377\377\377'; head -c 500 /dev/zero; } >huge.stl
printf 'ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n' >huge.ply
printf '<?xml version="1.0"?>\n<VTKFile type="PolyData" version="0.1"><PolyData><Piece NumberOfPoints="3"' >cut.vtp
printf 'just some text\n' >text.stl
printf 'just some text\n' >text.txt
cp ball.obj ball.xyz
sed '5s/.*/v nan 0 0/' ball.obj >nan.obj
sed '5s/.*/v inf 0 0/' ball.obj >infinite.obj
sed '$s/.*/f 1 2 99999/' ball.obj >index.obj
grep '^v' ball.obj >faceless.obj
: >empty.swc
printf '{ "schema": "pneuma/tree/1", "branches": [ ' >cut.json
head -c 5000 /dev/urandom >garbage.csv
head -c 5000 /dev/urandom >garbage.json
mkdir folder

for command in "info FILE" "grow FILE -o tree.vtp" "repair FILE -o mended.stl" "export FILE -o out.ply"; do
  verb=${command%% *}
  with() { read -ra arguments <<<"${command/FILE/$1}"; }
  with missing.stl
  refuses "$verb: a missing surface" 3 "missing.stl" "${arguments[@]}"
  for file in empty.stl cut.stl cut.obj garbage.stl garbage.obj garbage.ply huge.stl huge.ply text.stl nan.obj \
              infinite.obj index.obj faceless.obj; do
    with "$file"
    refuses "$verb: $file" 4 "$file" "${arguments[@]}"
  done
  with cut.vtp
  refuses "$verb: a VTP that was cut off" 4 "cut.vtp" "${arguments[@]}"
  with garbage.vtp
  refuses "$verb: garbage called VTP" 4 "garbage.vtp" "${arguments[@]}"
done
refuses "a file of another kind" '5' "text.txt" info text.txt
refuses "an empty folder" 3 "folder" info folder
refuses "an empty folder to grow in" 4 "folder.*rul" grow folder -o tree.vtp

for file in empty.swc cut.json garbage.csv garbage.json; do
  refuses "measure: $file" 4 "$file" measure "$file"
  refuses "central: $file" 4 "$file" grow ball.obj --central "$file" -o tree.vtp
done
refuses "measure: a missing tree" 3 "missing.vtp" measure missing.vtp
refuses "central: a missing tree" 3 "missing.vtu" grow ball.obj --central missing.vtu -o tree.vtp
refuses "a surface where a tree should be" '4' "ball.obj" measure ball.obj
finish
