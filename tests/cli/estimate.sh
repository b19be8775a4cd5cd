#!/usr/bin/env bash
# Constants of motion fitted to a person: lungs and landmarks made by known constants, bad input.
# Needs JSON_CHECK (json_check) and SCHEMAS (resources/schemas).
. "$(dirname "$0")/lib.sh"

keeps() { expect "the JSON breaks $1: $("$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$logs/out" 2>&1 | head -n 3)" \
  "$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$logs/out"; }

# egg SCALE X: an egg of a lung's size about (X, 10, 30), everything scaled about the origin.
egg() {
  awk -v s="$1" -v x="$2" 'BEGIN {
    rings = 16; around = 24; pi = atan2(0, -1)
    printf "v %.9g %.9g %.9g\n", s * x, s * 10, s * 160
    for (r = 1; r < rings; r++) for (k = 0; k < around; k++)
      printf "v %.9g %.9g %.9g\n", s * (x + 60 * sin(pi * r / rings) * cos(2 * pi * k / around)),
        s * (10 + 95 * sin(pi * r / rings) * sin(2 * pi * k / around)), s * (30 + 130 * cos(pi * r / rings))
    printf "v %.9g %.9g %.9g\n", s * x, s * 10, s * -100
    for (k = 0; k < around; k++) {
      n = (k + 1) % around
      print "f", 1, 2 + k, 2 + n
      for (r = 0; r < rings - 2; r++) {
        a = 2 + r * around
        print "f", a + k, a + around + k, a + around + n
        print "f", a + k, a + around + n, a + n
      }
      print "f", 2 + (rings - 2) * around + k, 2 + (rings - 1) * around, 2 + (rings - 2) * around + n
    }
  }'
}

mkdir rest later
for side in right:-75 left:75; do
  egg 1 "${side#*:}" >"rest/${side%:*}.obj"
  egg 1.1 "${side#*:}" >"later/${side%:*}.obj"  # a strain of 0.1
done

# 90 places in both lungs, moved by u_k = 0.1 L_k sum a_kj q_j with known a, and a shift.
awk 'BEGIN {
  split("0.3 -0.2 0.1 0.4 0.5 0.6 -0.1 -0.3 0.9", a, " ")
  print "exp_x,exp_y,exp_z,insp_x,insp_y,insp_z"
  for (n = 0; n < 90; n++) {
    side = n % 2 == 0 ? -1 : 1
    x = 75 * side + 35 * sin(n * 1.7); y = 10 + 55 * sin(n * 2.9 + 1); z = 30 + 75 * sin(n * 0.7 + 2)
    q[1] = side < 0 ? (-15 - x) / 120 : (x - 15) / 120; q[2] = (105 - y) / 190; q[3] = (160 - z) / 260
    u[1] = u[2] = u[3] = 0
    for (k = 1; k <= 3; k++) for (j = 1; j <= 3; j++) u[k] += a[3 * (k - 1) + j] * q[j]
    printf "%.6f,%.6f,%.6f,%.6f,%.6f,%.6f\n", x, y, z,
      x + side * 0.1 * 120 * u[1] + 2, y - 0.1 * 190 * u[2] - 3, z - 0.1 * 260 * u[3] + 5
  }
}' >marks.csv

# constants: the numbers of the last report in a line, rounded.
constants() { awk '/"value": .*,/ && seen { printf "%s%.3f", sep, $2; sep = " " } /"constants"/ { seen = 1 } /"shift_mm"/ { seen = 0 }' "$1"; }
truth="0.300 -0.200 0.100 0.400 0.500 0.600 -0.100 -0.300 0.900"

succeeds "constants of a person" estimate rest --landmarks marks.csv --later later --prior 0 --surface-weight 0 \
  --hold-out 0.5 -o person.json --json
keeps estimate
cp "$logs/out" printed
expect "the file is not what was printed" cmp person.json printed
expect "the constants are not those of the landmarks: $(constants person.json)" test "$(constants person.json)" = "$truth"
expect "45 landmarks are not held out" grep -q '"held_out": 45' person.json
expect "landmarks that were not used are missed" awk '/"these constants"/ { seen = 1 } seen && /"held_out"/ { held = 1 } held && /"mean_mm"/ { exit $2 + 0 < 1e-3 ? 0 : 1 }' person.json
succeeds "the same by threads and again" estimate rest --landmarks marks.csv --later later --prior 0 --surface-weight 0 \
  --hold-out 0.5 -o again.json -j 1 -q
expect "another number of threads gives another file" cmp person.json again.json
succeeds "a table" estimate rest --landmarks marks.csv --later later --every 5
prints "^form 'deep' fitted to 72 landmarks, 18 held out"
prints '^  X qX +0\.[0-9]{3} +0\.[0-9]{3}$'
prints '^  no motion +[0-9.]+ \+- '
prints '^  1 +left +[0-9.]+ +[0-9.]+$'
succeeds "the published form" estimate rest --landmarks marks.csv --later later --form published --json
keeps estimate
succeeds "quiet breathing without surfaces" estimate --landmarks marks.csv --form quiet
expect "it does not warn of boxes" grep -q 'boxes are those of the landmarks' "$logs/err"
succeeds "a volume in place of a surface" estimate rest --landmarks marks.csv --gain 2054ml --hold-out 0
expect "it does not warn that nothing was held out" grep -q 'No landmark was held out' "$logs/err"

# The same landmarks as voxels of a scan whose slices go down.
head -c 1000000 /dev/zero >scan.raw
printf '%s\n' 'ObjectType = Image' 'NDims = 3' 'DimSize = 100 100 100' 'ElementSpacing = 3 4 5' 'Offset = -150 -200 260' \
  'TransformMatrix = 1 0 0 0 1 0 0 0 -1' 'ElementType = MET_UCHAR' 'ElementDataFile = scan.raw' >scan.mhd
awk -F, 'NR > 1 { printf "%.6f %.6f %.6f\n", ($1 + 150) / 3 + 1, ($2 + 200) / 4 + 1, (260 - $3) / 5 + 1 }' marks.csv >rest.txt
awk -F, 'NR > 1 { printf "%.6f %.6f %.6f\n", ($4 + 150) / 3 + 1, ($5 + 200) / 4 + 1, (260 - $6) / 5 + 1 }' marks.csv >moved.txt
paste -d' ' rest.txt moved.txt >six.txt
succeeds "voxels from two files" estimate rest --landmarks rest.txt --landmarks moved.txt --voxels-of scan.mhd \
  --later later --prior 0 --surface-weight 0 -o voxels.json -q
expect "voxels give other constants: $(constants voxels.json)" test "$(constants voxels.json)" = "$truth"
succeeds "voxels from one file" estimate rest --landmarks six.txt --voxels-of scan.mhd --voxels-of scan.mhd \
  --later later --prior 0 --surface-weight 0 -o six.json -q
expect "six columns give other constants" test "$(constants six.json)" = "$truth"

# Lungs that breathe by them.
succeeds "breathing by them" breathe rest -o breath.pvd --frames 2 --tidal 1500 --constants person.json --json
keeps breathe
prints '"fitted_landmarks": 45'
prints 'fitted to 45 landmarks of this person .form .deep.., off on 45 others by a mean of 0.0 mm'
succeeds "breathing as people do" breathe rest -o people.pvd --frames 2 --tidal 1500
expect "both move alike" test "$(cksum <breath_0001.vtp)" != "$(cksum <people_0001.vtp)"
succeeds "a breath of another size" breathe rest -o small.pvd --frames 2 --tidal 300 --constants person.json
expect "it does not warn" grep -q 'quiet and deep breathing move lungs in different ways' "$logs/err"
printf '{"schema": "pneuma/breathe/1"}' >other.json
sed 's/"value": 0.9.*,/"value": "x",/; s/"value": 0.89.*,/"value": "x",/' person.json >word.json
refuses "a report that is another" 4 "other.json. holds no constants of a person" breathe rest -o none.pvd --constants other.json
refuses "landmarks for constants" 4 "marks.csv. holds no constants of a person" breathe rest -o none.pvd --constants marks.csv
refuses "constants that are words" 4 "word.json. is damaged" breathe rest -o none.pvd --constants word.json
refuses "constants that are not there" 3 "gone.json" breathe rest -o none.pvd --constants gone.json
refuses "constants and those of people" 2 "Leave one of the two out" breathe rest -o none.pvd --constants person.json --motion deep
refuses "constants for a model without any" 2 "Leave one of the two out" breathe rest -o none.pvd --constants person.json --model published

refuses "surfaces alone" 2 "surfaces alone do not tell" estimate rest --later later -o none.json
refuses "nothing" 2 "give landmarks" estimate -o none.json
head -n 12 marks.csv >few.csv
refuses "eleven landmarks" 4 "12 at least" estimate rest --landmarks few.csv --hold-out 0 -o none.json
awk -F, -v OFS=, 'NR > 1 { $3 += 900 } 1' marks.csv >far.csv
refuses "landmarks of somebody else" 4 "landmark 1 lies [0-9]+ mm outside" estimate rest --landmarks far.csv -o none.json
printf '1 1 1 1 1 101\n' >far.txt
refuses "voxels of another scan" 4 "line [0-9]+: voxel .* lies outside" estimate rest --landmarks far.txt --voxels-of scan.mhd -o none.json
refuses "lungs that shrink" 4 "has to be the larger one" estimate later --landmarks marks.csv --later rest -o none.json
refuses "a later lung that lacks" 4 "later surface 1 holds no left lung" estimate rest --landmarks marks.csv --later later/right.obj -o none.json
refuses "three files of landmarks" 2 "one file, or two" estimate rest --landmarks marks.csv --landmarks marks.csv --landmarks marks.csv
refuses "landmarks that are not there" 3 "gone.csv" estimate rest --landmarks gone.csv -o none.json
refuses "too few held out" 2 "three or more" estimate rest --landmarks marks.csv --every 40 -o none.json
refuses "both ways of holding out" 2 "every.*hold-out|hold-out.*every" estimate rest --landmarks marks.csv --every 5 --hold-out 0.5
refuses "a form that is none" 2 "form.*published" estimate rest --landmarks marks.csv --form cubic
refuses "another format" 5 "end in .json" estimate rest --landmarks marks.csv -o none.csv
refuses "a file that is there" 6 "exists" estimate rest --landmarks marks.csv -o person.json
finish
