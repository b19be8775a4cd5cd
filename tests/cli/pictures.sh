#!/usr/bin/env bash
# Pictures from the command line; to be run under an X server.
. "$(dirname "$0")/lib.sh"

fiveBalls lobes
succeeds "a tree to draw" grow lobes --terminals 3000 -o tree.vtp
size=(--size 480x360)
for view in anterior posterior left right superior inferior A 30,20; do
  succeeds "view $view" render lobes tree.vtp "${size[@]}" --view "$view" -o "view_$view.png"
  expect "no PNG" test "$(head -c 4 "view_$view.png" | tail -c 3)" = PNG
done
expect "a letter is the word" cmp view_anterior.png view_A.png
for colour in lobe segment generation strahler diameter flow; do
  succeeds "coloured by $colour" render tree.vtp "${size[@]}" --colour-by "$colour" -o "colour_$colour.png"
done
succeeds "all the other options" render lobes tree.vtp "${size[@]}" --palette huang --background white --opacity 0.5 \
  --max-generation 6 --hide rul --hide LLL --no-annotations --radius-scale 2 -o options.png

succeeds "the same picture is the same" render lobes tree.vtp "${size[@]}" -o again.png --reference view_anterior.png
prints 'within the limit'
caseName="another picture is another one"
cases=$((cases + 1))
run render lobes tree.vtp "${size[@]}" --view left -o left.png --reference view_anterior.png --threshold 0.03 --diff diff.png
[ "$code" -eq 8 ] || fail "exit code $code, not 8"
expect "no difference was drawn" test -s diff.png
refuses "pictures of two sizes" 4 "size|480" render tree.vtp --size 200x200 -o small.png --reference view_anterior.png
refuses "a reference that is no picture" 4 "tree.vtp" render tree.vtp -o x.png --reference tree.vtp
refuses "a reference that is missing" 3 "missing.png" render tree.vtp -o x.png --reference missing.png

succeeds "a second tree to draw" grow lobes --method centroid --terminals 500 -o few.vtp
succeeds "trees side by side" compare tree.vtp few.vtp --size 240x180 --picture sheet.png
expect "the figures are not printed beside the picture" grep -q '^terminals ' "$logs/out"
succeeds "trees side by side in their lobes" compare tree.vtp few.vtp --domain lobes --view left --colour-by generation \
  --background white --size 240x180 --picture in_lobes.png -o figures.json --json
expect "figures or picture are missing" test -s figures.json -a -s in_lobes.png
succeeds "trees side by side in an organ" compare tree.vtp few.vtp --organ simple --size 100x80 --picture in_organ.png -q
# width FILE: of a PNG.
width() { od -An -tu1 -j 16 -N 4 "$1" | awk '{ print (($1 * 256 + $2) * 256 + $3) * 256 + $4 }'; }
expect "there are not two pictures and a legend" test "$(width sheet.png)" -gt 500 -a "$(width sheet.png)" -lt 600
succeeds "five trees in two rows" compare tree.vtp few.vtp tree.vtp few.vtp tree.vtp --size 100x80 --picture five.png
expect "five trees are not three pictures wide" test "$(width five.png)" -eq 300
refuses "a sheet that is there" 6 "sheet.png.*exists" compare tree.vtp few.vtp --picture sheet.png
refuses "figures that are there leave no picture" 6 "figures.json.*exists" \
  compare tree.vtp few.vtp --picture new.png -o figures.json
refuses "a view that is none" 2 "view.*'sideways'|'sideways'" compare tree.vtp few.vtp --picture new.png --view sideways

for stereo in anaglyph side-by-side crossed; do
  succeeds "for two eyes, $stereo" render lobes tree.vtp "${size[@]}" --stereo "$stereo" -o "eyes_$stereo.png"
done
expect "both eyes see the same" test "$(cksum <eyes_crossed.png)" != "$(cksum <eyes_side-by-side.png)"
refuses "eyes in one place" 2 "eye-distance" render lobes -o x.png --stereo crossed --eye-distance 0

DISPLAY= refuses "no display" 10 "xvfb-run" render tree.vtp -o x.png
DISPLAY=:9999 refuses "a display that does not answer" 10 "xvfb-run" render tree.vtp -o x.png
MESA_GL_VERSION_OVERRIDE=2.1 refuses "an OpenGL that is too old" 10 "no OpenGL 3.2.*xvfb-run" render tree.vtp -o x.png
DISPLAY= refuses "no display for the figures" 10 "xvfb-run" reproduce huang-2004 --pictures figures

succeeds "the figures of a paper" reproduce huang-2004 --pictures figures
for figure in fig1 fig4 fig5; do expect "no $figure" test -s "figures/$figure.png"; done
succeeds "the figures of another paper" reproduce kitaoka-1999 --table 5 --pictures trees
for figure in fig6 fig6a fig6b fig6b-text fig6c fig7a fig7b; do
  expect "no $figure" test -s "trees/$figure.png"
done
refuses "figures that are there" 6 "fig6.png.*exists" reproduce kitaoka-1999 --table 5 --pictures trees
finish
