#!/usr/bin/env bash
# What the runner of damaged files must notice, by a program that fails in every way.
# Needs DAMAGED (the runner), LIAR_PROGRAM, SEEDS (what seeds.sh made).
set -u
cases=0
failures=0
unset DISPLAY

# notices WAY REGEX [OPTION...]: the runner ends with 1 and says what is wrong.
notices() {
  local way=$1 regex=$2 out
  shift 2
  cases=$((cases + 1))
  out=$(LIAR=$way "$DAMAGED" "$LIAR_PROGRAM" "$SEEDS" --only swc/empty "$@" 2>&1)
  if [ $? -ne 1 ] || ! grep -Eq -- "$regex" <<<"$out"; then
    failures=$((failures + 1))
    echo "FAILED: $way is not noticed"
    echo "$out" | head -n 5
  fi
}

notices signal 'FAULT .*ended by signal 11'
notices hang 'FAULT .*took longer' --seconds 0.2
notices memory 'FAULT .*took 2[0-9][0-9] MB' --megabytes 100
notices nothing 'FAULT .*read what cannot be read'
notices reads-all 'FAULT .*read what cannot be read'
notices silent 'FAULT .*0 lines on standard error'
notices two-lines 'FAULT .*2 lines on standard error'
notices nameless 'FAULT .*does not name the file'
notices bug 'FAULT .*exit code 1'
notices left-behind 'FAULT .*left half-a-tree.vtp'
notices temporary 'FAULT .*left temporary/x'
notices beside-input 'FAULT .*wrote beside the input: in/x'
notices result 'FAULT .*there is a result on standard output'
notices nothing 'FAULT .*nothing is on standard output' --only swc/swc-radius-nan
notices nothing 'FAULT .*wrote nothing' --only swc/swc-radius-nan
notices empty-output 'FAULT .*is empty' --only swc/swc-radius-nan
notices refuses 'FAULT .*refused a sound file' --only swc/sound
notices refuses 'all +0 +0' --only no-file-of-this-name

cases=$((cases + 1))
if ! LIAR=refuses "$DAMAGED" "$LIAR_PROGRAM" "$SEEDS" --only swc/empty >/dev/null; then
  failures=$((failures + 1))
  echo "FAILED: a proper refusal is a fault"
fi
echo "$((cases - failures)) of $cases cases passed"
[ "$failures" -eq 0 ]
