#!/usr/bin/env bash
# Draws all pictures of tests/images again, writes pages with reference, new picture and difference to look at, and
# makes the new ones of those that differ the baselines. Review the pages and `git diff` before you commit.
#   packaging/update-baselines.sh [BUILDDIR]        (default: build/release, where pneuma is built)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=$(cd "${1:-build/release}" && pwd)
export PNEUMA=$build/app/cli/pneuma DESKTOP=$build/app/gui/pneuma-desktop OUT=$build/tests/images
export UPDATE=1 LIBGL_ALWAYS_SOFTWARE=1
mkdir -p "$OUT"
chmod 700 "$OUT" # the window wants its folder of sockets for itself
export XDG_RUNTIME_DIR=$OUT
for program in "$PNEUMA" "$DESKTOP"; do
  [[ -x $program ]] || { echo "build first: there is no $program"; exit 1; }
done
for what in inputs renders window; do
  xvfb-run -a -s "-screen 0 1600x1200x24" bash tests/images/images.sh $what
done
git status --short tests/images/baselines
