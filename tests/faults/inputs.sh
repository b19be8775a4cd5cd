# What the writers read: balls, a small chest with a CT, a tree and a project that breathes, into in/.
# Usage: . inputs.sh after lib.sh. As a test of its own it leaves them in FAULT_INPUTS, where the others
# find them.
made() { "$PNEUMA" "$@" -q >"$logs/out" 2>"$logs/err" </dev/null || fail "pneuma $* ended with $?"; }
caseName="inputs"
cases=$((cases + 1))
if [ -d "${FAULT_INPUTS:-}" ]; then
  cp -r "$FAULT_INPUTS/." in
  return
fi

ball 60 >in/ball.obj
made grow in/ball.obj --method centroid --terminals 30 -o in/tree.swc
made grow in/ball.obj --method centroid --terminals 40 -o in/other.swc
made sample in/chest --ct --cell 6 --spacing 4 --thick 8
made grow in/chest --method centroid --terminals 30 -o in/airways.vtp
printf 'exp_x,exp_y,exp_z,insp_x,insp_y,insp_z\n' >in/landmarks.csv
awk 'BEGIN { srand(1); for (i = 0; i < 60; i++) {
  x = 100 * (rand() - 0.5); y = 80 * (rand() - 0.5); z = 150 * (rand() - 0.5)
  printf "%.3f,%.3f,%.3f,%.3f,%.3f,%.3f\n", x, y, z, x * 1.05, y * 1.1, z * 1.15 - 5 } }' >>in/landmarks.csv
cat >in/recipe.json <<'END'
{"schema": "pneuma/recipe/1", "open": {"ct": "chest/ct.nii.gz"},
 "lungs": {"triangles": 2000}, "lobes": {"fissures": "chest/fissures.json", "spacing": 8},
 "airways": {"method": "centroid", "terminals": 30}}
END
made run in/recipe.json -o in/case.pneuma
# The breath is made in the window; as it stands in the project.
breath='{"scenario":"quiet","tidal":0,"period":2,"frames":2,"motion":"scenario","affected":"left","posture":"supine","model":"preset","fit":null,"person":null,"regions":[]}'
(
  mkdir in/raw && cd in/raw && cmake -E tar xf ../case.pneuma &&
    sed -i "s/\"breath\": null/\"breath\": $breath/" project.json &&
    cmake -E tar cf ../breathing.pneuma --format=zip -- *
) || fail "the project does not breathe"
rm -rf in/raw
