#!/usr/bin/env bash
# Ctrl-C and TERM during a long growth: exit 130 and 143 soon, and no file.
. "$(dirname "$0")/lib.sh"

ball 90 >ball.obj

# stops SIGNAL CODE
stops() {
  caseName="signal $1"
  cases=$((cases + 1))
  : >"$logs/out"
  : >"$logs/err" # or what the one before said is taken for this one
  "$PNEUMA" grow ball.obj --terminals 1000000 --progress json -o tree.vtp --report r.json 2>"$logs/err" &
  local process=$! waited=0
  until grep -q '"step":"growing' "$logs/err"; do
    sleep 0.05
    waited=$((waited + 1))
    if [ "$waited" -gt 1200 ] || ! kill -0 "$process" 2>/dev/null; then
      fail "growth never showed progress"
      return
    fi
  done
  local start=${EPOCHREALTIME/./}
  kill "-$1" "$process"
  wait "$process"
  code=$?
  local milliseconds=$(((${EPOCHREALTIME/./} - start) / 1000))
  echo "stopped $milliseconds ms after $1"
  [ "$code" -eq "$2" ] || fail "exit code $code, not $2"
  [ "$milliseconds" -lt 3000 ] || fail "it took $milliseconds ms"
  [ "$(find . -mindepth 1)" = ./ball.obj ] || fail "files were left: $(find . -mindepth 1 | tr '\n' ' ')"
  grep -q '^pneuma: stopped' "$logs/err" || fail "it does not say that it stopped"
}

set -m # or background processes ignore SIGINT
stops INT 130
stops TERM 143
finish
