#!/usr/bin/env bash
# SIGKILL while projects are saved and files are exported over older ones: at random moments, and at
# every write, fsync, rename and open. The file is the old one whole or the new one whole. What was
# written aside may stay (.pneuma-*.part, .pneuma-*.parts): it hinders nobody, and the next command that
# writes into the folder removes it once it is an hour old.
. "$(dirname "$0")/lib.sh"
. "$here/inputs.sh"

kills=20 most=1 states=over upTo=lungs
[ "$full" -eq 1 ] && kills=200 most=${PNEUMA_FAULT_MOST:-60} states="over fresh" upTo=export
killed=0 ended=0 old=0 new=0 left=0 bad=0

# survives fresh|over: after a kill, every file is whole; counts what it is.
survives() {
  local file isOld=0 isNew=0 extra
  for file in $names; do
    if cmp -s "out/$file" "$logs/new/$file"; then
      isNew=1
    elif cmp -s "out/$file" "$logs/old/$file"; then
      isOld=1
    elif [[ $unstable == *" $file "* ]] && isWhole "out/$file"; then
      isNew=1
    elif [ "$1" = over ] || [ -e "out/$file" ]; then
      fail "$file is neither the old one nor the new one: $(ls -la "out/$file" 2>&1)"
      bad=$((bad + 1))
    fi
  done
  old=$((old + isOld))
  new=$((new + isNew))
  extra=$(cd out && find . -type f -not -path '*/.pneuma-*' | sort | comm -13 <(echo "$names") - | grep -v '~$')
  [ -z "$extra" ] || fail "left behind: $extra"
  [ -z "$(find out -name '.pneuma-*')" ] || left=$((left + 1))
}

# asBefore ARGUMENT...: with all that was left there, a run that nothing stops makes the new files;
# what was left goes once it is old, and what may be in use stays.
asBefore() {
  caseName="$name: the next run"
  cases=$((cases + 1))
  local links=out/.pneuma-00000000000000aa.part
  echo victim >in/victim
  rm -rf out tmp
  mkdir tmp
  cp -r "$logs/old" out
  echo part >out/.pneuma-0123456789abcdef.part
  mkdir -p out/.pneuma-0123456789abcdef.parts/sub
  echo part >out/.pneuma-0123456789abcdef.parts/sub/file
  touch -d '2 hours ago' out/.pneuma-0123456789abcdef.part out/.pneuma-0123456789abcdef.parts
  echo young >out/.pneuma-00000000000000bb.part
  echo other >out/.pneuma-mine.part
  touch -d '2 hours ago' out/.pneuma-mine.part
  echo locked >out/.pneuma-00000000000000cc.part
  touch -d '2 hours ago' out/.pneuma-00000000000000cc.part
  ln -s ../in/victim "$links"
  touch -h -d '2 hours ago' "$links"
  exec 9<out/.pneuma-00000000000000cc.part
  flock 9
  run "$@"
  exec 9<&-
  [ "$code" -eq 0 ] || fail "exit code $code"
  local file
  for file in $names; do
    cmp -s "out/$file" "$logs/new/$file" || [[ $unstable == *" $file "* ]] || fail "$file is not the new one"
  done
  [ ! -e out/.pneuma-0123456789abcdef.part ] || fail "what was half written two hours ago is still there"
  [ ! -e out/.pneuma-0123456789abcdef.parts ] || fail "the folder of two hours ago is still there"
  for file in bb cc; do
    [ -e out/.pneuma-00000000000000$file.part ] || fail "what another program may be writing is gone ($file)"
  done
  [ -e out/.pneuma-mine.part ] || fail "a file of somebody else is gone"
  [ "$(cat in/victim)" = victim ] || fail "a link was followed"
}

# killedAt NAME COUNT ARGUMENT...: so many kills, half of them spread over the time that the command
# takes and half over the last fifth of it, in which it writes; and one at every call.
killedAt() {
  local name=$1 count=$2 start seconds n delay kind state
  shift 2
  [[ -z ${PNEUMA_FAULT_ONLY:-} || $name == $PNEUMA_FAULT_ONLY ]] || return
  cases=$((cases + 1))
  start=${EPOCHREALTIME/./}
  reference "$name" "$@"
  seconds=$(awk -v us=$((${EPOCHREALTIME/./} - start)) 'BEGIN { print us / 2e6 }')
  killed=0 ended=0 old=0 new=0 left=0 bad=0
  local share
  for share in $(awk -v n=$((5 * count)) -v seed="$seed" \
    'BEGIN { srand(seed); for (i = 0; i < n; i++) printf "%.4f\n", i % 2 ? rand() : 0.8 + 0.25 * rand() }'); do
    [ "$killed" -lt "$count" ] || break
    delay=$(awk -v most="$seconds" -v share="$share" 'BEGIN { printf "%.4f", 0.005 + most * share }')
    caseName="$name: killed after $delay s of $seconds s"
    cases=$((cases + 1))
    prepare over
    start=${EPOCHREALTIME/./}
    { timeout -s KILL "$delay" "$PNEUMA" "$@" >"$logs/out" 2>"$logs/err" </dev/null; } 2>/dev/null
    code=$?
    if [ "$code" -eq 137 ]; then
      killed=$((killed + 1))
    else # the machine is faster by now: what the command just took is what there is to kill in
      [ "$code" -eq 0 ] || fail "it ends with $code: $(head -n 1 "$logs/err")"
      ended=$((ended + 1))
      seconds=$(awk -v s="$seconds" -v us=$((${EPOCHREALTIME/./} - start)) \
        'BEGIN { took = us / 1e6; print took < s ? took : 0.95 * s }')
    fi
    survives over
  done
  [ "$killed" -ge "$count" ] || fail "only $killed of $count kills came in time"
  echo "$name: moments within $seconds s: $killed killed, $ended had ended; $old with old files," \
    "$new with new ones, $bad with neither; in $left something was left aside"
  for state in $states; do
    killed=0 ended=0 old=0 new=0 left=0 bad=0
    for kind in open write sync rename; do
      prepare $state
      counted $kind FAULT_AT=0 -- "$@"
      for n in $(picks "$calls" "$most"); do
        caseName="$name: killed at $kind $n ($state)"
        cases=$((cases + 1))
        prepare $state
        counted $kind FAULT_AT="$n" FAULT_SIGNAL=9 -- "$@" 2>/dev/null
        [ "$code" -eq 137 ] && killed=$((killed + 1))
        survives $state
      done
    done
    [ "$killed" -gt 0 ] || fail "nothing was killed"
    echo "$name, $state: killed at $killed calls; $old with old files, $new with new ones, $bad with neither;" \
      "in $left something was left aside"
  done
  asBefore "$@"
}

# goesOn NAME ARGUMENT...: what is killed at any call, into a new folder, can be done again as it stands: nobody is told
# to use --force for files that were left there. Likewise over what another run of its own left, of which it keeps the
# first stages; and after a third one that keeps some of them.
goesOn() {
  local name=$1 kind n state
  shift
  [[ -z ${PNEUMA_FAULT_ONLY:-} || $name == $PNEUMA_FAULT_ONLY ]] || return
  cases=$((cases + 1))
  reference "$name" "$@"
  killed=0
  for kind in open write sync rename; do
    for state in fresh again; do
      prepare fresh
      [ $state = fresh ] || run "${@//recipe.json/recipe-trees.json}"
      cp -r out "$logs/before"
      counted $kind FAULT_AT=0 -- "$@"
      for n in $(picks "$calls" "$((2 * most))"); do
        caseName="$name: killed at $kind $n ($state)"
        cases=$((cases + 1))
        rm -rf out
        cp -r "$logs/before" out
        counted $kind FAULT_AT="$n" FAULT_SIGNAL=9 -- "$@" 2>/dev/null
        [ "$code" -eq 137 ] && killed=$((killed + 1))
        if [ $((n % 2)) -eq 0 ]; then
          run "${@//recipe.json/recipe-lobes.json}"
          [ "$code" -eq 0 ] || fail "another recipe after it ends with $code"
        fi
        caseName="$name: done again after a kill at $kind $n ($state)"
        run "$@"
        [ "$code" -eq 0 ] || fail "exit code $code"
        for file in $names; do
          cmp -s "out/$file" "$logs/new/$file" || [[ $unstable == *" $file "* ]] || fail "$file is not the new one"
        done
        find out -name '.pneuma-*' -prune -exec rm -r {} +
        [ "$(cd out && find . -type f | sort)" = "$names" ] || fail "other files: $(cd out && find . -type f | sort)"
      done
      rm -rf "$logs/before"
    done
  done
  [ "$killed" -gt 0 ] || fail "nothing was killed"
  echo "$name: killed at $killed calls, and done again"
}

# A project: nearly all of the time goes into what is saved; the rest is killed call by call.
killedAt "saving a project" $((kills / 2)) run in/recipe.json -o out/case.pneuma --up-to $upTo -f -q
killedAt "exporting for ParaView" $((kills / 5)) export in/breathing.pneuma --preset paraview -o out -f -q
killedAt "exporting a surface" $((kills / 10)) export in/chest/rul.stl -o out/rul.vtp -f -q
killedAt "exporting an animation" $((kills / 10)) export in/breathing.pneuma --preset share -o out -f -q
killedAt "growing" $((kills / 10)) grow in/ball.obj --method centroid --terminals 30 -o out/tree.vtp --report out/r.json -f -q
sed 's/"terminals": 30/"terminals": 20/' in/recipe.json >in/recipe-trees.json
sed 's/"spacing": 8/"spacing": 9/' in/recipe.json >in/recipe-lobes.json
goesOn "running into a folder" run in/recipe.json -o out/case -q
finish
