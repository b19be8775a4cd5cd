# Shared by the tests that run a cohort. Usage: . lib.sh, after cli/lib.sh.

python=/usr/bin/python3 # that of the snakemake which the system has
unset DISPLAY # as on the node of a cluster
if ! command -v Xvfb >/dev/null; then
  echo "Xvfb is not installed"
  exit 77
fi
for module in h5py matplotlib; do
  if ! command -v snakemake >/dev/null || ! "$python" -c "import $module" 2>/dev/null; then
    echo "snakemake, or $module for it, is not installed"
    exit 77
  fi
done

# flow PROFILE ARGUMENT...: Snakemake, in the folder of the workflow; $code, and what it says in $logs/flow.
flow() {
  (cd study && PATH=/usr/bin:$PATH snakemake --profile "profiles/$1" "${@:2}") >"$logs/flow" 2>&1 </dev/null
  code=$?
}

# ran RULE: how many jobs of it the last run of Snakemake did.
ran() { grep -c "^rule $1:" "$logs/flow"; }

# stated CASE COLUMN: what the table says.
stated() {
  "$python" - "$1" "$2" <<'PYTHON'
import csv, sys
for row in csv.DictReader(open("study/table.csv", encoding="utf-8")):
    if row["case"] == sys.argv[1]:
        print(row[sys.argv[2]])
PYTHON
}

# says CASE COLUMN REGEX
says() {
  cases=$((cases + 1))
  stated "$1" "$2" | grep -Eq -- "$3" || fail "$1 has '$(stated "$1" "$2")' under $2, not /$3/"
}

# results FILE: the SHA-256 of all results of the study; of reports without the lines that tell times and memory.
results() {
  (cd study/cases && find . -type f | LC_ALL=C sort | while read -r file; do
    case $file in
      *.json) grep -vE '"(read|domain|grow|measure|write|find|[a-z]+_s|peak_memory_mb|sha256)": ' "$file" | sha256sum ;;
      *.html) ;; # holds when it was made
      *) sha256sum <"$file" ;;
    esac | sed "s|-\$|$file|"
  done) >"$1"
}
