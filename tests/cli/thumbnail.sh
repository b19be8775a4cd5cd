#!/usr/bin/env bash
# The picture of a project, as file managers ask for it: without a display, without opening the project.
. "$(dirname "$0")/lib.sh"
unset DISPLAY WAYLAND_DISPLAY

# side OFFSET: bytes 0-3 of IHDR's width (16) or height (20) of small.png.
side() { od -An -t u1 -j "$1" -N 4 small.png | awk '{ print ($1 * 256 + $2) * 65536 + $3 * 256 + $4 }'; }
pack() { (cd raw && cmake -E tar cf "../$1" --format=zip "${@:2}"); }

cp "$(dirname "$0")/../data/project_version_1.pneuma" "a case.pneuma"
succeeds "the picture of a project" thumbnail "a case.pneuma" -o small.png --size 100
prints '^small.png: 100 x [0-9]+ pixels'
expect "it is not 100 pixels wide" test "$(side 16)" -eq 100
expect "it is higher than 100 pixels" test "$(side 20)" -le 100
succeeds "a picture that needs no more room than it has" thumbnail "a case.pneuma" -o small.png --size 4096 --force --quiet
expect "something was said" test ! -s "$logs/out"
expect "the picture was made larger than it is" test "$(side 16)" -le 320

# As a file manager does: the file is there before, empty, and the command line is the thumbnailer's.
: >asked.png
line=$(sed -n 's/^Exec=pneuma //p' "$(dirname "$0")/../../packaging/linux/org.pneuma.Pneuma.thumbnailer")
expect "there is no command line" test -n "$line"
read -ra words <<<"$line"
words=("${words[@]/\%i/a case.pneuma}")
words=("${words[@]/\%o/asked.png}")
succeeds "the file manager's own words" "${words[@]/\%s/128}"
expect "nothing was written" test -s asked.png

mkdir raw
expect "it is no sound zip archive" eval "(cd raw && cmake -E tar xf '../a case.pneuma')"
pack plain.pneuma project.json trees
refuses "a project without a picture" 5 "holds no picture" thumbnail plain.pneuma -o none.png
pack none.pneuma trees thumbnail.png
succeeds "whatever else it holds" thumbnail none.pneuma -o other.png
pack letter.pneuma trees
refuses "no project" 4 "holds no project.json" thumbnail letter.pneuma -o none.png
printf 'not a picture' >raw/thumbnail.png
pack text.pneuma project.json thumbnail.png
refuses "a picture that is none" 4 "picture in 'text.pneuma' cannot be used: it is not a PNG" thumbnail text.pneuma -o none.png
head -c 20000 "a case.pneuma" >cut.pneuma
refuses "a project that is cut off" 4 "damaged" thumbnail cut.pneuma -o none.png
echo hello >hello.pneuma
refuses "no archive" 4 "hello.pneuma" thumbnail hello.pneuma -o none.png
refuses "a project that is not there" 3 "gone.pneuma" thumbnail gone.pneuma -o none.png
refuses "a picture that is there already" 6 "small.png" thumbnail "a case.pneuma" -o small.png
refuses "a folder that is not there" 6 "nowhere" thumbnail "a case.pneuma" -o nowhere/small.png
succeeds "a name as file managers of MATE and Cinnamon choose them" thumbnail "a case.pneuma" -o .mate_desktop_thumbnail.X3kQ9z
expect "nothing was written to it" test -s .mate_desktop_thumbnail.X3kQ9z
refuses "another format" 5 "png" thumbnail "a case.pneuma" -o small.jpg
refuses "a size that cannot be" 2 "size" thumbnail "a case.pneuma" -o none.png --size 5
refuses "no output" 2 "output" thumbnail "a case.pneuma"

finish
