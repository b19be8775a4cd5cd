#!/usr/bin/env bash
# Every command of the program, and of Snakemake, that README and the pages of docs/ show, run as it stands there, page
# by page, in the order of the page; but with a tenth of the terminals, a fifth of the seeds, small films and four
# pictures of a breath, unless FULL is set.
# Needs ROOT (the project), a display. PNEUMA_TEST_DATA: for the one command that asks for real data.
. "$(dirname "$0")/../cli/lib.sh"
: "${ROOT:?}"
bin=$workFolder/bin
mkdir "$bin" && ln -s "$PNEUMA" "$bin/pneuma"
export PATH=$bin:$PATH

# blocks PAGE: what its blocks of shell hold.
blocks() { awk '/^```/ { inside = $0 == "```sh"; next } inside' "$1"; }

# What a page takes for granted lies there before its commands are run.
prepared_README() {
  pneuma sample made --ct --spacing 3 -q && mv made/dicom dicom-folder && rm -r made && inspired && prepared_pictures &&
    pneuma grow --organ thorax --terminals 500 -o other.vtp -q && marks && poses &&
    if [ -n "${PNEUMA_TEST_DATA:-}" ]; then ln -s "$PNEUMA_TEST_DATA" real-data; fi
}
prepared_head-poses() {
  pneuma sample lobes -q --cell 5mm && mv lobes/central.vtp . &&
    pneuma grow lobes --central central.vtp --terminals 300 -o tree.vtp -q &&
    pneuma breathe lobes tree.vtp -o breath.pvd --frames 3 -q && poses
}
prepared_slices() {
  pneuma sample made --ct --spacing 3 -q && mv made/ct.nii.gz made/labels.nii.gz . && mkdir lungs && mv made/*.stl lungs/ &&
    pneuma grow lungs --terminals 300 -o tree.vtp -q
}
prepared_pictures() {
  pneuma sample figures -q --cell 5mm && cat >figures/pictures.json <<'LIST'
{ "schema": "pneuma/pictures/1", "size": "200x150", "references": "references",
  "pictures": [ { "name": "lobe", "inputs": [ "rul.stl" ], "options": [ "--view", "left" ] } ] }
LIST
  mkdir figures/references && pneuma regress figures -o first --update -q
}
prepared_cohort() {
  mkdir patients && for n in 1 2; do pneuma sample "made$n" --cell 6 --ct --spacing 4 --thick 5 --seed $n -q || return; done &&
    mv made1/dicom patients/a && mv made2/ct.nii.gz patients/b.nii.gz && mv made2/fissures.json . &&
    printf '%s\n' case,ct,fissures,group P01,patients/a,,COPD P02,patients/b.nii.gz,fissures.json,well >cases.csv &&
    awk '/^```/ { json = $0 == "```json"; next } json' "$ROOT/docs/guide/cohort.md" >recipe.json
}
prepared_comparison() { pneuma sample lobes -q && mv lobes/central.vtp .; }

# The same lungs, a tenth larger.
inspired() {
  pneuma segment dicom-folder -o small.nii.gz --surfaces small -q && mkdir inspiration &&
    for side in left right; do
      pneuma export small/$side.vtp -o small/$side.obj -q &&
        awk '$1 == "v" { print "v", 1.03 * $2, 1.03 * $3, 1.06 * $4; next } { print }' small/$side.obj >inspiration/$side.obj
    done
}

# Landmarks in both lungs that move down and out; 3 mm more the further down.
marks() {
  awk 'BEGIN {
    print "exp_x,exp_y,exp_z,insp_x,insp_y,insp_z"
    for (i = 0; i < 60; i++) {
      x = (i % 2 ? 70 : -70) + 7 * (i % 5); y = -20 + 9 * (i % 7); z = -60 + 3 * i
      printf "%.3f,%.3f,%.3f,%.3f,%.3f,%.3f\n", x, y, z, x * 1.03, y * 1.02, z - 3 - (120 - z) * 0.03
    }
  }' >marks.csv
}

poses() {
  awk 'BEGIN {
    print "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz"
    for (i = 0; i < 20; i++) printf "%.3f,%.1f,-900,0,0.70710678,0.70710678,0,0\n", 0.015 * i, 5 * i
  }' >poses.csv
}

smaller='s/--terminals 30000/--terminals 3000/; s/--seeds 20/--seeds 4/; s/--pictures/& --frames 4/
         s/^pneuma render .*[.]ogv/& --size 480x360/'
pages=0
shown=0
for page in "$ROOT"/README.md "$ROOT"/docs/*.md "$ROOT"/docs/guide/*.md "$ROOT"/docs/algorithms/*.md; do
  blocks "$page" | grep -qE '^(for .*)?pneuma ' || continue
  pages=$((pages + 1))
  name=$(basename "$page" .md)
  caseName="${page#"$ROOT"/}"
  if ! declare -F "prepared_$name" >/dev/null; then
    fail "has commands, and this test does not know what they need"
    continue
  fi
  mkdir "$workFolder/$name" && cd "$workFolder/$name" || exit 1
  "prepared_$name" >"$logs/out" 2>"$logs/err" || fail "what it needs could not be made"
  while read -r line; do
    shown=$((shown + 1))
    case $line in
      *'snakemake --profile profiles/local)') # cohort/workflow runs it, too
        [ -n "${FULL:-}" ] || { echo "not run but with FULL: $line" && continue; } ;;
    esac
    case $line in
      *snakemake*) command -v snakemake >/dev/null || { echo "not run without snakemake: $line" && continue; } ;;
      *real-data*) [ -e real-data ] || { echo "not run without real data: $line" && continue; } ;;
    esac
    caseName="${page#"$ROOT"/}: $line"
    cases=$((cases + 1))
    SECONDS=0
    [ -n "${FULL:-}" ] || line=$(sed -E "$smaller" <<<"$line")
    bash -c "$line" >"$logs/out" 2>"$logs/err" </dev/null
    code=$?
    [ "$code" -eq 0 ] || fail "exit code $code"
    [ "$SECONDS" -lt 10 ] || echo "$SECONDS s: $line"
  done < <(blocks "$page" | grep -E '^(for .*)?pneuma |^\(cd [a-z]+ && snakemake ')
done
cd "$workFolder" || exit 1
caseName="all pages"
expect "only $shown commands on $pages pages were found" test "$pages" -ge 4 -a "$shown" -ge 35

# What a sentence calls a command is one.
caseName="commands that are named"
for page in "$ROOT"/README.md "$ROOT"/docs/*.md "$ROOT"/docs/guide/*.md "$ROOT"/docs/algorithms/*.md; do
  while read -r word; do
    cases=$((cases + 1))
    pneuma help "$word" >"$logs/out" 2>"$logs/err" || fail "${page#"$ROOT"/} names 'pneuma $word'"
  done < <(grep -ohE '`pneuma [a-z]+' "$page" | cut -d ' ' -f 2 | sort -u)
done
finish
