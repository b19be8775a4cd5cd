#!/bin/sh
# After Snakemake was killed, or the machine that it ran on: sh profiles/slurm/resume.sh, in the folder of the cohort.
# Jobs that were running go on, and this waits for them, so that nothing is done twice at a time; those that were only
# queued are taken back. Then Snakemake starts again and does what is missing. Arguments go to Snakemake.
# Not while Snakemake is still running.
folder=$(pwd -P)
export folder

# jobs: "ID STATE" of every job of this folder; ends this script if nobody tells.
jobs() {
  all=$(squeue --me -h -o '%i %t %k') || {
    echo "resume.sh: Slurm does not answer; try again" >&2
    exit 1
  }
  echo "$all" | awk '{ head = $1 " " $2; rest = $0; sub(/^[^ ]+ [^ ]+ /, "", rest) } rest == ENVIRON["folder"] { print head }'
}

left=$(jobs) || exit
echo "$left" | awk '$2 == "PD" { print $1 }' | xargs -r scancel --state=PENDING
left=$(jobs) || exit
[ -z "$left" ] || echo "waiting for $(echo "$left" | wc -l) jobs of the run before" >&2
while [ -n "$left" ]; do
  sleep 2
  left=$(jobs) || exit
done
snakemake --unlock || exit
exec snakemake --profile profiles/slurm "$@"
