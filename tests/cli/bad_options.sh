#!/usr/bin/env bash
# Commands and options that cannot be: exit 2, the field, its range and unit named, the nearest word suggested.
. "$(dirname "$0")/lib.sh"

ball 60 >ball.obj
refuses "an unknown command" 2 "no command 'grwo'.*did you mean 'grow'" grwo
refuses "a command like none" 2 "no command 'zzzzzz'.*pneuma help" zzzzzz
refuses "an option for a command" 2 "first argument is a command" --json
refuses "an unknown option" 2 "grow has no option '--terminal'.*--terminals" grow ball.obj --terminal 5 -o t.vtp
refuses "an unknown short option" 2 "no option '-x'" grow ball.obj -x -o t.vtp
refuses "an unknown option with a value" 2 "no option '--colour-bye'.*--colour-by" render ball.obj --colour-bye=lobe -o x.png
refuses "one argument too many" 2 "'more'.*too many" version more
refuses "no output" 2 "output.*required" grow ball.obj
refuses "no input" 2 "surfaces.*--organ" grow -o t.vtp
refuses "surfaces and an organ" 2 "not both" grow ball.obj --organ right-lung -o t.vtp
refuses "an option without its value" 2 "--output|-o" grow ball.obj -o
refuses "an unknown organ" 2 "organ.*right-lung.*'spleen'" grow --organ spleen -o t.vtp
refuses "an organ of negative size" 2 "organ-size.*\[0, 1(00000|e\+05)\] ml.*-5" grow --organ simple --organ-size -5 -o t.vtp
refuses "an organ of absurd size" 2 "organ-size.*\[0, 1(00000|e\+05)\] ml.*1e9" grow --organ simple --organ-size 1e9 -o t.vtp
refuses "an organ smaller than any" 4 "organ of 0.5 ml is not possible.*1 to 100000 ml" grow --organ cube --organ-size 0.5 -o t.vtp
refuses "an organ size that is no number" 2 "organ-size.*number.*'big'" grow --organ thorax --organ-size big -o t.vtp
refuses "a size without an organ" 2 "organ-size is for a built-in organ" grow ball.obj --organ-size 500 -o t.vtp
refuses "a table without an organ" 2 "airway-table is for a built-in organ" grow ball.obj --airway-table a.json -o t.vtp
refuses "a table for lobes" 2 "three lobes.*thorax" grow --organ right-lung --airway-table a.json -o t.vtp
refuses "central airways and a table" 2 "--central or --airway-table, not both" grow --organ simple --central c.vtp --airway-table a.json -o t.vtp
refuses "a table that is missing" 3 "a.json" grow --organ thorax --airway-table a.json -o t.vtp
printf '{"schema": "pneuma/airway-table/1", "frame": "LPS",
  "root": {"name": "T", "start_mm": [0, 3, 25], "direction": [0, 0, -1], "diameter_mm": 18, "length_mm": 105},
  "bifurcations": [{"parent": "T", "hint": [-1, 0, 0], "azimuth_deg": 0,
    "a": {"name": "RB1", "angle_deg": 30, "length_to_diameter": 3},
    "b": {"name": "LB7", "angle_deg": 30, "length_to_diameter": 3}}]}' >b.json
refuses "a table with an unknown segment" 4 "b.json.*'LB7'.*segments are RB1 to RB10" grow --organ thorax --airway-table b.json -o t.vtp
refuses "an unknown method" 2 "method.*'kitaoke'|'kitaoke'" grow ball.obj --method kitaoke -o t.vtp
refuses "an unknown paper" 2 "paper.*huang-2004.*'huang'" reproduce huang
refuses "an unknown table" 2 "table of kitaoka-1999.*1, 2, 3, 4, 5, thorax, claims.*'6'" reproduce kitaoka-1999 --table 6
refuses "a table of another paper" 2 "table of huang-2004.*right-lung.*'thorax'" reproduce huang-2004 --table thorax
refuses "an unknown view" 2 "view.*'sideways'|'sideways'" render ball.obj --view sideways -o x.png
refuses "an unknown colour" 2 "colour-by.*lobe.*strahler.*'taste'" render ball.obj --colour-by taste -o x.png
refuses "an unknown palette" 2 "palette.*huang.*'x'" render ball.obj --palette x -o x.png
refuses "an unknown background" 2 "background.*dark.*'pink'" render ball.obj --background pink -o x.png
refuses "a size that is none" 2 "size.*WIDTHxHEIGHT.*'big'" render ball.obj --size big -o x.png
refuses "a size out of range" 2 "size.*\[16, 8192\] pixels.*99999x10" render ball.obj --size 99999x10 -o x.png
refuses "an unknown lobe to hide" 2 "hide.*RUL.*'spleen'" render ball.obj --hide spleen -o x.png
refuses "a difference from nothing" 2 "diff needs --reference" render ball.obj --diff d.png -o x.png
refuses "an opacity out of range" 2 "opacity.*\[0, 1\].*3" render ball.obj --opacity 3 -o x.png
refuses "an unknown shell" 2 "bash.*zsh.*fish.*'csh'" completion csh
refuses "help for an unknown command" 2 "no command 'growe'.*'grow'" help growe
refuses "an unknown lobe to export" 2 "only.*RUL.*'XXX'" export ball.obj --only XXX -o x.stl
refuses "an unknown frame" 2 "frame.*lps.*'abc'" export ball.obj --frame abc -o x.stl
refuses "unknown units" 2 "from-units.*mm.*'inch'" export ball.obj --from-units inch -o x.stl
refuses "threads out of range" 2 "threads.*\[0, 4096\].*99999" grow ball.obj -j 99999 -o t.vtp
refuses "threads that are no number" 2 "threads.*number.*'many'" grow ball.obj --threads many -o t.vtp
refuses "an unknown progress" 2 "progress.*auto.*'loud'" grow ball.obj --progress loud -o t.vtp
refuses "CSV and JSON" 2 "csv.*json" measure t.vtp --csv --json
refuses "domain and organ" 2 "not both" measure t.vtp --domain ball.obj --organ right-lung
refuses "a lattice out of range" 2 "cell.*\[0.5, 6\] mm.*500" sample chest --cell 500
refuses "a lattice in a wrong unit" 2 "cell.*mm.*'2kg'" sample chest --cell 2kg
refuses "a tilt without a CT" 2 "--tilt is about the CT.*--ct" sample chest --tilt 10
refuses "a mirror without a CT" 2 "--mirror is about the CT.*--ct" sample chest --mirror
refuses "a tilt out of range" 2 "tilt.*\[-30, 30\] deg.*45" sample chest --ct --tilt 45
refuses "half a gap" 2 "gaps.*\[0, 20\].*1.5" sample chest --ct --gaps 1.5
refuses "slices of no thickness" 2 "thick.*\[0.4, 10\] mm.*0" sample chest --ct --thick 0
refuses "noise that is no number" 2 "noise.*number.*'loud'" sample chest --ct --noise loud

grow=(grow ball.obj --method centroid -o t.vtp)
refuses "a ratio out of range" 2 "ratio.*\[0.05, 1\].*7" "${grow[@]}" --set ratio=7
refuses "an angle out of range" 2 "max-angle.*\[0, 180\] deg.*900" "${grow[@]}" --set max-angle=900
refuses "a length in a wrong unit" 2 "min-length.*mm.*'1m'" "${grow[@]}" --set min-length=1m
refuses "a value that is no number" 2 "ratio.*number.*'much'" "${grow[@]}" --set ratio=much
refuses "a value that is not whole" 2 "min-points.*1.5" "${grow[@]}" --set min-points=1.5
refuses "an unknown key" 2 "'ratioo'.*did you mean 'ratio'" "${grow[@]}" --set ratioo=0.4
refuses "no equals sign" 2 "key=value.*'ratio'" "${grow[@]}" --set ratio
refuses "an unknown choice" 2 "containment.*none, ends, branches.*'all'" "${grow[@]}" --set containment=all
refuses "terminals out of range" 2 "terminals.*\[0, 5000000\]|terminals.*5e\+06" "${grow[@]}" --terminals 1e12
refuses "negative points" 2 "points.*-5" "${grow[@]}" --points -5
refuses "a seed that is no number" 2 "seed.*'x'" "${grow[@]}" --seed x
refuses "not a number" 2 "ratio.*'nan'" "${grow[@]}" --set ratio=nan

dla=(grow ball.obj --method dla -o t.vtp)
refuses "shares that do not sum" 2 "share-rul.*sum to 0.*by volume" "${dla[@]}" --set share-rul=0.5
refuses "voxels too large for the particles" 2 "voxels of 20 mm.*choose smaller voxels" "${dla[@]}" --set voxel=20
refuses "voxels that need too much memory" 2 "voxels of 0.001 mm need.*would fit" "${dla[@]}" --set voxel=0.001
refuses "an unknown wall" 2 "wall.*reflect, absorb.*'melt'" "${dla[@]}" --set wall=melt
refuses "a probability out of range" 2 "sticking.*\[0.001, 1\].*0" "${dla[@]}" --set sticking=0
refuses "no particles" 2 "particles.*0" "${dla[@]}" --set particles=0
refuses "points of a method without particles" 2 "points.*centroid.*use --method dla" "${grow[@]}" --points p.vtp
refuses "points that are no VTP" 5 "points.*p.csv.*\.vtp" "${dla[@]}" --points p.csv
refuses "points in the tree's file" 2 "same file.*t.vtp" "${dla[@]}" --points t.vtp
refuses "shares in the outline that do not sum" 2 "sum to 1.7.*sum to 1" outline --upper 0.9
refuses "first airways off the outline" 2 "outside the lung.*smaller seed-x" outline --seed-z 200
refuses "an outline in another format" 5 "png" outline --picture o.jpg

caseName="no command at all"
cases=$((cases + 1))
run
[ "$code" -eq 2 ] || fail "exit code $code, not 2"
grep -q '^Usage: ' "$logs/err" || fail "no usage"
finish
