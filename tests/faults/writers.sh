#!/usr/bin/env bash
# The n-th write, fsync, rename, open, close, seek, allocation or start of a thread fails, for everything
# the command line writes: it ends with 6 (9 for memory and threads) and one sentence, or does
# without; every old file is there or the new one, whole; nothing half written is left, nor in TMPDIR.
# Usage: writers.sh files|pictures
. "$(dirname "$0")/lib.sh"
. "$here/inputs.sh"

bad=0 missed=0 mixed=0 drawn=0 stages=0
if [ "$full" -eq 1 ]; then
  mostFiles=${PNEUMA_FAULT_MOST:-60} mostMemory=${PNEUMA_FAULT_MOST:-40}
else
  mostFiles=1 mostMemory=1
fi

# faults NAME KIND MOST CODES "ERROR ..." STATE "SETTING ..." ARGUMENT...: calls of a kind fail one by one.
faults() {
  local name=$1 kind=$2 most=$3 codes=$4 state=$6 n
  local -a errors settings
  read -ra errors <<<"$5"
  read -ra settings <<<"$7"
  shift 7
  prepare "$state"
  counted "$kind" FAULT_AT=0 "${settings[@]}" -- "$@"
  local count=$calls tried=0
  case $kind in
    write | sync | rename | open) # what every writer does; else nothing would be tried, and nothing fail
      caseName="$name, $state"
      cases=$((cases + 1))
      [ "$count" -gt 0 ] || fail "no $kind was counted"
      ;;
  esac
  while read -r n; do
    tried=$((tried + 1))
    faultCase "$name" "$kind" "$n" "${errors[$((n % ${#errors[@]}))]}" $((n / 2 % 2)) "$state" "$codes" "${settings[@]}" -- "$@"
    [ "${#settings[@]}" -eq 0 ] || unset "${settings[@]%%=*}"
  done < <(picks "$count" "$most")
  [ "$tried" -eq 0 ] || table="$table $kind:$tried/$count"
}

# What is tried without PNEUMA_FAULTS=full: one of each way of writing.
usual="grow .vtp|study|export .ply|export a folder|export --preset share|render .png|report .pdf"

# writer NAME ARGUMENT...: everything that can fail while this command writes into out.
writer() {
  local name=$1 state
  shift
  [[ -z ${PNEUMA_FAULT_ONLY:-} || $name == $PNEUMA_FAULT_ONLY ]] || return
  [ "$full" -eq 1 ] || [[ "|$usual|" == *"|$name|"* ]] || return
  cases=$((cases + 1))
  reference "$name" "$@"
  local badBefore=$bad casesBefore=$cases missedBefore=$missed mixedBefore=$mixed
  for state in ${states:-over fresh}; do
    table=
    # ENOSPC EIO EDQUOT; all of one kind, and those that are no errors
    faults "$name" write "$mostFiles" 6 "28 5 122" $state "" "$@"
    faults "$name" sync "$mostFiles" "0 6" "5 28" $state "" "$@"
    faults "$name" rename "$mostFiles" "0 6" "13 5 18" $state "" "$@"
    faults "$name" open "$mostFiles" "0 6" "13 24 28 30" $state "" "$@"
    if [ "$full" -eq 1 ] || [ $state = fresh ]; then
      faults "$name" write $(((mostFiles + 1) / 2)) 0 "0 4" $state "" "$@"
      faults "$name" close "$mostFiles" "0 6" 5 $state "" "$@"
      faults "$name" seek "$mostFiles" "0 6" 5 $state "" "$@"
      [ "$drawn" -eq 1 ] || faults "$name" thread "$mostFiles" "0 9" 11 $state "" "$@" --threads 4
    else
      faults "$name" own-allocation "$mostMemory" "0 9" 12 $state "" "$@"
      [ "$drawn" -eq 1 ] || faults "$name" allocation "$mostMemory" "0 9" 12 $state FAULT_BYTES=65536 "$@"
    fi
    if [ "$full" -eq 1 ]; then
      faults "$name" own-allocation "$mostMemory" "0 9" 12 $state "" "$@"
      [ "$drawn" -eq 1 ] || faults "$name" allocation "$mostMemory" "0 9" 12 $state FAULT_BYTES=65536 "$@"
    fi
    echo "$name, $state:$table"
  done
  echo "$name: $((cases - casesBefore)) runs, $((bad - badBefore)) bad, $((missed - missedBefore)) without a fault," \
    "$((mixed - mixedBefore)) with old and new files beside each other"
}

quick=(--method centroid --terminals 30)
case ${1:-files} in
files)
  for format in vtp swc csv json; do
    writer "grow .$format" grow in/ball.obj "${quick[@]}" -o out/tree.$format --report out/report.json -f -q
  done
  writer "outline .swc" outline --particles 300 -o out/outline.swc -f -q
  writer "measure" measure in/tree.swc -o out/measures.json -f -q
  writer "study" study in/ball.obj "${quick[@]}" --seeds 2 -o out/study.csv -f -q
  keeps=" ./config.yaml ./profiles/local/config.yaml ./profiles/slurm/config.yaml " # which people change
  varies=" ./profiles/local/config.yaml " # tells what memory is free
  writer "cohort" cohort init out --cases in/chest --recipe in/recipe.json -f -q
  keeps='' varies=''
  writer "compare" compare in/tree.swc in/other.swc -o out/table.txt -f -q
  writer "estimate" estimate --landmarks in/landmarks.csv -o out/constants.json -f -q
  writer "repair .stl" repair in/ball.obj -o out/ball.stl -f -q
  writer "export .ply" export in/ball.obj -o out/ball.ply -f -q
  writer "export .obj" export in/ball.obj -o out/ball.obj -f -q
  writer "export a folder" export in/chest --only RUL,RML -o out -f -q --format stl
  writer "segment" segment in/chest/ct.nii.gz -o out/labels.nii.gz --surfaces out --central out/central.vtp \
    --report out/report.json --triangles 2000 -f -q
  writer "import .nrrd" import in/chest/dicom -o out/ct.nrrd -f -q
  writer "import .mha" import in/chest/ct.nii.gz -o out/ct.mha -f -q
  writer "lobes" lobes in/chest -o out/lobes --spacing 10 -f -q
  writer "fissures .json" fissures in/chest --points 5 -o out/points.json -f -q
  writer "fissures .fcsv" fissures in/chest --points 5 -o out/points.fcsv -f -q
  writer "run into a project" run in/recipe.json -o out/case.pneuma -f -q
  stages=1 # those that were done stay, so that it can go on
  writer "run into a folder" run in/recipe.json -o out/case -f -q
  stages=0
  for preset in paraview print segmentation tree recipe share; do
    writer "export --preset $preset" export in/breathing.pneuma --preset $preset -o out/$preset -f -q
  done
  writer "breathe" breathe in/chest in/airways.vtp -o out/breath.pvd --gltf out/breath.glb --frames 2 -f -q
  writer "report .json" report in/ball.obj in/tree.swc -o out/page.json -f -q
  writer "sample" sample out/chest --cell 6 -f -q
  states=fresh writer "anonymize" anonymize in/chest/dicom -o out/dicom --key 12345678 -q
  ;;
pictures) # but for threads and memory of the display's libraries, which end or wait for ever without
  drawn=1
  size=(--size 64x48)
  writer "render .png" render in/ball.obj in/tree.swc -o out/ball.png "${size[@]}" -f -q
  writer "render slices" render in/chest/ct.nii.gz -o out/slices.png "${size[@]}" -f -q
  writer "report .html" report in/ball.obj in/tree.swc -o out/page.html -f -q
  writer "report .pdf" report in/ball.obj in/tree.swc -o out/page.pdf -f -q
  writer "outline picture" outline --particles 300 -o out/outline.swc --picture out/outline.png -f -q
  writer "compare picture" compare in/tree.swc in/other.swc -o out/table.txt --picture out/trees.png "${size[@]}" -f -q
  writer "breathe pictures" breathe in/chest -o out/breath.pvd --curve out/curve.png --pictures --frames 2 "${size[@]}" -f -q
  made breathe in/chest -o in/breath.pvd --frames 2
  writer "render .ogv" render in/breath.pvd -o out/breath.ogv "${size[@]}" -f -q
  writer "export --preset film" export in/breathing.pneuma --preset film -o out/film -f -q
  ;;
*) echo "usage: writers.sh files|pictures"; exit 2 ;;
esac
echo "$missed runs ended before their fault; $mixed left old and new files, each whole, beside each other"
finish
