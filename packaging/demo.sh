#!/usr/bin/env bash
# From nothing to pictures: installs what is missing, builds the command line, makes a synthetic
# chest, grows airway trees of 30,000 terminals in its five lobes, measures and draws them, lets them
# breathe, goes from the chest's CT to a tree by one command, and grows the thorax of Kitaoka 1999.
#   packaging/demo.sh [OUTDIR]        (default: demo-output)
# Where ../shared/data/lobes_airways_chaste stands beside the project, the same is done in the lobes
# and airways of a real person. PNEUMA=pneuma takes a program that is installed, and installs and
# builds nothing, as this script does where a package put it.
set -euo pipefail
out=$(realpath -m "${1:-demo-output}")
[[ ${PNEUMA:-} != */* ]] || PNEUMA=$(realpath "$PNEUMA")
cd "$(dirname "${BASH_SOURCE[0]}")/.."

step() { printf '\n== %s\n' "$1"; }

if [[ -n ${PNEUMA:-} || ! -e CMakeLists.txt ]]; then
  pneuma=${PNEUMA:-pneuma}
  for needed in "$pneuma" xvfb-run; do
    if ! command -v "$needed" >/dev/null; then
      echo "demo.sh: there is no program '$needed'; install the packages pneuma, xvfb and xauth" >&2
      exit 3
    fi
  done
  "$pneuma" version
else
  step "Dependencies"
  packaging/install-dependencies.sh

  step "Build"
  if [[ -z ${CMAKE_CXX_COMPILER_LAUNCHER:-} ]] && command -v ccache >/dev/null; then
    export CMAKE_CXX_COMPILER_LAUNCHER=ccache
  fi
  cmake --preset release --log-level=WARNING
  cmake --build --preset release --target pneuma_cli
  pneuma=$PWD/build/release/app/cli/pneuma
fi

mkdir -p "$out"

# draw PICTURE INPUT... OPTIONS...
draw() {
  local picture=$1
  shift
  LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 1600x1200x24" \
    "$pneuma" render "$@" -o "$picture" --size 1600x1200 --force
  echo "$picture"
}

# grow_and_draw FOLDER LOBES CENTRAL: tree, report, measurements and pictures of one lung.
grow_and_draw() {
  local folder=$1 lobes=$2 central=$3 method
  for method in kitaoka centroid dla; do
    mkdir -p "$folder/$method"
    "$pneuma" grow "$lobes" --central "$central" --method $method --terminals 30000 --force \
      -o "$folder/$method/tree.vtp" --report "$folder/$method/report.json"
    "$pneuma" measure "$folder/$method/tree.vtp" --domain "$lobes" >"$folder/$method/measures.txt"
    draw "$folder/$method/anterior-by-lobe.png" "$lobes" "$folder/$method/tree.vtp" \
      --view anterior --colour-by lobe
  done
  "$pneuma" compare "$folder"/{kitaoka,centroid,dla}/tree.vtp >"$folder/comparison.txt"
  draw "$folder/kitaoka/left-by-diameter.png" "$folder/kitaoka/tree.vtp" --view left \
    --colour-by diameter
  draw "$folder/kitaoka/oblique-by-strahler.png" "$folder/kitaoka/tree.vtp" --view 40,20 \
    --colour-by strahler
  draw "$folder/centroid/first-generations.png" "$lobes" "$folder/centroid/tree.vtp" \
    --view anterior --colour-by generation --max-generation 9 --background white
}

step "A synthetic chest"
"$pneuma" sample "$out/sample" --force
grow_and_draw "$out/synthetic" "$out/sample" "$out/sample/central.vtp"

# breathe_and_draw FOLDER LOBES TREE: a deep breath for ParaView, drawn frame by frame.
breathe_and_draw() {
  mkdir -p "$1"
  LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 1600x1200x24" \
    "$pneuma" breathe "$2" "$3" -o "$1/breath.pvd" --scenario vital-capacity --frames 8 \
    --pictures --curve "$1/pressure-and-volume.png" --force
}

step "A breath"
breathe_and_draw "$out/breath" "$out/sample" "$out/synthetic/kitaoka/tree.vtp"

step "From a CT to a grown tree"
"$pneuma" sample "$out/ct" --ct --spacing 1 --force
"$pneuma" run --ct "$out/ct/dicom" -o "$out/case"
draw "$out/case/slices-and-tree.png" "$out/ct/ct.nii.gz" "$out/case/right.vtp" \
  "$out/case/left.vtp" "$out/case/tree.vtp" --labels "$out/case/labels.nii.gz"

step "The thorax of Kitaoka 1999"
mkdir -p "$out/thorax"
"$pneuma" grow --organ thorax --force -o "$out/thorax/tree.vtp" --report "$out/thorax/report.json"
draw "$out/thorax/anterior-by-segment.png" "$out/thorax/tree.vtp" --view anterior \
  --colour-by segment --background white
draw "$out/thorax/right-by-segment.png" "$out/thorax/tree.vtp" --view right \
  --colour-by segment --background white

real=../shared/data/lobes_airways_chaste
if [[ -d $real ]]; then
  step "A real lung"
  grow_and_draw "$out/real" "$real" "$real/TestSubject002MajorAirways.vtu"
  breathe_and_draw "$out/real/breath" "$real" "$out/real/kitaoka/tree.vtp"
fi

# run_and_draw FOLDER CT: from a person's CT to lobes and a grown tree.
run_and_draw() {
  "$pneuma" run --ct "$2" -o "$1"
  draw "$1/slices-and-tree.png" "$2" "$1/lobes" "$1/tree.vtp" --labels "$1/labels.nii.gz"
}

data=../shared/data
for ct in ct_lidc_idri_0001/lidc_idri_0001.mha ct_lung_dx_a0001_dicom/series; do
  if [[ -e $data/$ct ]]; then
    step "A real CT: ${ct%%/*}"
    run_and_draw "$out/${ct%%/*}" "$data/$ct"
  fi
done

step "Where things are"
find "$out" -type f -printf '%10s bytes  %p\n' | sort -k3
echo
echo "Open the .vtp and .pvd files in ParaView; look at the .png files; read report.json and measures.txt."
