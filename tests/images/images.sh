#!/usr/bin/env bash
# The pictures of a list against their baselines: images.sh inputs | renders | window | defects, in this order.
# Needs PNEUMA, DESKTOP (of window), OUT (a folder for inputs and pages) and an X server. UPDATE=1 writes the
# baselines anew, for packaging/update-baselines.sh.
set -u
here=$(cd "$(dirname "$0")" && pwd)
: "${PNEUMA:?is the program under test}" "${OUT:?is a folder}"
inputs=$OUT/inputs
stop() { echo "FAILED: $1"; exit 1; }

# compared LIST: draws a list again; its page stays in $OUT.
compared() {
  local list=$1
  rm -rf "${OUT:?}/$list"
  cp "$here/$list.json" "$inputs/" || exit 1
  "$PNEUMA" regress "$inputs/$list.json" -o "$OUT/$list" ${UPDATE:+--update} -q >"$OUT/$list.txt"
  local code=$?
  cat "$OUT/$list.txt"
  [ -z "${UPDATE:-}" ] || cp "$inputs"/baselines/*.png "$here/baselines/"
  echo "the page: $OUT/$list/index.html"
  return $code
}

case ${1:-} in
  inputs) # once for each program; the baselines anew each time
    if [ ! "$inputs/made" -nt "$PNEUMA" ] || [ ! "$inputs/made" -nt "$here/inputs.sh" ]; then
      rm -rf "$inputs"
      mkdir -p "$OUT"
      bash "$here/inputs.sh" "$inputs" || exit 1
      touch "$inputs/made"
    fi
    rm -rf "$inputs/baselines"
    cp -r "$here/baselines" "$inputs/"
    ;;
  renders) compared pictures ;;
  window)
    rm -rf "$inputs/shots"
    IMAGES=$inputs "$DESKTOP" --play "$here/window_steps.json" --screenshots "$inputs/shots" || stop "the window"
    compared window
    ;;
  defects) # each has something wrong that the comparison has to notice
    count=$(grep -c '"name"' "$here/defects.json")
    compared defects 2>"$OUT/defects.log"
    [ $? -eq 8 ] || stop "pictures with defects passed: $(cat "$OUT/defects.log")"
    noticed=$(grep -c '^pneuma: over its limit: ' "$OUT/defects.log")
    [ "$noticed" -eq "$count" ] || stop "$noticed of $count defects were noticed: $(grep ' same$' "$OUT/defects.txt")"
    echo "$noticed of $count defects were noticed"
    ;;
  *) stop "the first word is inputs, renders, window or defects" ;;
esac
