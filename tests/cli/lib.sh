# Shared by the tests of the command line. Usage: . lib.sh; needs PNEUMA, the program under test.
# Every test works in an empty folder of its own that goes away in the end.

set -u
export LC_ALL=C
: "${PNEUMA:?is the program under test}"
workFolder=$(mktemp -d)
logs=$(mktemp -d)
trap 'chmod -R u+w "$workFolder"; rm -rf "$workFolder" "$logs"' EXIT
cd "$workFolder" || exit 1
cases=0
failures=0

fail() {
  failures=$((failures + 1))
  echo "FAILED: $caseName: $1"
  sed 's/^/    out: /' "$logs/out" | head -n 5
  sed 's/^/    err: /' "$logs/err" | head -n 5
}

run() {
  "$PNEUMA" "$@" >"$logs/out" 2>"$logs/err" </dev/null
  code=$?
}

# refuses NAME CODE REGEX ARGUMENT...: the program ends with CODE and one sentence that matches
# REGEX, prints no result and leaves every folder as it was.
refuses() {
  caseName=$1
  local wanted=$2 regex=$3 before after
  shift 3
  cases=$((cases + 1))
  before=$(find . | sort)
  run "$@"
  after=$(find . | sort)
  [ "$code" -eq "$wanted" ] || fail "exit code $code, not $wanted"
  [ "$(wc -l <"$logs/err")" -eq 1 ] || fail "$(wc -l <"$logs/err") lines on standard error, not one"
  grep -q '^pneuma: ' "$logs/err" || fail "the sentence does not start with 'pneuma: '"
  grep -Eiq -- "$regex" "$logs/err" || fail "the sentence does not match /$regex/"
  [ -s "$logs/out" ] && fail "there is a result on standard output"
  [ "$before" = "$after" ] || fail "files came or went: $(diff <(echo "$before") <(echo "$after"))"
}

# ends NAME CODE ARGUMENT...: the program ends with CODE; what it says is in $logs/out and $logs/err.
ends() {
  caseName=$1
  local wanted=$2
  shift 2
  cases=$((cases + 1))
  run "$@"
  [ "$code" -eq "$wanted" ] || fail "exit code $code, not $wanted"
}

# succeeds NAME ARGUMENT...: the program ends with 0; standard output is in $logs/out.
succeeds() { ends "$1" 0 "${@:2}"; }

# expect TEXT COMMAND...: COMMAND must succeed.
expect() {
  local what=$1
  shift
  cases=$((cases + 1))
  "$@" >/dev/null 2>&1 || fail "$what"
}

prints() { grep -Eq -- "$1" "$logs/out" || fail "the output does not match /$1/"; }

finish() {
  if [ "$cases" -eq 0 ]; then
    echo "no case was run"
    exit 1
  fi
  echo "$((cases - failures)) of $cases cases passed"
  [ "$failures" -eq 0 ]
  exit
}

# ball RADIUS [X Y Z]: a closed, outward ball of 24 x 12 faces as OBJ, in the units of RADIUS.
ball() {
  awk -v r="$1" -v x="${2:-0}" -v y="${3:-0}" -v z="${4:-0}" 'BEGIN {
    pi = atan2(0, -1); n = 24; m = 12
    printf "v %.9g %.9g %.9g\nv %.9g %.9g %.9g\n", x, y, z + r, x, y, z - r
    for (i = 1; i < m; i++) for (j = 0; j < n; j++) {
      t = pi * i / m; p = 2 * pi * j / n
      printf "v %.9g %.9g %.9g\n", x + r * sin(t) * cos(p), y + r * sin(t) * sin(p), z + r * cos(t)
    }
    for (j = 0; j < n; j++) {
      k = (j + 1) % n; last = 3 + n * (m - 2)
      printf "f 1 %d %d\nf 2 %d %d\n", 3 + j, 3 + k, last + k, last + j
    }
    for (i = 1; i < m - 1; i++) for (j = 0; j < n; j++) {
      k = (j + 1) % n; a = 3 + n * (i - 1); b = a + n
      printf "f %d %d %d\nf %d %d %d\n", a + j, b + j, b + k, a + j, b + k, a + k
    }
  }'
}

# fiveBalls FOLDER: five balls that stand for lobes, side by side.
fiveBalls() {
  mkdir -p "$1"
  ball 45 -60 0 60 >"$1/rul.obj"
  ball 30 -60 -60 0 >"$1/rml.obj"
  ball 45 -60 20 -60 >"$1/rll.obj"
  ball 45 60 0 60 >"$1/lul.obj"
  ball 45 60 20 -60 >"$1/lll.obj"
}
