# Shared by the tests of faults. Usage: . lib.sh; needs PNEUMA, the program under test, and FAULT_SHIM,
# the library that makes calls fail. PNEUMA_FAULTS=full tries every call, otherwise some of each kind.
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/../cli/lib.sh"
: "${FAULT_SHIM:?is the library that makes calls fail}"
if [ ! -r "$FAULT_SHIM" ]; then # or nothing would fail, and everything pass
  echo "there is no $FAULT_SHIM; build all targets"
  exit 1
fi
full=0
[ "${PNEUMA_FAULTS:-quick}" = full ] && full=1
echo "{}" >"$logs/any.json"
seed=${PNEUMA_FAULT_SEED:-9} # which calls fail is the same in every run
mkdir in out tmp "$logs/new" "$logs/old"
export TMPDIR=$workFolder/tmp

# isWhole FILE: of a file that differs from run to run, as everything that keeps times.
isWhole() {
  case $1 in
    *.json) [ -e "$1" ] && "$JSON_CHECK" "$logs/any.json" "$1" ;;
    *.pneuma) [ -e "$1" ] && "$PNEUMA" info "$1" ;;
    *.yaml) [ "$(tail -n 1 "$1")" = "printshellcmds: false" ] ;;
    *) false ;;
  esac >/dev/null 2>&1
}

# reference NAME ARGUMENT...: what the command writes into out when nothing fails, twice, into
# $logs/new; text of the same names into $logs/old.
reference() {
  caseName=$1
  shift
  local file
  unstable=${varies:-}
  for _ in 1 2; do
    rm -rf out tmp "$logs/again"
    mkdir out tmp
    mv "$logs/new" "$logs/again"
    run "$@"
    [ "$code" -eq 0 ] || fail "exit code $code without a fault"
    [ "$(find tmp -mindepth 1)" ] && fail "temporary files without a fault: $(ls -A tmp)"
    mv out "$logs/new"
    cp "$logs/out" "$logs/new.out"
  done
  rm -rf "$logs/old"
  mkdir -p "$logs/old" out
  names=$(cd "$logs/new" && find . -type f | sort)
  for file in $names; do
    cmp -s "$logs/new/$file" "$logs/again/$file" || unstable="$unstable $file "
    mkdir -p "$logs/old/${file%/*}"
    echo "old $file" >"$logs/old/$file"
  done
  [ "$names" ] || fail "nothing was written"
}

# prepare fresh|over CODES SETTING... -- ARGUMENT|over: the folder that is written to, empty or with old files.
prepare() {
  rm -rf out tmp
  mkdir tmp
  if [ "$1" = over ]; then cp -r "$logs/old" out; else mkdir out; fi
}

# everythingIsWhole fresh|over ONWARD: after|over: after a command that ended with $code, every file is the old one or
# the new one, all of one kind, and nothing else is there.
everythingIsWhole() {
  local file found=0 wanted=0
  for file in $names; do
    if [ "$1" = over ] && [[ ${keeps:-} == *" $file "* ]]; then
      cmp -s "out/$file" "$logs/old/$file" || fail "$file was replaced"
      continue
    fi
    wanted=$((wanted + 1))
    if [ ! -e "out/$file" ]; then
      [ "$1" = over ] && fail "the old $file is gone"
      [ "$code" -eq 0 ] && fail "$file is missing, but it says that all is well"
    elif cmp -s "out/$file" "$logs/new/$file"; then
      found=$((found + 1))
    elif [ "$1" = over ] && cmp -s "out/$file" "$logs/old/$file"; then
      [ "$code" -eq 0 ] && fail "$file is the old one, but it says that all is well"
    elif [[ $unstable == *" $file "* ]] && isWhole "out/$file"; then
      found=$((found + 1))
    else
      fail "$file is neither the old one nor the new one"
    fi
  done
  if [ "$found" -ne 0 ] && [ "$found" -ne "$wanted" ]; then
    mixed=$((mixed + 1))
    # A run keeps the stages that were done; and what cannot be renamed once more cannot be brought back.
    [ "$stages" -eq 1 ] || [ "$2" -eq 1 ] || fail "$found of $wanted files are the new ones"
  fi
  local -a extra
  mapfile -t extra < <(cd out && find . -type f -o -type l | sort | comm -13 <(echo "$names") -)
  [ "${#extra[@]}" -ne 0 ] && [[ ${extra[*]} != *'~' || ${#extra[@]} -gt 1 ]] && fail "left behind: ${extra[*]}"
  [ "$1" = fresh ] && [ "$found" -eq 0 ] && [ "$stages" -eq 0 ] && [ "$(find out -mindepth 1)" ] && fail "a folder was left: $(find out -mindepth 1)"
  [ "$(find tmp -mindepth 1)" ] && fail "temporary files were left: $(ls -A tmp)"
}

# counted KIND NAME=VALUE... -- ARGUMENT...: runs the command with calls of a kind failing, as told
# by the variables; sets $calls and $failed.
counted() {
  local -a settings=("FAULT_CALL=$1")
  shift
  while [ "$1" != -- ]; do settings+=("$1"); shift; done
  shift
  head -c 16 /dev/zero >"$logs/count"
  timeout -s KILL 300 env LD_PRELOAD="$FAULT_SHIM" FAULT_REPORT="$logs/count" FAULT_UNDER="$workFolder/out:$workFolder/tmp" \
    "${settings[@]}" "$PNEUMA" "$@" >"$logs/out" 2>"$logs/err" </dev/null
  code=$?
  read -r calls failed < <(od -An -t u8 "$logs/count")
}

# faultCase NAME KIND N ERROR ONWARD fresh|over CODES ARGUMENT...: one run with one fault.
faultCase() {
  local name=$1 kind=$2 n=$3 error=$4 onward=$5 state=$6 codes=$7
  shift 7
  local -a settings=()
  while [ "$1" != -- ]; do settings+=("$1"); shift; done
  shift
  [ "$error" -eq 4 ] && onward=0 # or it would be interrupted for ever
  caseName="$name: $kind $n fails with $error ($state, onward $onward)"
  cases=$((cases + 1))
  local before=$failures
  prepare "$state"
  counted "$kind" "FAULT_AT=$n" "FAULT_ERROR=$error" "FAULT_ONWARD=$onward" "${settings[@]}" -- "$@"
  [ "$failed" -eq 0 ] && { missed=$((missed + 1)); [ "$code" -eq 0 ] || fail "exit code $code without a fault"; }
  [[ " $codes " == *" $code "* ]] || fail "exit code $code, not one of $codes"
  if [ "$code" -ne 0 ]; then
    [ "$(wc -l <"$logs/err")" -eq 1 ] || fail "$(wc -l <"$logs/err") lines on standard error, not one"
    grep -q '^pneuma: ' "$logs/err" || fail "the sentence does not start with 'pneuma: '"
  elif [ "$unstable" = "" ]; then
    cmp -s "$logs/out" "$logs/new.out" || fail "it prints something else than without a fault"
  fi
  everythingIsWhole "$state" "$onward"
  [ "$failures" -eq "$before" ] || bad=$((bad + 1))
}

# picks COUNT MOST: numbers from 1 to COUNT: all if there are no more than MOST; otherwise some by
# chance and, where there is room for them, the first, the last and steps that grow.
picks() {
  seed=$((seed + 1))
  awk -v count="$1" -v most="$2" -v seed="$seed" '
    function take(n) { if (n in seen || made >= most) return; seen[n] = 1; made++; print n }
    BEGIN {
      srand(seed)
      if (count <= most) { for (n = 1; n <= count; n++) print n; exit }
      if (most >= 8) { take(1); take(count); for (n = 3; n < count && made < most / 2; n *= 3) take(n) }
      while (made < most) take(1 + int(rand() * count))
    }'
}
