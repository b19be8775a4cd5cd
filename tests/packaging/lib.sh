# Shared by the tests of packages. Usage: . lib.sh; needs CPACK and CONFIG (CPackConfig.cmake).
set -u
: "${CPACK:?}" "${CONFIG:?}"
FOLDER=$(mktemp -d)
trap 'rm -rf "$FOLDER"' EXIT

fail() {
  echo "FAILED: $1"
  exit 1
}

# pack FOLDER: makes both packages of what was built.
pack() { "$CPACK" --config "$CONFIG" -B "$1" >"$FOLDER/cpack.log" 2>&1 || fail "cpack: $(tail -n 5 "$FOLDER/cpack.log")"; }
