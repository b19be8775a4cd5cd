#!/usr/bin/env bash
# Breathing held to landmarks of people, from PNEUMA_TEST_DATA; without them, what is said then.
# Needs JSON_CHECK (json_check) and SCHEMAS (resources/schemas).
. "$(dirname "$0")/lib.sh"

data=${PNEUMA_TEST_DATA:-}
unset PNEUMA_TEST_DATA

refuses "no data" 3 "landmarks of people.*--data or PNEUMA_TEST_DATA" reproduce motion
PNEUMA_TEST_DATA='' refuses "an empty name for data" 3 "PNEUMA_TEST_DATA" reproduce motion
refuses "a folder that is not there" 3 "gone/motion_copdgene_case01" reproduce motion --data gone
mkdir -p damaged/motion_dirlab_4dct
printf 'ee_x,ee_y,ee_z,ei_x,ei_y,ei_z\n1,2,3,4,5\n' >damaged/motion_dirlab_4dct/case01_landmarks_mm.csv
refuses "a table cut off" 4 "case01.*line 2 has 5 values" reproduce motion --table quiet --data damaged
refuses "data that are not needed" 2 "huang-2004.*needs no data" reproduce huang-2004 --data damaged
refuses "figures that are none" 2 "no figures" reproduce motion --data damaged --pictures figures

if [ ! -d "$data/motion_copdgene_case01" ] || [ ! -d "$data/motion_dirlab_4dct" ]; then
  echo "PNEUMA_TEST_DATA has no landmarks of people"
  finish
fi

succeeds "a deep breath" reproduce motion --table deep --data "$data"
cat "$logs/out"
prints '^pneuma breathe, deep +nothing taken out '
prints 'shift taken out +22\.57 +2[0-9.]+ \+- .* ok '
prints 'typical error of position 7 to 10 mm'
succeeds "constants of one's own" reproduce motion --table fit --data "$data"
cat "$logs/out"
PNEUMA_TEST_DATA=$data succeeds "quiet breathing" reproduce motion --table quiet --json
expect "the JSON breaks the schema: $("$JSON_CHECK" "$SCHEMAS/reproduce.schema.json" "$logs/out" 2>&1 | head -n 3)" \
  "$JSON_CHECK" "$SCHEMAS/reproduce.schema.json" "$logs/out"
expect "a row is not ok" test "$(grep -c '"ok": false' "$logs/out")" -eq 0
finish
