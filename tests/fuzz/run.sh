#!/usr/bin/env bash
# run.sh FUZZER FOLDER FORMAT SECONDS: lets libFuzzer read what it makes of FOLDER/seeds/FORMAT, of findings/FORMAT and
# of what it kept the last time. Ends with an error if anything crashes, throws what is not documented, hangs for 5 s
# or takes more than 1 GB at once; the input is then FOLDER/FORMAT-*. The last line tells how many were tried.
set -eu
export LC_ALL=C
mkdir -p "$2"
fuzzer=$(realpath "$1") folder=$(realpath "$2") format=$3 seconds=$4
findings=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/findings/$format
mkdir -p "$folder/kept/$format"
corpora=(kept/"$format" seeds/"$format")
[[ ! -d $findings ]] || corpora+=("$findings")
cd "$folder"
memory=${TMPDIR:-/tmp}
[[ -w /dev/shm ]] && memory=/dev/shm
work=$(mktemp -d "$memory/fuzz-XXXXXX")
trap 'rm -rf "$work"' EXIT

status=0
# Leaks are looked for once, at the end of each run: VTK keeps factories and dictionaries until then.
PNEUMA_FUZZ=$format PNEUMA_FUZZ_PROJECT=$PWD/seeds/case.pneuma TMPDIR=$work \
  "$fuzzer" -max_total_time="$seconds" -max_len=8192 -timeout=5 -rss_limit_mb=2048 -malloc_limit_mb=1024 \
  -print_final_stats=1 -artifact_prefix="$format-" "${corpora[@]}" >"$format.log" 2>&1 || status=$?
if ((status != 0)); then
  tail -n 60 "$format.log" >&2
fi
awk -v format="$format" '
  /cov: / { for (i = 1; i < NF; i++) if ($i == "cov:") edges = $(i + 1) }
  /stat::number_of_executed_units/ { tried = $2 }
  END { print format ": " tried + 0 " inputs, " edges + 0 " edges of the program reached" }' "$format.log"
exit "$status"
