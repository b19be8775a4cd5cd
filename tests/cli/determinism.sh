#!/usr/bin/env bash
# The same input, options and seed give the same bytes, for any number of threads, in every run and in every format.
# RUNS=3 does all of it three times. HASHES=FILE keeps the list of SHA-256, to be compared with that of another build
# of the same version (debug and release, two machines). Reports tell how long a step took and what memory it needed;
# these lines, and the sums of such reports in run.json, are left out before they are compared.
. "$(dirname "$0")/lib.sh"

fiveBalls lobes
for threads in 1 2; do
  for format in vtp swc csv json; do
    succeeds "$format with $threads threads" \
      grow lobes --terminals 3000 --method centroid --set jitter=0.3 --seed 7 -j "$threads" -o "$threads.$format"
  done
done
for format in vtp swc csv json; do
  caseName="$format"
  expect "the $format files of 1 and 2 threads differ" cmp "1.$format" "2.$format"
done

# everything THREADS: what every command with a result writes, in a folder "work" of its own.
everything() {
  mkdir work && cd work || exit 1
  echo '{"schema": "pneuma/recipe/1", "airways": {"method": "kitaoka", "terminals": 1000}}' >recipe.json
  caseName="with $1 threads"
  local arguments
  while read -r -a arguments; do
    cases=$((cases + 1))
    run "${arguments[@]}" -q -j "$1"
    [ "$code" -eq 0 ] || [ "$code" -eq 7 ] || fail "${arguments[0]} ends with $code"
    cat "$logs/out" >>printed.json
  done <<'COMMANDS'
sample chest --ct --spacing 3
sample lobes --cell 5mm
segment chest/dicom -o labels.nii.gz --surfaces lungs --central central.vtp --report segment.json
lobes lungs -o split
fissures lobes -o fissures.mrk.json
import chest/dicom -o ct.nrrd
grow lobes --central chest/central.vtp --terminals 2000 --method kitaoka -o kitaoka.vtp --report kitaoka.json
grow lobes --central chest/central.vtp --terminals 2000 --method centroid -o centroid.vtp
grow lobes --central chest/central.vtp --terminals 2000 --method dla -o dla.vtp --points particles.vtp
grow --organ thorax --terminals 2000 -o thorax.vtp
outline -o outline.vtp
breathe lobes kitaoka.vtp -o breath.pvd --frames 3 --gltf breath.glb
run recipe.json --ct chest/dicom -o case
run recipe.json --ct chest/dicom -o case.pneuma
export case.pneuma --preset paraview -o paraview
export case.pneuma --preset tree -o tree
report case.pneuma -o report.json
measure kitaoka.vtp --domain lobes --json
compare kitaoka.vtp centroid.vtp --json
study --organ simple --seeds 4 -o study.csv
repair lobes/rul.stl -o mended.stl
render ct.nrrd --labels labels.nii.gz --slice axial -o slices.png
anonymize chest/dicom -o anonymous --key a-long-secret
COMMANDS
  # A project holds times within what is compressed: its members are compared.
  mkdir project && (cd project && cmake -E tar xf ../case.pneuma) || fail "the project was not opened"
  rm case.pneuma && cd ..
  find work -name '*.json' -exec sed -E -i '/"(read|domain|grow|measure|write|find|[a-z]+_s|peak_memory_mb)": [0-9.e-]+,?$/d' {} +
  sed -E -i '/"(lungs|lobes\/lobes|growth)\.json": "[0-9a-f]{64}"/d' work/case/run.json
  (cd work && find . -type f | sort | xargs sha256sum) >"$2"
  rm -rf work
}
everything 1 first
caseName="files to compare"
expect "there are only $(wc -l <first) of them" test "$(wc -l <first)" -gt 150
for ((i = 0; i < ${RUNS:-1}; i++)); do
  for threads in 2 8; do
    everything "$threads" again
    caseName="everything with $threads threads"
    expect "it differs: $(diff first again | awk '/^>/ { print $3 }' | head -n 5 | tr '\n' ' ')" cmp first again
  done
done
[ -z "${HASHES:-}" ] || cp first "$HASHES"

succeeds "another seed" grow lobes --terminals 3000 --method centroid --set jitter=0.3 --seed 8 -o other.csv
expect "the seed does nothing" test "$(cmp -s 1.csv other.csv; echo $?)" -eq 1
finish
