#!/usr/bin/env bash
# Outputs that cannot be written: exit 6 (5 for an unknown format) before the work, nothing left.
. "$(dirname "$0")/lib.sh"

ball 60 >ball.obj
: >file
echo old >there.vtp
echo old >there.json
mkdir folder.vtp

refuses "a folder that is not there" 6 "nowhere.*does not exist" grow ball.obj -o nowhere/tree.vtp
refuses "a file for a folder" 6 "file.*not a folder" grow ball.obj -o file/tree.vtp
refuses "a folder for a file" 6 "folder.vtp.*folder" grow ball.obj -o folder.vtp
refuses "a folder that takes no files" 6 "proc" grow ball.obj -o /proc/tree.vtp
refuses "an output that exists" 6 "there.vtp.*exists.*--force" grow ball.obj -o there.vtp
refuses "a report that exists" 6 "there.json.*exists.*--force" grow ball.obj -o tree.vtp --report there.json
refuses "report and tree in one file" 2 "same file" grow ball.obj -o tree.json --report tree.json
refuses "an unknown tree format" 5 "tree.stl.*vtp.*swc" grow ball.obj -o tree.stl
refuses "no extension" 5 "tree.*vtp" grow ball.obj -o tree
refuses "an unknown surface format" 5 "ball.swc.*stl" repair ball.obj -o ball.swc
refuses "an unknown picture format" 5 "ball.jpg.*png" render ball.obj -o ball.jpg
refuses "a picture that is there" 6 "there.png.*exists" render ball.obj -o "$(: >there.png; echo there.png)"
"$PNEUMA" export ball.obj -o same.stl -q
ln -s same.stl link.stl
"$PNEUMA" grow ball.obj --method centroid --terminals 200 -o same.swc -q
refuses "repair onto its input" 2 "same.stl.*same file" repair same.stl -o same.stl --force
refuses "repair onto its input by a link" 2 "link.stl.*same file" repair same.stl -o link.stl --force
refuses "export onto its input" 2 "same.stl.*same file" export same.stl -o same.stl --force
refuses "measure onto its input" 2 "same.swc.*same file" measure same.swc -o same.swc --force
refuses "compare onto an input" 2 "same.swc.*same file" compare same.swc same.swc -o same.swc --force
refuses "compare surfaces onto an input" 2 "same.stl.*same file" compare same.stl ball.obj -o same.stl --force
refuses "grow onto its airways" 2 "same.swc.*same file" grow ball.obj --central same.swc -o same.swc --force
"$PNEUMA" export ball.obj -o same.vtp -q
refuses "grow onto its surface" 2 "same.vtp.*same file" grow same.vtp -o same.vtp --force
refuses "repair onto a file" 6 "there.stl.*exists" repair ball.obj -o "$(: >there.stl; echo there.stl)"
refuses "export onto a file" 6 "there.stl.*exists" export ball.obj -o there.stl
refuses "measure onto a file" 6 "there.json.*exists" measure nothing.swc -o there.json
refuses "a sample into a file" 6 "file" sample file
refuses "a sample below no folder" 6 "nowhere.*does not exist" sample nowhere/chest
refuses "pictures into a file" 6 "file" reproduce huang-2004 --pictures file

mkdir chest
: >chest/lll.stl
refuses "a sample onto a file" 6 "lll.stl.*exists" sample chest
coarse=(--ct --cell 6 --spacing 5 --thick 10)
mkdir -p scan/dicom there
: >scan/dicom/other.dcm
: >there/dicom
refuses "a series onto slices" 6 "other.dcm.*exists.*--force" sample scan "${coarse[@]}"
refuses "a series beside other slices" 6 "other.dcm.*mix.*remove" sample scan "${coarse[@]}" --force
refuses "a series into a file" 6 "there/dicom.*folder" sample there "${coarse[@]}"
[ "$(cat there.vtp)" = old ] || { caseName="old files"; fail "an existing file was touched"; }

# The disk is full while the tree is written: as a limit on the size of files, which every user
# can set, and where it can be mounted as a small disk.
bigGrowth=(grow ball.obj --method centroid --points 20000)
PNEUMA_BINARY=$PNEUMA
limitedProgram=$logs/limited
printf '#!/bin/sh\nulimit -f 8\nexec "%s" "$@"\n' "$PNEUMA" >"$limitedProgram"
chmod +x "$limitedProgram"
PNEUMA=$limitedProgram
refuses "a file larger than allowed" 6 "tree.vtp" "${bigGrowth[@]}" -o tree.vtp
refuses "a report larger than allowed leaves no tree" 6 "tree.vtp|r.json" "${bigGrowth[@]}" -o tree.vtp --report r.json
refuses "a sample larger than allowed" 6 "lobes" sample lobes --cell 4mm
refuses "a CT larger than allowed" 6 "scanned" sample scanned --ct --cell 6 --spacing 5 --thick 10
PNEUMA=$PNEUMA_BINARY
mkdir small
if mount -t tmpfs -o size=64k none small 2>/dev/null; then
  refuses "a full disk" 6 "small.*full" "${bigGrowth[@]}" -o small/tree.vtp
  umount small
fi

# Standard output can be full as well.
caseName="standard output on a full device"
cases=$((cases + 1))
: >"$logs/out"
"$PNEUMA" version >/dev/full 2>"$logs/err"
code=$?
[ "$code" -eq 6 ] || fail "exit code $code, not 6"

# With --force it works, and the old file is whole or gone for the new one.
succeeds "replacing on request" grow ball.obj --method centroid --points 2000 -o there.vtp --report there.json --force
grep -q '<VTKFile' there.vtp || fail "the old file is still there"
if [ "$(id -u)" -ne 0 ]; then
  mkdir locked
  chmod a-w locked
  refuses "a read-only folder" 6 "locked.*read-only" grow ball.obj -o locked/tree.vtp
fi
finish
