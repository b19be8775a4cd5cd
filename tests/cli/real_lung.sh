#!/usr/bin/env bash
# Five lobes and the airways of one person, from PNEUMA_TEST_DATA; on five balls where that is not set.
. "$(dirname "$0")/lib.sh"

data=${PNEUMA_TEST_DATA:-}/lobes_airways_chaste
if [ -d "$data" ]; then
  inputs=("$data" --central "$data/TestSubject002MajorAirways.vtu")
else
  echo "PNEUMA_TEST_DATA is not set: five balls instead of a real lung"
  fiveBalls lobes
  inputs=(lobes)
fi

# number KEY: the first number under this key of the report of $method.
number() { sed -n "s/.*\"$1\": \([0-9.e+-]*\).*/\1/p" "$method.json" | head -n 1; }
within() { awk -v x="$1" -v low="$2" -v high="$3" 'BEGIN { exit !(x >= low && x <= high) }'; }

for method in kitaoka centroid; do
  succeeds "30,000 terminals by $method" grow "${inputs[@]}" --method $method --terminals 30000 \
    -o $method.vtp --report $method.json
  cat "$logs/out"
  expect "terminals: $(number terminals)" within "$(number terminals)" 29100 30900
  expect "ends outside: $(number ends)" test "$(number ends)" = 0
  expect "segments outside: $(number segments)" test "$(number segments)" = 0
  expect "failed flow: $(number Q_f)" within "$(number Q_f)" 0 0.02
  if [ $method = kitaoka ]; then
    expect "mean gap: $(number gap_mean)" within "$(number gap_mean)" 0.4 0.55
    expect "largest gap: $(number gap_max)" within "$(number gap_max)" 0.8 1.5
  fi
  succeeds "the tree of $method is sound" info $method.vtp
  expect "the tree of $method has complaints" test -z "$(grep '^  ! ' "$logs/out")"
done

# Aggregation: 100,000 particles, every lobe served.
method=dla
succeeds "100,000 particles" grow "${inputs[@]}" --method dla -o dla.vtp --report dla.json --points particles.vtp
cat "$logs/out"
expect "particles: $(number particles)" test "$(number particles)" = 100000
expect "ends outside: $(number ends)" test "$(number ends)" = 0
expect "segments outside: $(number segments)" test "$(number segments)" = 0
expect "mean gap: $(number gap_mean)" within "$(number gap_mean)" 0.4 0.8
succeeds "the aggregate's tree is sound" info dla.vtp
expect "the aggregate's tree has complaints" test -z "$(grep '^  ! ' "$logs/out")"
succeeds "three methods side by side" compare kitaoka.vtp centroid.vtp dla.vtp
prints 'terminals'
finish
