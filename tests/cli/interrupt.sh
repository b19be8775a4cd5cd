#!/usr/bin/env bash
# Ctrl-C, TERM, a terminal that is closed and a limit on processor time during a long growth: exit 130, 143, 129 and 152
# soon, and no file.
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
stops HUP 129
stops XCPU 152

# As a shell or a scheduler limits it: the system tells of the end and ends the process in the same second.
caseName="ulimit -t"
cases=$((cases + 1))
(ulimit -t 4 && exec "$PNEUMA" grow ball.obj --terminals 2000000 -o tree.vtp -j 1) >"$logs/out" 2>"$logs/err"
code=$?
[ "$code" -eq 152 ] || fail "exit code $code, not 152"
[ "$(ls -A)" = ball.obj ] || fail "files were left: $(ls -A)"

# Who reads what is printed goes away: nothing half is left, and what was written before is whole.
succeeds "lobes" sample lobes -q
caseName="a pipe that nobody reads"
for what in "breathe lobes -o b.pvd --frames 60 --progress json" "info lobes --json"; do
  cases=$((cases + 1))
  # shellcheck disable=SC2086
  { sleep 0.5; "$PNEUMA" $what 2>&1; echo $? >"$logs/code"; } | :
  [ "$(cat "$logs/code")" -eq 141 ] || fail "$what: exit code $(cat "$logs/code"), not 141"
done
caseName="a pipe that nobody reads, and TERM after that"
cases=$((cases + 1))
"$PNEUMA" grow ball.obj --terminals 1000000 -o tree.vtp -q 2> >(:) &
process=$!
sleep 1
kill -TERM "$process"
wait "$process"
code=$?
[ "$code" -eq 143 ] || fail "exit code $code, not 143"
expect "files were left: $(ls -A | tr '\n' ' ')" test "$(ls -A | tr '\n' ' ')" = "ball.obj lobes "
finish
