#!/usr/bin/env bash
# --timeout and --max-memory are kept: exit 11 and 9, one sentence, no file, and never a signal.
. "$(dirname "$0")/lib.sh"

ball 90 >ball.obj
for seconds in 0.000001 0.3; do
  refuses "a growth of more than $seconds s" 11 "time of --timeout is over" grow ball.obj --terminals 1000000 --timeout "$seconds" -o tree.vtp
done
succeeds "a growth within its time" grow ball.obj --terminals 500 --timeout 600 -o tree.vtp -q
succeeds "no limit" grow ball.obj --terminals 500 --timeout 0 --max-memory 0 -o tree.vtp -q --force
refuses "a time below nothing" 2 "timeout must lie in \[0, 1(0000000|e\+07)\] s, but is -1" version --timeout -1
refuses "a time that is none" 2 "timeout needs a number, but 'soon'" version --timeout soon
for size in -5G 5X G 0.5 1K 63M 1e30 nan 8GB; do
  refuses "memory of $size" 2 "max-memory" version "--max-memory=$size"
done
for size in 64M 0.5G 1T 100000000 8g; do succeeds "memory of $size" version "--max-memory=$size"; done

refuses "what is said beforehand" 9 "0.1 million branches.*memory" grow ball.obj --terminals 50000 --max-memory 64M -o big.vtp
refuses "an aggregate" 9 "memory" grow ball.obj --method dla --terminals 1000000 --max-memory 100M -o big.vtp
succeeds "a chest" sample chest --ct --spacing 2 -q
mkdir lobes && mv chest/*.stl lobes
# Whatever the memory: a whole result or a sentence.
most=0
for megabytes in 64 70 77 85 93 102 113 124 136 150 165 182 200 320; do
  while read -r -a arguments; do
    caseName="$megabytes MB: ${arguments[*]}"
    cases=$((cases + 1))
    rm -rf out.*
    run "${arguments[@]}" --max-memory "${megabytes}M" -q
    [ "$code" -eq 9 ] && most=$megabytes
    if [ "$code" -eq 9 ]; then
      [ "$(grep -c '^pneuma: ' "$logs/err")" -eq 1 ] || fail "there is not one sentence"
      [ -z "$(find . -name 'out.*')" ] || fail "something was written"
    elif [ "$code" -ne 0 ]; then
      fail "exit code $code"
    fi
  done <<'COMMANDS'
grow lobes --central chest/central.vtp --method centroid --terminals 20000 -o out.vtp
segment chest/ct.nii.gz -o out.nii.gz
import chest/dicom -o out.mha
repair lobes/rul.stl -o out.stl
breathe lobes -o out.pvd --frames 2
COMMANDS
done
expect "no limit was ever too small" test "$most" -gt 64
expect "no limit was ever enough" test "$most" -lt 320
refuses "a picture" 9 "drawing takes 600 MB.*--max-memory" render lobes -o out.png --max-memory 300M
finish
