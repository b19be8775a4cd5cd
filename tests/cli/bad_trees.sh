#!/usr/bin/env bash
# Central trees that are none, and regions without an airway: one sentence, exit 4, nothing written.
. "$(dirname "$0")/lib.sh"

ball 60 >ball.obj
swc() { printf '%s\n' "$@"; }
swc "1 5 0 0 120 9 -1" "2 5 0 0 60 7 1" "3 5 0 0 10 5 2" >good.swc
swc "1 5 0 0 120 9 3" "2 5 0 0 60 7 1" "3 5 0 0 10 5 2" >cycle.swc
swc "1 5 0 0 120 9 -1" "2 5 0 0 60 7 1" "3 5 0 0 10 5 2" "4 5 9 0 30 5 5" "5 5 9 0 20 5 4" >inner_cycle.swc
swc "1 5 0 0 120 9 -1" "2 5 0 0 10 7 1" "3 5 30 0 120 9 -1" "4 5 30 0 10 7 3" >two_roots.swc
swc "1 5 0 0 920 9 -1" "2 5 0 0 860 7 1" >elsewhere.swc
swc "1 5 0 0 120 9 -1" "2 5 0 0 10 0 1" >no_radius.swc
swc "1 5 0 0 120 9 -1" "2 5 0 nan 10 5 1" >nan.swc
swc "1 5 0 0 120 9 -1" "2 5 0 0 10 5 7" >no_parent.swc
swc "1 5 0 0 120 9 -1" "1 5 0 0 10 5 1" >twice.swc
swc "1 5 0 0 120" "2 5 0 0 10 5 1" >short.swc

succeeds "a sound central tree" grow ball.obj --central good.swc --method centroid --points 2000 -o tree.vtp
rm -f tree.vtp
refuses "a cycle" 4 "cycle.swc.*(cycle|root)" grow ball.obj --central cycle.swc -o tree.vtp
refuses "a cycle beside the tree" 4 "inner_cycle.swc.*cycle" grow ball.obj --central inner_cycle.swc -o tree.vtp
refuses "two roots" 4 "two_roots.swc.*root" grow ball.obj --central two_roots.swc -o tree.vtp
refuses "no end in a lobe" 4 "(lobe|region|surface|whole).*" grow ball.obj --central elsewhere.swc -o tree.vtp
refuses "no radius" 4 "no_radius.swc.*radius" grow ball.obj --central no_radius.swc -o tree.vtp
refuses "a coordinate that is no number" 4 "nan.swc" grow ball.obj --central nan.swc -o tree.vtp
refuses "a parent that is not there" 4 "no_parent.swc" grow ball.obj --central no_parent.swc -o tree.vtp
refuses "a number twice" 4 "twice.swc" grow ball.obj --central twice.swc -o tree.vtp
refuses "a short line" 4 "short.swc" grow ball.obj --central short.swc -o tree.vtp
for bad in cycle two_roots nan no_radius; do
  refuses "measure: $bad" 4 "$bad.swc" measure "$bad.swc"
  refuses "export: $bad" 4 "$bad.swc" export "$bad.swc" -o "$bad.vtp"
done

succeeds "a grown tree" grow ball.obj --method centroid --points 2000 -o grown.vtp
refuses "a grown tree is no central tree" 4 "grown.vtp.*central" grow ball.obj --central grown.vtp -o tree.vtp
fiveBalls lobes
refuses "a lobe without an airway" 4 "(lobe|bronch|airway)" grow lobes --central good.swc -o tree.vtp
finish
