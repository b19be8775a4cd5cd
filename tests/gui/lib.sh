# For scripts that play others: a folder FOLDER of their own, which goes when they end, and fail SENTENCE.
FOLDER=$(mktemp -d)
export FOLDER
trap 'rm -rf "$FOLDER"' EXIT

fail() {
  echo "FAILED: $1"
  exit 1
}
