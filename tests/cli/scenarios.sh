#!/usr/bin/env bash
# A picture of every way of breathing near its deepest moment, a film, an animation; under an X server.
# Needs BASELINES (tests/baselines); UPDATE=1 writes them anew.
. "$(dirname "$0")/lib.sh"

succeeds "a chest" sample chest --cell 5mm -q
succeeds "a tree in it" grow chest --central chest/central.vtp --method centroid --terminals 200 -o tree.vtp -q
drawn() { # drawn SCENARIO SECONDS [breathe options]: its picture is the baseline
  local baseline=$BASELINES/breath_$1.png
  succeeds "$1" breathe chest tree.vtp -o "$1.pvd" --scenario "$1" --frames 5 -q "${@:3}"
  if [ "${UPDATE:-}" ]; then
    succeeds "$1 drawn" render "$1.pvd" --time "$2" --size 320x240 --force -o "$baseline"
  else
    succeeds "$1 looks as it did" render "$1.pvd" --time "$2" --size 320x240 --reference "$baseline" --diff "diff_$1.png" -o "$1.png"
  fi
}
drawn quiet 2
drawn vital-capacity 3
drawn copd 2
drawn copd-severe 2
drawn dyspnea 1
drawn stiff 2
drawn pneumothorax 2 --gltf breath.glb
drawn tumour 2

expect "the animation is no glTF" test "$(head -c 4 breath.glb)" = glTF
succeeds "a film" render quiet.pvd -o quiet.ogv --size 160x120 --repeat 2
prints '10 pictures, 1 a second'
expect "the film is no Ogg" test "$(head -c 4 quiet.ogv)" = OggS
caseName="another moment is another picture"
cases=$((cases + 1))
run render vital-capacity.pvd --time 0 --size 320x240 --reference "$BASELINES/breath_vital-capacity.png" -o rest.png
[ "$code" -eq 8 ] || fail "exit code $code, not 8"
refuses "a film of no breath" 2 "needs a breath" render chest -o chest.ogv
refuses "a film that is there" 6 "exists" render quiet.pvd -o quiet.ogv
refuses "a breath and a tree" 2 "drawn alone" render quiet.pvd tree.vtp -o both.png
refuses "films compared" 2 "not compared" render quiet.pvd -o new.ogv --reference quiet.png
echo "<VTKFile/>" >broken.pvd
refuses "a collection that is none" 4 "no ParaView collection" render broken.pvd -o none.png
rm quiet_0002.vtp
refuses "a frame that is gone" 3 "quiet_0002.vtp" render quiet.pvd -o none.ogv
expect "a film of fewer frames was written" test ! -e none.ogv
refuses "an animation of another kind" 5 "end in .glb" breathe chest -o none.pvd --gltf none.obj
finish
