#!/usr/bin/env bash
# From nothing to pictures: installs what is missing, builds the command line, makes a synthetic
# chest, grows an airway tree of 30,000 terminals in its five lobes, measures it and draws it.
#   packaging/demo.sh [OUTDIR]        (default: demo-output)
# Where ../shared/data/lobes_airways_chaste stands beside the project, the same is done in the lobes
# and airways of a real person.
set -euo pipefail
out=${1:-demo-output}
mkdir -p "$out"
out=$(cd "$out" && pwd)
cd "$(dirname "${BASH_SOURCE[0]}")/.."

step() { printf '\n== %s\n' "$1"; }

step "Dependencies"
packaging/install-dependencies.sh

step "Build"
if [[ -z ${CMAKE_CXX_COMPILER_LAUNCHER:-} ]] && command -v ccache >/dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi
cmake --preset release --log-level=WARNING
cmake --build --preset release --target pneuma_cli
pneuma=$PWD/build/release/app/cli/pneuma

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
  local folder=$1 lobes=$2 central=$3
  mkdir -p "$folder"
  "$pneuma" grow "$lobes" --central "$central" --method centroid --terminals 30000 --force \
    -o "$folder/tree.vtp" --report "$folder/report.json"
  "$pneuma" measure "$folder/tree.vtp" --domain "$lobes" >"$folder/measures.txt"
  draw "$folder/anterior-by-lobe.png" "$lobes" "$folder/tree.vtp" --view anterior --colour-by lobe
  draw "$folder/left-by-diameter.png" "$folder/tree.vtp" --view left --colour-by diameter
  draw "$folder/oblique-by-strahler.png" "$folder/tree.vtp" --view 40,20 --colour-by strahler
  draw "$folder/first-generations.png" "$lobes" "$folder/tree.vtp" --view anterior \
    --colour-by generation --max-generation 9 --background white
}

step "A synthetic chest"
"$pneuma" sample "$out/sample" --force
grow_and_draw "$out/synthetic" "$out/sample" "$out/sample/central.vtp"

real=../shared/data/lobes_airways_chaste
if [[ -d $real ]]; then
  step "A real lung"
  grow_and_draw "$out/real" "$real" "$real/TestSubject002MajorAirways.vtu"
fi

step "Where things are"
find "$out" -type f -printf '%10s bytes  %p\n' | sort -k3
echo
echo "Open the .vtp files in ParaView; look at the .png files; read report.json and measures.txt."
