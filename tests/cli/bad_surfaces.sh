#!/usr/bin/env bash
# Surfaces that are read but not fit to grow in: refused with exit 4, told by info, mended by repair.
. "$(dirname "$0")/lib.sh"

ball 60 >ball.obj
sed '$d' ball.obj >open.obj
awk '$1 == "f" { print "f", $2, $4, $3; next } { print }' ball.obj >inside_out.obj
awk 'NR == 1 { print "v 0 0 -90"; next } { print }' ball.obj >pierced.obj
awk '$1 == "v" { print "v", $2, $3, 0; next } { print }' ball.obj >flat.obj
ball 0.06 >metres.obj
awk '$1 == "f" && !done { print "f", $2, $4, $3; done = 1; next } { print }' ball.obj >one_turned.obj

refuses "an open surface" 4 "open.obj.*(open|hole)" grow open.obj -o tree.vtp
refuses "an inside-out surface" 4 "inside_out.obj.*(inside|outward|orient)" grow inside_out.obj -o tree.vtp
refuses "a self-intersecting surface" 4 "pierced.obj.*(intersect|cut)" grow pierced.obj -o tree.vtp
refuses "a surface of no volume" 4 "flat.obj" grow flat.obj -o tree.vtp
refuses "a lobe in metres" 4 "metres.obj.*metres.*--from-units m" grow metres.obj -o tree.vtp
refuses "a triangle turned round" 4 "one_turned.obj" grow one_turned.obj -o tree.vtp

mkdir loops && ln -s loop loops/loop
refuses "a folder with a link to itself only" 4 "loops.*holds no lobe surface" grow loops -o tree.vtp
fiveBalls lobes
ln -s loop lobes/loop # no file, and in nobody's way
cp lobes/rul.obj lobes/case_RUL.obj
refuses "two files for one lobe" 4 "rul.*rul.*one file per lobe" grow lobes -o tree.vtp
rm lobes/case_RUL.obj
refuses "several surfaces without names" 4 "which lobe" grow ball.obj lobes/rul.obj -o tree.vtp
refuses "an open lobe among five" 4 "rll.obj.*(open|hole)" \
  grow lobes/rul.obj lobes/rml.obj lobes/lul.obj "$(sed '$d' lobes/rll.obj >rll.obj && echo rll.obj)" -o tree.vtp
succeeds "a tree to measure" grow ball.obj --method centroid --points 2000 -o ball.swc
refuses "measuring in an open surface" 4 "open.obj.*open edge" measure ball.swc --domain open.obj

for bad in open inside_out pierced flat metres one_turned; do
  succeeds "info tells of $bad" info "$bad.obj"
  prints '^  ! '
done
succeeds "info of a sound surface" info ball.obj
prints 'healthy: fit to grow in'

for bad in open inside_out one_turned; do
  succeeds "repair mends $bad" repair "$bad.obj" -o "$bad.stl"
  prints '^  - '
  succeeds "info of what was mended" info "$bad.stl"
  prints 'healthy: fit to grow in'
done
refuses "repair of a surface of no volume" 4 "flat|volume" repair flat.obj -o flat.stl
succeeds "metres become millimetres" export metres.obj --from-units m -o millimetres.stl
succeeds "and can be grown in" grow millimetres.stl --method centroid --points 2000 -o tree.vtp
awk '$1 == "v" { print "v", 1000 * $2, 1000 * $3, 1000 * $4; next } { print }' ball.obj >microns.obj
refuses "a lung in micrometres to grow in" 4 "'microns.obj' is 120 m large, if it is in mm; scale it" grow microns.obj -o none.vtp
succeeds "a tree" grow ball.obj --terminals 20 -o small.vtp -q
refuses "a lung in micrometres to measure in" 4 "'microns.obj' is 120 m large" measure small.vtp --domain microns.obj
finish
