#!/usr/bin/env bash
# Where files go: full and read-only disks, folders that vanish, links of every kind, devices. Disks are
# mounted in a namespace of its own; where the system allows none, they are left out, and it is said.
if [ "${1:-}" != mounted ] && unshare -rm mount -t tmpfs none /mnt 2>/dev/null; then
  exec unshare -rm bash "$(realpath "$0")" mounted
fi
. "$(dirname "$0")/lib.sh"
. "$here/inputs.sh"
mkdir disk
quick=(--method centroid --terminals 30)
(cd in/chest/dicom && cmake -E tar cf ../../chest.zip --format=zip -- *)

# each FUNCTION FOLDER: for commands that write one file, and several, into this folder.
each() {
  local line
  local -a arguments
  while read -r line; do
    [ "$full" -eq 1 ] || [[ $line =~ ^(grow|export.*share|run.*case\ -q|import) ]] || continue
    read -ra arguments <<<"${line//FOLDER/$2}"
    "$1" "${arguments[@]}"
  done <<'END'
grow in/ball.obj --method centroid --points 4000 -o FOLDER/tree.vtp --report FOLDER/report.json -q
segment in/chest/ct.nii.gz -o FOLDER/labels.nii.gz --surfaces FOLDER --central FOLDER/central.vtp -q
lobes in/chest -o FOLDER/lobes --spacing 10 -q
run in/recipe.json -o FOLDER/case.pneuma -q
run in/recipe.json -o FOLDER/case -q
export in/breathing.pneuma --preset paraview -o FOLDER/paraview -q
export in/breathing.pneuma --preset share -o FOLDER/share -q
breathe in/chest in/airways.vtp -o FOLDER/breath.pvd --frames 2 -q
sample FOLDER/chest --cell 6 -q
import in/chest/dicom -o FOLDER/ct.nrrd -q
anonymize in/chest/dicom -o FOLDER/dicom --key 12345678 -q
END
}
onFullDisk() {
  mkdir -p disk/case # a run makes its folder first, and leaves the stages that were done
  refuses "a full disk: $*" 6 "full|no space" "$@"
}
onReadOnlyDisk() { refuses "a read-only disk: $*" 6 "read-only" "$@"; }
intoNothing() {
  [[ $* == *nowhere/dicom* || $* == *nowhere/case\ -q ]] && return # these make all folders above
  refuses "no such folder: $*" 6 "does not exist|make its parent|no such" "$@"
}

if [ "${1:-}" = mounted ]; then
  mount -t tmpfs -o size=32k none disk
  each onFullDisk disk
  echo old >disk/tree.vtp
  echo old >disk/report.json
  refuses "a full disk with old files" 6 "full" grow in/ball.obj --method centroid --points 4000 \
    -o disk/tree.vtp --report disk/report.json -f
  [ "$(cat disk/tree.vtp disk/report.json)" = $'old\nold' ] || fail "an old file was touched"
  cat /dev/zero >disk/fills 2>/dev/null
  refuses "a disk without a byte" 6 "full" measure in/tree.swc -o disk/measures.json
  TMPDIR=$PWD/disk refuses "temporary files on a full disk" 6 "full|temporary" import in/chest.zip -o out/ct.nrrd
  umount disk
  # A run is done anew where no room is left: what it had left is there as before, and it can go on.
  mount -t tmpfs -o size=16m none disk
  made run in/recipe.json -o disk/case
  before=$(cd disk && find case -type f -print0 | sort -z | xargs -0 sha256sum)
  cat /dev/zero >disk/fills 2>/dev/null
  for stage in lungs lobes airways; do
    refuses "a full disk when a run is done anew from $stage" 6 "full" run in/recipe.json -o disk/case --from $stage -q
    [ "$before" = "$(cd disk && find case -type f -print0 | sort -z | xargs -0 sha256sum)" ] || fail "what was there has changed"
  done
  rm disk/fills
  succeeds "and then there is room" run in/recipe.json -o disk/case --from lungs -q
  umount disk
  mount -t tmpfs -o size=1m,nr_inodes=1 none disk
  refuses "a disk without a free name" 6 "full|no space" measure in/tree.swc -o disk/measures.json
  umount disk
  mount -t tmpfs -o ro none disk
  each onReadOnlyDisk disk
  TMPDIR=$PWD/disk refuses "temporary files on a read-only disk" 6 "temporary|read-only|no folder can be made" import in/chest.zip -o out/ct.nrrd
  cd disk || exit 1
  succeeds "a read-only working folder" grow ../in/ball.obj "${quick[@]}" -o ../out/tree.vtp -q
  refuses "into a read-only working folder" 6 "read-only" grow ../in/ball.obj "${quick[@]}" -o tree.vtp -q
  cd ..
  rm -f out/*
  umount disk
else
  echo "SKIPPED: full and read-only disks: this user may mount nothing, not even in a namespace"
fi
each intoNothing nowhere

# stopsAt KIND N ARGUMENT...: starts the command, which stops before such a call; its number is $process.
stopsAt() {
  head -c 16 /dev/zero >"$logs/count"
  env LD_PRELOAD="$FAULT_SHIM" FAULT_CALL="$1" FAULT_AT="$2" FAULT_SIGNAL=19 FAULT_REPORT="$logs/count" \
    FAULT_UNDER="$workFolder/out:$workFolder/tmp" "$PNEUMA" "${@:3}" >"$logs/out" 2>"$logs/err" </dev/null &
  process=$!
  local waited=0
  until grep -q '^State:.T' "/proc/$process/status" 2>/dev/null; do
    sleep 0.05
    waited=$((waited + 1))
    if [ "$waited" -gt 1200 ] || ! kill -0 "$process" 2>/dev/null; then
      fail "it never stopped"
      return 1
    fi
  done
}
# goesOn: and on with it, to its end.
goesOn() {
  kill -CONT "$process"
  wait "$process"
  code=$?
}

for at in "write 1" "sync 1" "rename 1"; do
  read -r kind n <<<"$at"
  for line in "grow in/ball.obj ${quick[*]} -o out/tree.vtp -f -q" \
    "export in/breathing.pneuma --preset paraview -o out -f -q" \
    "run in/recipe.json -o out/case.pneuma -f -q"; do
    caseName="the folder vanishes at $kind $n: $line"
    cases=$((cases + 1))
    prepare fresh
    read -ra arguments <<<"$line"
    stopsAt "$kind" "$n" "${arguments[@]}" || continue
    rm -rf out
    goesOn
    [ "$code" -eq 6 ] || fail "exit code $code, not 6"
    [ "$(wc -l <"$logs/err")" -eq 1 ] || fail "$(wc -l <"$logs/err") lines on standard error, not one"
    [ ! -e out ] || fail "the folder came back"
  done
done

# A link in place of what is written aside: nothing goes through it.
echo victim >in/victim
for at in "write 1" "sync 1" "rename 1"; do
  read -r kind n <<<"$at"
  caseName="a link takes the place of the part at $kind $n"
  cases=$((cases + 1))
  prepare fresh
  stopsAt "$kind" "$n" grow in/ball.obj "${quick[@]}" -o out/tree.vtp -f -q || continue
  part=$(find out -name '.pneuma-*.part')
  [ -f "$part" ] || fail "there is no part: $(ls -A out)"
  rm -f "$part"
  ln -s ../in/victim "$part"
  goesOn
  [ "$(cat in/victim)" = victim ] || fail "the victim was written to"
  [ -z "$(find out -name '.pneuma-*')" ] || fail "left behind: $(ls -A out)"
done

# Links of the user are for what is written, not for what is written aside.
prepare fresh
echo old >out/real.vtp
ln -s real.vtp out/link.vtp
succeeds "through a link" grow in/ball.obj "${quick[@]}" -o out/link.vtp -f -q
[ -L out/link.vtp ] && grep -q VTKFile out/real.vtp || fail "it did not go to where the link leads"
ln -s later.vtp out/dangling.vtp
succeeds "through a link to nothing yet" grow in/ball.obj "${quick[@]}" -o out/dangling.vtp -q
[ -L out/dangling.vtp ] && grep -q VTKFile out/later.vtp || fail "it did not go to where the link leads"
ln -s nowhere/later.vtp out/astray.vtp
refuses "through a link into no folder" 6 "does not exist" grow in/ball.obj "${quick[@]}" -o out/astray.vtp -q
ln -s a out/b
ln -s b out/a
ln -s b.vtp out/a.vtp
ln -s a.vtp out/b.vtp
refuses "a loop of links" 6 "a.vtp|b.vtp" grow in/ball.obj "${quick[@]}" -o out/a.vtp -f -q
refuses "a folder that is a loop of links" 6 "out/a" lobes in/chest -o out/a --spacing 10 -f -q
refuses "a preset into a loop of links" 6 "out/a" export in/breathing.pneuma --preset tree -o out/a -f -q
refuses "a run into a loop of links" 6 "out/a" run in/recipe.json -o out/a -f -q
refuses "a sample into a loop of links" 6 "out/a" sample out/a --cell 6 -f -q
for device in /dev/full /dev/null; do
  refuses "$device as output" 6 "device|pipe|not a file|exists" measure in/tree.swc -o $device -f
done
ln -s /dev/full out/full.json
refuses "a link to a full device" 6 "device" measure in/tree.swc -o out/full.json -f
mkfifo out/pipe.json
refuses "a pipe as output" 6 "pipe" measure in/tree.swc -o out/pipe.json -f
refuses "a device as the folder" 6 "/dev/full" lobes in/chest -o /dev/full --spacing 10 -f

prepare fresh
made run in/recipe.json -o out/case.pneuma
ln -s ../in/victim out/case.pneuma~
succeeds "a link in place of the project before" run in/recipe.json -o out/case.pneuma -f -q
[ "$(cat in/victim)" = victim ] || fail "the victim was written to"
[ ! -L out/case.pneuma~ ] || fail "the link is still there"
made run in/recipe.json -o out/case.pneuma -f
expect "the project is not as before" "$PNEUMA" info out/case.pneuma
mkdir out/tree
ln -s ../../in/victim out/tree/tree.swc
succeeds "a link in place of an exported file" export in/breathing.pneuma --preset tree -o out/tree -f -q
[ "$(cat in/victim)" = victim ] || fail "the victim was written to"
# Two names of one file: what a crash in the middle of saving leaves.
rm -f out/case.pneuma~
ln out/case.pneuma out/case.pneuma~
succeeds "the project before is the same file" run in/recipe.json -o out/case.pneuma -f -q
[ -z "$(find out -name '.pneuma-*' -o -name 'case.pneuma~?*')" ] || fail "left behind: $(ls -A out)"
finish
