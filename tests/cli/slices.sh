#!/usr/bin/env bash
# Slices of CTs from the command line; must work without a display.
. "$(dirname "$0")/lib.sh"
unset DISPLAY

# volume TYPE INSIDE OUTSIDE [ORIGIN]: an NRRD of 20 x 16 x 12 voxels of 2 x 2 x 3 mm with a ball of INSIDE.
volume() {
  printf 'NRRD0004\ntype: %s\ndimension: 3\nspace: left-posterior-superior\nsizes: 20 16 12\n' "$1"
  printf 'space directions: (2,0,0) (0,2,0) (0,0,3)\nkinds: domain domain domain\nendian: little\n'
  printf 'encoding: raw\nspace origin: (%s)\n\n' "${4:--19,-15,-16.5}"
  printf '%b' "$(awk -v inside="$2" -v outside="$3" -v bytes="$([ "$1" = uint8 ] && echo 1 || echo 2)" 'BEGIN {
    for (k = 0; k < 12; k++) for (j = 0; j < 16; j++) for (i = 0; i < 20; i++) {
      x = 2 * i - 19; y = 2 * j - 15; z = 3 * k - 16.5
      value = x * x + y * y + z * z < 120 ? inside : outside
      if (value < 0) value += 65536
      printf "\\0%o", value % 256
      if (bytes == 2) printf "\\0%o", int(value / 256)
    }
  }')"
}

volume int16 -850 40 >ct.nrrd
volume uint8 10 0 >labels.nrrd
volume uint8 10 0 500,500,500 >elsewhere.nrrd
ball 40 >rul.obj

# size FILE: of a PNG, as WIDTHxHEIGHT.
size() {
  od -An -tu1 -j 16 -N 8 "$1" | awk '{ print (($1 * 256 + $2) * 256 + $3) * 256 + $4 "x" (($5 * 256 + $6) * 256 + $7) * 256 + $8 }'
}

succeeds "the middle slices" render ct.nrrd --size 604x200 -o all.png
expect "three slices are not 604 wide" test "$(size all.png)" = 604x200
succeeds "the same by its name" render ct.nrrd --slice all --size 604x200 -o same.png --reference all.png
expect "all is not the default" cmp all.png same.png
succeeds "one slice" render ct.nrrd --slice axial --size 200x150 -o axial.png
expect "one slice is not as large as asked for" test "$(size axial.png)" = 200x150
succeeds "its number" render ct.nrrd --slice axial:7 --size 200x150 -o number.png
expect "the seventh of twelve is not the middle one" cmp axial.png number.png
succeeds "its position" render ct.nrrd --slice axial:1.5mm --size 200x150 -o position.png
expect "S 1.5 mm is not the seventh" cmp axial.png position.png
succeeds "its letter" render ct.nrrd --slice axial:I13.5mm --size 200x150 -o letter.png
succeeds "the same with a sign" render ct.nrrd --slice axial:-13.5mm --size 200x150 -o sign.png
expect "I is not down" cmp letter.png sign.png
succeeds "four slices" render ct.nrrd --slice axial:2 --slice axial:6 --slice coronal:P5mm --slice sagittal --size 402x302 \
  -o four.png
expect "four slices are not a square" test "$(size four.png)" = 402x302
for window in lung lung-soft mediastinum bone emphysema 1200/-450; do
  succeeds "window $window" render ct.nrrd --slice axial --window "$window" --size 200x150 -o "w_${window/\//_}.png"
done
expect "bone looks like lung" test "$(cmp w_bone.png w_lung.png | wc -l)" -gt 0
succeeds "labels" render ct.nrrd --labels labels.nrrd --slice axial --size 200x150 -o labels.png
volume int16 40 -850 >dense.nrrd
succeeds "labels of somebody else" render dense.nrrd --labels labels.nrrd --slice axial --size 200x150 -o foreign.png
expect "labels that fit no lung are not warned of" grep -q 'only 0 %.*another person' "$logs/err"
succeeds "labels among the inputs" render ct.nrrd labels.nrrd --slice axial --size 200x150 -o inputs.png
expect "an input is no label" cmp labels.png inputs.png
succeeds "outlines" render ct.nrrd --labels labels.nrrd --outline --slice axial --size 200x150 -o outline.png
succeeds "dense labels" render ct.nrrd --labels labels.nrrd --opacity 0.9 --slice axial --size 200x150 -o dense.png
succeeds "a mark" render ct.nrrd --mark 0,0,1.5 --slice axial --size 200x150 -o mark.png
succeeds "no letters" render ct.nrrd --no-annotations --slice axial --size 200x150 -o bare.png
for other in labels outline dense mark bare; do
  caseName="$other looks like the plain slice"
  cases=$((cases + 1))
  cmp -s axial.png "$other.png" && fail "no difference"
done

refuses "a plane that is none" 2 "transverse.*axial" render ct.nrrd --slice transverse -o x.png
refuses "a slice that is none" 2 "axial:0" render ct.nrrd --slice axial:0 -o x.png
refuses "half a slice" 2 "axial:2.5" render ct.nrrd --slice axial:2.5 -o x.png
refuses "a slice above the last" 2 "12 axial slices" render ct.nrrd --slice axial:13 -o x.png
refuses "a place outside" 2 "A 200.0 mm.*A 15.0 mm to P 15.0 mm" render ct.nrrd --slice coronal:A200mm -o x.png
refuses "a letter of another axis" 2 "coronal:L5mm" render ct.nrrd --slice coronal:L5mm -o x.png
refuses "a window that is none" 2 "mediastinum" render ct.nrrd --window medistinum -o x.png
refuses "a mark that is none" 2 "X,Y,Z" render ct.nrrd --mark 1,2 -o x.png
refuses "no room" 2 "room" render ct.nrrd --slice all --slice all --size 40x40 -o x.png
refuses "labels of another image" 4 "elsewhere" render ct.nrrd --labels elsewhere.nrrd -o x.png
refuses "two CTs" 4 "one at a time" render ct.nrrd ct.nrrd -o x.png
refuses "labels that are missing" 3 "missing.nii" render ct.nrrd --labels missing.nii -o x.png
refuses "slices of a surface" 4 "need a CT" render rul.obj --slice axial -o x.png
refuses "a surface without a display" 10 "xvfb-run" render rul.obj -o x.png
head -c 3000 ct.nrrd >short.nrrd
refuses "a CT cut short" 4 "short.nrrd" render short.nrrd -o x.png
finish
