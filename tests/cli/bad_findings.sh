#!/usr/bin/env bash
# What the damaged files of tests/damaged have found, one case for each.
. "$(dirname "$0")/lib.sh"

ball 60 >ball.obj
mkdir lungs
ball 60 -70 >lungs/right.obj
ball 60 70 >lungs/left.obj
short() { expect "the sentence has $(wc -c <"$logs/err") letters" test "$(wc -c <"$logs/err")" -lt 2000; }

# A pipe that nobody writes to hung every command that reads projects, zip archives or pictures.
mkfifo pipe.pneuma pipe.zip pipe.dcm pipe.stl
refuses "a pipe called project" 3 "pipe.pneuma.* pipe" info pipe.pneuma
refuses "a pipe to grow in" 3 "pipe.pneuma.* pipe" grow pipe.pneuma -o tree.vtp
refuses "a pipe called zip" 3 "pipe.zip" info pipe.zip
refuses "a pipe called slice" 3 "pipe.dcm" import pipe.dcm -o out.nii

# A lobe whose name led nowhere was left out in silence.
fiveBalls lobes
ln -s nowhere.obj lobes/rml2.obj
mv lobes/rml2.obj lobes/rml.obj
refuses "a lobe that is a link to nothing" 3 "rml.obj" grow lobes -o tree.vtp --terminals 20
rm lobes/rml.obj
mkfifo lobes/rml.obj
refuses "a lobe that is a pipe" 3 "rml.obj" grow lobes -o tree.vtp --terminals 20
cp -r lungs some
rm some/left.obj
ln -s left.obj some/left.obj
refuses "a lung that is a link to itself" 3 "left.obj" breathe some -o breath.pvd --frames 2

# PLY: a text whose last line has no end crashed, and so did elements without a property.
succeeds "a surface as PLY" export ball.obj -o ball.ply
awk '$1 == "v" { v = v $2 " " $3 " " $4 "\n"; n++ } $1 == "f" { f = f "3 " $2 - 1 " " $3 - 1 " " $4 - 1 "\n"; m++ }
  END { printf "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n" \
    "element face %d\nproperty list uchar int vertex_indices\nend_header\n%s%s", n, m, v, f }' ball.obj >text.ply
succeeds "a PLY of text" info text.ply
truncate -s -1 text.ply
succeeds "a PLY of text whose last line has no end" info text.ply
awk '/^element face/ { for (i = 0; i < 20; i++) print "element bare 0" } { print }' text.ply >bare.ply
refuses "elements without a property" 4 'bare.ply.*"bare" has no property' info bare.ply

# Sentences that did not say of which file they spoke.
mkdir open
cp lungs/left.obj open/left.obj
sed '$d' lungs/right.obj >open/right.obj
refuses "lungs with a hole do not breathe" 4 "right.obj.*open edges" breathe open -o breath.pvd --frames 2
printf 'v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 3\n' >one.obj
refuses "one triangle cannot be mended" 4 "one.obj.*nothing that encloses" repair one.obj -o mended.stl

# Names that are no UTF-8, as old disks have them, ended commands that write JSON with an internal error.
name=$(printf 'lunge-\344\377')
cp ball.obj "$name.obj"
for side in right left; do cp "lungs/$side.obj" "$side-$name.obj"; done
succeeds "a name that is no UTF-8" grow "$name.obj" -o grown.vtp --terminals 20 --report grown.json
succeeds "lungs whose names are no UTF-8 breathe" breathe "right-$name.obj" "left-$name.obj" -o breath.pvd --frames 2
succeeds "lungs whose names are no UTF-8 have lobes" lobes "right-$name.obj" "left-$name.obj" -o split --spacing 20

# A file's own words made sentences of a megabyte.
long=$(head -c 100000 /dev/zero | tr '\0' k)
echo "{\"schema\": \"pneuma/recipe/1\", \"$long\": 1}" >long.json
refuses "a recipe with a long key" 4 "long.json" run long.json -o nowhere
short
printf 'seconds,pressure_cmH2O,volume_ml\n%s,1,2\n' "$long" >long.csv
refuses "a table with a long value" 4 "long.csv" breathe lungs --fit long.csv -o never.pvd
short

# Yes and no are no numbers.
echo '{"schema": "pneuma/recipe/1", "lungs": {"triangles": true}}' >true.json
refuses "true where a number should be" 2 "true.json.*triangles needs a number" run true.json -o nowhere

# A file with few landmarks was called wrong usage.
printf 'exp_x,exp_y,exp_z,insp_x,insp_y,insp_z\n' >few.csv
for i in 1 2 3 4 5 6; do printf -- '-7%d,%d,%d,-7%d,%d,%d\n' "$i" "$i" "$i" "$i" "$i" $((i + 4)); done >>few.csv
refuses "few landmarks" 4 "of 6 landmarks" estimate --landmarks few.csv -o person.json

# A tree that cannot be read was taken for a surface, and the output was blamed.
: >empty.swc
refuses "an empty tree to export" 4 "empty.swc" export empty.swc -o out.swc

# Airways as long as the sun is far kept growing busy.
printf '1 0 0 0 0 9 -1\n2 0 0 0 -90 9 1\n3 0 1e18 0 -120 5 2\n4 0 -30 0 -120 5 2\n' >far.swc
refuses "airways that end behind the sun" 4 "far.swc.*more than 1 km away" grow ball.obj --central far.swc -o far.vtp

sed 's/1e18/30/; s/ 5 2$/ 1e300 2/' far.swc >wide.swc
refuses "airways as wide as the sky" 4 "wide.swc.*radius of more than 10 m" grow ball.obj --central wide.swc -o far.vtp
succeeds "a tree" grow ball.obj --terminals 20 -o small.json -q
{ printf '\xEF\xBB\xBF' && cat small.json; } >marked.json
succeeds "a tree that begins with a mark of the byte order" export marked.json -o marked.swc -q

# A sentence that comes from deep within says of which file it is.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >right.obj
refuses "a lung of a millimetre" 4 "^pneuma: 'right.obj': the lungs are 1.0* mm long" breathe right.obj -o none.pvd

# Places nowhere near a person.
printf 'Region,Type,X,Y,Z\nRIGHTLUNG,OBLIQUEFISSURE,-70,0,1e300\n' >far.csv
refuses "a fissure farther than the moon" 4 "far.csv.*more than 10,000 km away" lobes lungs --fissures far.csv -o nowhere
finish
