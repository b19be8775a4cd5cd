#!/usr/bin/env bash
# Recorded head poses replayed; to be run under an X server.
# Needs JSON_CHECK (json_check) and SCHEMAS (resources/schemas).
. "$(dirname "$0")/lib.sh"

keeps() { expect "the JSON breaks $1: $("$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$logs/out" 2>&1 | head -n 3)" \
  "$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$logs/out"; }
# member NAME: a number of the report that was printed last.
member() { sed -n "s/^ *\"$1\": \([-0-9.e+]*\),*$/\1/p" "$logs/out" | head -n 1; }
head=time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz
# orbit POSES: a head that goes from the front to the patient's left, 15 ms from pose to pose, looking at the middle.
orbit() {
  awk -v n="$1" -v head="$head" 'BEGIN {
    print head
    for (i = 0; i < n; i++) {
      a = 1.2 * i / n; h = a / 2; s = sqrt(0.5)
      printf "%.6f,%.4f,%.4f,0,%.9f,%.9f,%.9f,%.9f\n", 5 + 0.015 * i, 700 * sin(a), -700 * cos(a), s * cos(h), s * cos(h), s * sin(h), s * sin(h)
    }
  }'
}

fiveBalls lobes
orbit 41 >poses.csv
succeeds "a replay" render lobes --pose poses.csv --size 200x160 --no-annotations --json -o last.png
keeps replay
expect "the last picture is no PNG" grep -q PNG last.png
expect "there are not 41 poses" test "$(member poses)" = 41
expect "poses were lost" test "$(member poses)" -eq $(($(member shown) + $(member dropped) + $(member between_ticks)))
expect "there are not 41 ticks" test "$(member ticks)" = 41
expect "the latency is no time" awk -v mean="$(member mean)" -v max="$(member max)" 'BEGIN { exit mean > 0 && max >= mean ? 0 : 1 }'
expect "a headset is claimed" grep -q '"headset": false' "$logs/out"

# The last pose is always drawn, and from there one sees the same however fast the machine is.
(echo $head; tail -n 1 poses.csv) >end.csv
succeeds "the last picture is that of the last pose" render lobes --pose end.csv --size 200x160 --no-annotations -o end.png --reference last.png
prints '1 poses: 1 shown, 0 dropped, 0 between ticks'
prints 'no headset was driven'
expect "the picture of the last pose is another" cmp end.png last.png
# By the named view from the front: about the same as by a head that is there.
(echo $head; sed -n 2p poses.csv) >first.csv
succeeds "the first pose" render lobes --pose first.csv --size 200x160 --no-annotations -o first.png
expect "the head does not move" test "$(cksum <first.png)" != "$(cksum <last.png)"

# Three poses in a tick: the one in the middle of each is never due. One a second: all are in time.
awk -v head="$head" 'BEGIN { print head; for (i = 0; i < 31; i++) printf "%.3f,0,-700,0,0.70710678,0.70710678,0,0\n", i / 1000 }' >fast.csv
succeeds "a record faster than ticks" render lobes --pose fast.csv --rate 100 --size 64x48 --json -o fast.png
keeps replay
expect "27 of 31 poses are not between ticks" test "$(member between_ticks)" = 27
succeeds "slow ticks" render lobes --pose poses.csv --rate 2 --size 64x48 --json -o slow.png
expect "a pose was dropped at two a second" test "$(member dropped)" = 0
expect "there are not three ticks" test "$(member ticks)" = 3

# So large that a machine without a graphics card drops poses: the film lasts as long all the same.
succeeds "a film for two eyes" render lobes --pose poses.csv --size 1200x600 --stereo side-by-side -o film.ogv
prints 'film.ogv: [0-9]+ pictures, 67 a second'
expect "the film is shorter than the replay" test "$(sed -n 's/^film.ogv: \([0-9,]*\) pictures.*/\1/p' "$logs/out" | tr -d ,)" -ge 41
expect "the film is no Ogg" test "$(head -c 4 film.ogv)" = OggS
for stereo in anaglyph crossed; do
  succeeds "for two eyes, $stereo" render lobes --pose first.csv --size 200x80 --stereo "$stereo" -q -o "$stereo.png"
  expect "something was said" test ! -s "$logs/out"
done

succeeds "a chest" sample chest --cell 5mm -q
succeeds "a breath" breathe chest -o breath.pvd --scenario vital-capacity --frames 4 -q
# Frames at 0, 2, 4 and 6 s. From 700 mm in front of the chest's middle; what a breath is like at its start, and 4 s on.
echo "$head
0,0,-700,0,0.70710678,0.70710678,0,0" >still.csv
succeeds "the start of a breath" render breath.pvd --pose still.csv --size 160x120 --no-annotations -q -o start.png
succeeds "a later moment of it" render breath.pvd --pose still.csv --time 4 --size 160x120 --no-annotations -q -o later.png
expect "the lungs do not breathe" test "$(cksum <start.png)" != "$(cksum <later.png)"
echo "0.5,0,-700,0,0.70710678,0.70710678,0,0" >>still.csv
succeeds "the breath goes on with the poses" render breath.pvd --pose still.csv --time 2.75 --size 160x120 --no-annotations -q -o on.png
expect "half a second after 2.75 s is not nearest to 4 s" cmp on.png later.png
succeeds "a breath and a head that moves" render breath.pvd --pose poses.csv --size 160x120 -o breath.ogv

poses() { printf '%s\n' "$@" >bad.csv; }
bad() { refuses "$1" 4 "$2" render lobes --pose bad.csv -o none.png; }
poses "$head" 0,0,0,0,1,0,0,0 0,0,0,0,1,0,0,0
bad "times that stand" 'bad.csv., line 3: the time 0 s does not come after'
poses "$head" 1,0,0,0,1,0,0,0 0.5,0,0,0,1,0,0,0
bad "times that go back" 'bad.csv., line 3: the time 0.5 s'
poses "$head" 0,0,0,0,0,0,0,0
bad "no orientation" 'bad.csv., line 2: the quaternion .* length 0'
poses "$head" 0,0,0,0,1,1,0,0
bad "no unit quaternion" 'bad.csv., line 2: the quaternion .* length 1.41'
poses "$head" 0,nan,0,0,1,0,0,0
bad "no number" 'bad.csv., line 2, column x_mm: "nan" is not a number'
poses "$head" 0,0,1e6,0,1,0,0,0
bad "a head far away" 'bad.csv., line 2: .*mm'
poses "$head" 0,0,0,0,1,0,0,0 15000,0,0,0,1,0,0,0
bad "milliseconds" 'bad.csv., line 3: .*in seconds'
poses "$head"
bad "no pose" 'bad.csv. holds no pose'
poses time_s,x_mm,y_mm,z_mm,qx,qy,qz 0,0,0,0,0,0,1
bad "a column that is missing" 'bad.csv. has no column "qw"'
: >bad.csv
bad "an empty file" 'bad.csv. holds no table'
refuses "poses that are not there" 3 'gone.csv' render lobes --pose gone.csv -o none.png
refuses "a rate below 0" 2 'rate' render lobes --pose poses.csv --rate -1 -o none.png
mkdir pieces
succeeds "a breath in pieces" breathe chest -o pieces/breath.pvd --frames 2 --largest-file 100K -q
refuses "a picture of a breath in pieces" 5 "frame in pieces for ParaView.*larger --largest-file" render pieces/breath.pvd -o none.png
refuses "a film's rate that is not whole" 2 'whole number' render breath.pvd --rate 12.5 -o none.ogv
refuses "a view besides" 2 'leave --view or --pose out' render lobes --pose poses.csv --view left -o none.png
refuses "poses again and again" 2 'leave --repeat' render lobes --pose poses.csv --repeat 2 -o none.ogv
refuses "slices" 2 'no CT and no slices' render lobes --pose poses.csv --slice axial -o none.png
refuses "a report without poses" 2 'give --pose' render lobes --json -o none.png
refuses "a film that is there" 6 'film.ogv.*exists' render lobes --pose poses.csv -o film.ogv
refuses "nothing that is drawn there" 5 'png' render lobes --pose poses.csv -o none.jpg
DISPLAY= refuses "no display" 10 'xvfb-run' render lobes --pose poses.csv -o none.png
finish
