#!/usr/bin/env bash
# Makes what the pictures of pictures.json, window.json and defects.json show: inputs.sh FOLDER; needs PNEUMA and,
# for the charts, an X server. All of it is generated, coarse and small, and the same everywhere.
set -eu
: "${PNEUMA:?is the program under test}"
mkdir -p "$1"
cd "$1"
make() { "$PNEUMA" "$@" -q -f >inputs.log 2>&1 || { echo "pneuma $* failed:"; cat inputs.log; exit 1; }; }

make sample chest --cell 6mm
make sample scan --cell 6mm --ct --spacing 3mm --thick 5mm --noise 0
make sample tilted --cell 6mm --ct --spacing 4mm --thick 8mm --noise 0 --tilt 15deg
make sample collapsed --cell 6mm --ct --spacing 4mm --thick 8mm --noise 0 --collapsed
# Whole lungs and airways from the CT, and lobes of them.
make segment scan/ct.nii.gz -o found.nii.gz --surfaces found --central found.vtp
make lobes found --fissures scan/fissures.json -o lobes

for method in kitaoka centroid dla; do
  make grow chest --central chest/central.vtp --method $method --terminals 50 -o $method.vtp
done
for organ in right-lung simple sphere cylinder cube; do make grow --organ $organ --terminals 50 -o $organ.vtp; done
make grow --organ thorax --set flow-threshold=0.03 -o thorax.vtp

for scenario in quiet vital-capacity copd copd-severe dyspnea stiff pneumothorax tumour; do
  make breathe chest kitaoka.vtp -o breath-$scenario.pvd --scenario $scenario --frames 4
done
make breathe chest -o curves.pvd --scenario copd --frames 4 --curve chart-copd.png
make breathe chest -o curves.pvd --scenario vital-capacity --frames 4 --curve chart-vital-capacity.png
make outline --particles 1500 --picture chart-outline.png
make compare kitaoka.vtp centroid.vtp dla.vtp --domain chest --size 160x120 --picture chart-methods.png
make reproduce santhanam-2008 --pictures santhanam

# What is wrong in defects.json: the upper and the lower left lobe have changed names; all is mirrored.
mkdir -p swapped mirrored
cp chest/rul.stl chest/rml.stl chest/rll.stl chest/central.vtp swapped
cp chest/lul.stl swapped/lll.stl
cp chest/lll.stl swapped/lul.stl
mirror() { # mirror FROM.obj TO.obj: left is right, and outside stays outside
  awk '$1 == "v" { $2 = -$2 } $1 == "f" { swap = $2; $2 = $3; $3 = swap } { print }' "$1" >"$2"
}
make export chest/central.vtp -o mirrored/from.swc
awk '!/^#/ { $3 = -$3 } { print }' mirrored/from.swc >mirrored/central.swc
rm mirrored/from.swc
for lobe in rul rml rll lul lll; do
  make export chest/$lobe.stl -o mirrored/from.obj
  mirror mirrored/from.obj mirrored/$lobe.obj
  rm mirrored/from.obj
done

# What the window refuses.
printf 'solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n' >cut.stl
printf '1 2 0 0 0 5 -1\n2 2 0 0 -10 five 1\n' >damaged.swc
printf 'this is no project\n' >none.pneuma
rm inputs.log
