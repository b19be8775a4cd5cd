#!/usr/bin/env bash
# Environments that nobody has at a desk: no home, no display, decimal commas, closed or full standard
# files, a working folder that is gone, odd names, tight limits. The same bytes, or one sentence.
. "$(dirname "$0")/lib.sh"
. "$here/inputs.sh"
unset DISPLAY
shopt -s nullglob
quick=(--method centroid --terminals 30)

worksAtMore() {
  for file in in/airways.vtp:tree.swc in/airways.vtp:tree.json in/chest/rul.stl:rul.obj; do
    "$@" "$PNEUMA" export "$PWD/${file%:*}" -o "$PWD/out/${file#*:}" -q || return
  done
  "$@" "$PNEUMA" import "$PWD/in/chest/dicom" -o "$PWD/out/ct.nrrd" -q &&
    "$@" "$PNEUMA" lobes "$PWD/in/chest" -o "$PWD/out/lobes" --spacing 10 --fractions 40.5,12.9,46.6 -q &&
    "$@" "$PNEUMA" breathe "$PWD/in/chest" -o "$PWD/out/breath.pvd" --gltf "$PWD/out/breath.glb" --frames 2 -q &&
    "$@" "$PNEUMA" export "$PWD/in/breathing.pneuma" --preset tree -o "$PWD/out/preset" -q
}

# works NAME COMMAND...: the command, which runs pneuma's arguments after it, makes what it should.
works() {
  caseName=$1
  shift
  local -a before=("$@")
  cases=$((cases + 1))
  rm -rf out
  mkdir out
  local failuresBefore=$failures
  {
    "${before[@]}" "$PNEUMA" grow "$PWD/in/ball.obj" "${quick[@]}" -o "$PWD/out/tree.vtp" -q &&
      "${before[@]}" "$PNEUMA" export "$PWD/in/airways.vtp" -o "$PWD/out/tree.csv" -q &&
      "${before[@]}" "$PNEUMA" export "$PWD/in/chest/rul.stl" -o "$PWD/out/rul.ply" -q &&
      "${before[@]}" "$PNEUMA" fissures "$PWD/in/chest" --points 5 -o "$PWD/out/points.mrk.json" -q &&
      { [ "$full" -eq 0 ] || worksAtMore "${before[@]}"; }
  } >"$logs/out" 2>"$logs/err"
  code=$?
  [ "$code" -eq 0 ] || fail "exit code $code"
  [ -s "$logs/err" ] && fail "it says something"
  (cd out && find . -type f ! -name lobes.json ! -name breath.json | sort | xargs sha256sum) >"$logs/sums"
  [ -s "$logs/wanted" ] || cp "$logs/sums" "$logs/wanted"
  cmp -s "$logs/sums" "$logs/wanted" || fail "other bytes: $(diff "$logs/sums" "$logs/wanted" | cut -c 68- | sort -u | tr '\n' ' ')"
  [ "$failures" -eq "$failuresBefore" ]
}
# Closed files, for works.
closedInput() { "$@" <&-; }
closedOutput() { "$@" >&-; }
closedErrors() { "$@" 2>&-; }
closedAll() { "$@" <&- >&- 2>&-; }
tightStack() (ulimit -s 512 && exec "$@")
endlessStack() (ulimit -s unlimited && exec "$@")
fewFiles() (ulimit -n 24 && exec "$@")
fromNowhere() (mkdir gone && cd gone && rmdir ../gone && exec "$@")

works "as usual" env
works "no environment at all" env -i
works "no home" env -u HOME
works "a home that is not there" env HOME=/nowhere/at/all XDG_CONFIG_HOME=/nowhere XDG_CACHE_HOME= XDG_RUNTIME_DIR=/nowhere
works "a home that is a file" env HOME=/dev/null
works "a home that takes no files" env HOME=/proc XDG_CONFIG_HOME=/proc XDG_CACHE_HOME=/proc XDG_DATA_HOME=/proc
works "garbage for folders" env HOME=$'\xff\n' XDG_CONFIG_HOME=relative XDG_RUNTIME_DIR=$'\x01' XDG_DATA_DIRS=:::
works "no folder for temporary files" env TMPDIR=/nowhere TMP=/nowhere TEMP=
works "an unknown locale" env LC_ALL=xx_YY.UTF-8 LANG=$'\xff' LANGUAGE=de
works "standard input is closed" closedInput
works "standard output is closed" closedOutput
works "standard error is closed" closedErrors
works "all of them are closed" closedAll
works "a small stack" tightStack
works "an endless stack" endlessStack
works "few open files" fewFiles
caseName="few open files, and many that are replaced"
cases=$((cases + 2))
made breathe in/chest -o out/breath.pvd --frames 30
(ulimit -n 24 && exec "$PNEUMA" breathe in/chest -o out/breath.pvd --frames 30 -q -f) >"$logs/out" 2>"$logs/err" || fail "exit code $?"
works "a working folder that is gone" fromNowhere
works "a display that is none" env DISPLAY=:none WAYLAND_DISPLAY=none
works "names of a display without permission" env DISPLAY=localhost:99.99
for locale in de_DE tr_TR; do
  if localedef -i "$locale" -f UTF-8 "$logs/$locale.UTF-8" >/dev/null 2>&1; then
    works "the locale $locale" env LOCPATH="$logs" LC_ALL=$locale.UTF-8 LANG=$locale.UTF-8
  else
    echo "SKIPPED: the locale $locale, which this system cannot make"
  fi
done

# What is printed has dots, too, and no grouping.
"$PNEUMA" measure in/tree.swc >"$logs/plain"
if [ -d "$logs/de_DE.UTF-8" ]; then
  caseName="a table with decimal commas around"
  cases=$((cases + 1))
  env LOCPATH="$logs" LC_ALL=de_DE.UTF-8 "$PNEUMA" measure in/tree.swc >"$logs/out" 2>"$logs/err"
  cmp -s "$logs/out" "$logs/plain" || fail "the table differs"
fi
TMPDIR=$PWD/nowhere refuses "a report without OpenGL" 10 "no picture|display" render in/ball.obj -o out/ball.png
(cd in/chest/dicom && cmake -E tar cf ../../chest.zip --format=zip -- *)
TMPDIR=$PWD/nowhere refuses "an archive without a folder for temporary files" 6 "temporary" import in/chest.zip -o out/zip.nrrd

# Results that nobody gets: 6, never success; and no file takes the place of standard output.
prints_=("version" "help" "help grow" "completion bash" "doctor" "doctor --json" "info in/ball.obj" "info in/ball.obj --json"
  "info in/chest/ct.nii.gz --json" "measure in/tree.swc" "measure in/tree.swc --json" "measure in/tree.swc --csv"
  "compare in/tree.swc in/other.swc" "compare in/tree.swc in/other.swc --json" "study in/ball.obj ${quick[*]} --seeds 2"
  "outline --particles 200 --json" "check out/lobes --json" "estimate --landmarks in/landmarks.csv --json"
  "grow in/ball.obj ${quick[*]} -o out/closed.vtp -f --json" "repair in/ball.obj -o out/closed.stl -f --json"
  "export in/ball.obj -o out/closed.obj -f --json" "sample out/closed --cell 6 -f --json" "help --man" "info in/case.pneuma --json"
  "lobes in/chest -o out/closed.lobes --spacing 10 -f --json" "segment in/chest/ct.nii.gz -o out/closed.nii.gz -f --json"
  "run in/recipe.json -o out/closed.run -f --json" "import in/chest/ct.nii.gz -o out/closed.nrrd -f --json"
  "breathe in/chest -o out/closed.pvd --frames 2 -f --json" "fissures in/chest --points 5 -o out/closed.json -f --json")
cheap="^(version|help|info in/ball|measure|compare .*json|outline|grow|export)"
for line in "${prints_[@]}"; do
  [ "$full" -eq 1 ] || [[ $line =~ $cheap ]] || continue
  read -ra arguments <<<"$line"
  run "${arguments[@]}"
  [ -s "$logs/out" ] || continue # it prints nothing
  for where in full closed pipe; do
    caseName="standard output is $where: $line"
    cases=$((cases + 1))
    find out -name 'closed*' -exec rm -rf {} +
    case $where in
      full) "$PNEUMA" "${arguments[@]}" >/dev/full 2>"$logs/err" ;;
      closed) "$PNEUMA" "${arguments[@]}" >&- 2>"$logs/err" ;;
      pipe) (trap '' PIPE; "$PNEUMA" "${arguments[@]}" 2>"$logs/err"; echo $? >"$logs/code") | sleep 0 ;;
    esac
    code=$?
    [ $where = pipe ] && code=$(cat "$logs/code")
    # A pipe may take what it gets before its other end goes.
    [ "$code" -eq 6 ] || { [ $where = pipe ] && [ "$code" -eq 0 ]; } || fail "exit code $code, not 6"
    [ "$code" -eq 0 ] || grep -q '^pneuma: .*standard output' "$logs/err" || fail "it does not say so"
    find out -name 'closed*' -type f -print0 | xargs -0 -r grep -l '"schema":' >"$logs/mixed"
    for file in $(cat "$logs/mixed"); do
      [[ $file == *.json ]] || fail "the result is in $file"
    done
  done
done

# Names of every kind, for what is read and what is written: the same bytes as under a plain name.
succeeds "a plain name" grow in/ball.obj "${quick[@]}" -o out/plain.swc --report out/plain.json -q
long=$(printf 'n%.0s' {1..251})
names_=("two  blanks   doubled" " blank at the ends " $'a new\nline' $'a tab\tand a bell\a' "Größe ß ñ 肺" $'invalid \xff\xfe\xc3' "it's \"quoted\""
  'percent %s%n%d $HOME `id` ;&|' "a:colon" "#hash?query=1" "back\\slash" "..." "*" "$long")
for odd in "${names_[@]}"; do
  [ "$full" -eq 1 ] || [[ $odd == *'  '* || $odd == *$'\n'* || $odd == *$'\xff'* || $odd == n* ]] || continue
  mkdir -p "in/$odd" "out/$odd"
  cp in/ball.obj "in/$odd/$odd.obj"
  succeeds "a file named '${odd:0:40}'" grow "in/$odd/$odd.obj" "${quick[@]}" -o "out/$odd/$odd.swc" --report "out/$odd/r.json" --json
  cmp -s "out/$odd/$odd.swc" out/plain.swc || fail "the tree differs"
  expect "the report is no JSON" "$JSON_CHECK" "$SCHEMAS/growth.schema.json" "out/$odd/r.json"
  expect "the result is no JSON" "$JSON_CHECK" "$SCHEMAS/growth.schema.json" "$logs/out"
  succeeds "its measures" measure "out/$odd/$odd.swc" --json
  succeeds "what is in it" info "in/$odd/$odd.obj" --json
  expect "that is no JSON" "$JSON_CHECK" "$SCHEMAS/info.schema.json" "$logs/out"
  refuses "it is there already, '${odd:0:40}'" 6 "exists" grow "in/$odd/$odd.obj" "${quick[@]}" -o "out/$odd/$odd.swc" -q
  refuses "it is not there, '${odd:0:40}'" 3 "no file|not there|cannot" info "in/$odd/no $odd"
done
mkdir dashes
cp in/ball.obj dashes/-ball.obj
cp in/recipe.json "in/recipe  of 肺.json"
cd dashes || exit 1
succeeds "a leading dash after --" grow "${quick[@]}" -o tree.swc -q -- -ball.obj
succeeds "a leading dash below a folder" grow ./-ball.obj "${quick[@]}" -o ./-tree.swc -q
cmp -s ./-tree.swc ../out/plain.swc || fail "the tree differs"
cd ..
succeeds "a project named oddly" run "in/recipe  of 肺.json" -o $'out/a  case\xff\n.pneuma' -q
succeeds "what it holds" info $'out/a  case\xff\n.pneuma' --json
expect "that is no JSON" "$JSON_CHECK" "$SCHEMAS/info.schema.json" "$logs/out"
succeeds "a report of it" report $'out/a  case\xff\n.pneuma' --identify -o out/odd.json -q
refuses "a name that is too long" 6 "too long" measure in/tree.swc -o "out/${long}nnnnnnnnnn.json"

# A working folder that is gone: paths from there lead nowhere.
caseName="relative paths in a folder that is gone"
cases=$((cases + 1))
(mkdir gone && cd gone && rmdir ../gone && "$PNEUMA" grow "$workFolder/in/ball.obj" "${quick[@]}" -o tree.vtp -q >"$logs/out" 2>"$logs/err")
code=$?
[ "$code" -eq 6 ] || fail "exit code $code, not 6"
[ "$(wc -l <"$logs/err")" -eq 1 ] || fail "not one sentence"

# Limits, tighter and tighter: it does it all, or says what is out.
limited() { # NAME OPTION VALUE CODES
  caseName="$1 limited to $3"
  cases=$((cases + 1))
  rm -f out/limited.*
  (
    ulimit "$2" "$3" || exit 99
    exec "$PNEUMA" grow in/ball.obj "${quick[@]}" -o out/limited.swc --report out/limited.json -q
  ) >"$logs/out" 2>"$logs/err"
  code=$?
  (ulimit "$2" "$3" && exec "$PNEUMA" version) >/dev/null 2>&1 || return 0 # not even its libraries start
  [[ " $4 " == *" $code "* ]] || fail "exit code $code, not one of $4"
  [ "$code" -eq 0 ] || [ "$(wc -l <"$logs/err")" -eq 1 ] || fail "$(wc -l <"$logs/err") lines on standard error"
  [ "$code" -ne 0 ] || cmp -s out/limited.swc out/plain.swc || fail "the tree differs"
  [ "$code" -eq 0 ] || [ -z "$(find out -name 'limited.*' -o -name '.pneuma-*')" ] || fail "something was left"
}
for files in 3 4 5 6 8 12 16; do limited "open files" -n $files "0 3 6 9"; done
for stack in 16 32 64 128 256; do limited "the stack (kB)" -s $stack "0 9"; done 2>/dev/null
step=100000 least=100000 most=900000
[ "$full" -eq 1 ] && step=2000
for ((memory = least; memory < most; memory += step)); do limited "memory (kB)" -v $memory "0 9"; done 2>/dev/null # what the shell says of those that do not even start
finish
