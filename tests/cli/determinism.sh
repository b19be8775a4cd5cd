#!/usr/bin/env bash
# The same input, options and seed give the same bytes, for any number of threads and in every format.
. "$(dirname "$0")/lib.sh"

fiveBalls lobes
for threads in 1 2; do
  for format in vtp swc csv json; do
    succeeds "$format with $threads threads" \
      grow lobes --terminals 3000 --method centroid --set jitter=0.3 --seed 7 -j "$threads" -o "$threads.$format"
  done
done
for format in vtp swc csv json; do
  caseName="$format"
  expect "the $format files of 1 and 2 threads differ" cmp "1.$format" "2.$format"
done
succeeds "another seed" grow lobes --terminals 3000 --method centroid --set jitter=0.3 --seed 8 -o other.csv
expect "the seed does nothing" test "$(cmp -s 1.csv other.csv; echo $?)" -eq 1
finish
