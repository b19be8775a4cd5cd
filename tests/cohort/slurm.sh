#!/usr/bin/env bash
# A cohort on a real Slurm of two nodes, both on this machine: the same results as without it, byte for byte. In the
# middle one node's slurmd is killed and started again, then Snakemake itself: what was finished is not done again.
# Needs slurmctld, slurmd and munge, and root to start them.
. "$(dirname "$0")/../cli/lib.sh"
. "$(dirname "$0")/lib.sh"
. "$(dirname "$0")/slurm_lib.sh"

for seed in 1 2 3; do
  succeeds "sample $seed" sample "made $seed" --cell 6 --ct --spacing 4 --thick 5 --seed "$seed" -q
done
cp -r 'made 1/dicom' cut && head -c 5000 cut/slice-0020.dcm >cut/x && mv cut/x cut/slice-0020.dcm
printf '{"schema":"pneuma/recipe/1","lobes":{},"airways":{"method":"centroid","terminals":200}}\n' >recipe.json
printf 'case,ct\none,made 1/dicom\nÜnal zwei,made 2/dicom\nthree,made 3/dicom\ncut,cut\n' >cases.csv
start() {
  succeeds "init" cohort init study --cases cases.csv --recipe recipe.json -q
  sed -i -e 's/ --frames 8/ --frames 2/' -e 's/480x360/160x120/' study/config.yaml
  sed -i -e 's/^latency-wait: .*/latency-wait: 5/' study/profiles/slurm/config.yaml
}

start
caseName="on one machine"
flow local --cores 2
expect "it does not end with 1 but $code" test "$code" -eq 1
results local.sums
rm -r study
start

caseName="Slurm"
slurmUp
expect "there are not two nodes" test "$(sinfo -h -N -t idle -o %N | sort -u | wc -l)" -eq 2
(cd study && PATH=/usr/bin:$PATH exec setsid snakemake --profile profiles/slurm) >"$logs/first" 2>&1 </dev/null &
head=$!
reached 6
kill -9 "$(cat "$slurm/slurmd-n1.pid")"
sleep 3
slurmdUp n1
reached 14
for _ in $(seq 600); do [ -n "$(squeue -h -t R)" ] && break || sleep 0.05; done
kill -9 -- "-$head"
wait "$head" 2>/dev/null
before=$(finishedOnes)
expect "Snakemake was not killed in the middle" test "$(echo "$before" | wc -l)" -ge 14
(cd study && PATH=/usr/bin:$PATH sh profiles/slurm/resume.sh) >"$logs/flow" 2>&1 </dev/null
code=$?
expect "it does not end with 1 but $code" test "$code" -eq 1
expect "it waited for none of the jobs that were running" grep -q 'waiting for [1-9]' "$logs/flow"
expect "what was finished was done again: $(comm -23 <(echo "$before") <(finishedOnes))" \
  test -z "$(comm -23 <(echo "$before") <(finishedOnes))"
# Three cases of ten jobs, and one that fails at its first, before and after.
started=$(find study/logs/slurm -name '*.out' | wc -l)
expect "$started jobs were started for 32" test "$started" -le 32
says cut status '^failed$'
says cut exit_code '^4$'
says 'Ünal zwei' status '^done$'
results slurm.sums
expect "results differ: $(diff local.sums slurm.sums | head -n 3)" cmp local.sums slurm.sums
expect "jobs are left" test -z "$(squeue -h)"
finish
