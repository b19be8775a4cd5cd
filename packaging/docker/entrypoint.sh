#!/bin/sh
# A display in memory, then pneuma in the place of this script, so that it hears what stops the container.
# Without one (no place for it, say) pneuma works all the same, and says so where it should draw.
if [ -z "${DISPLAY:-}" ]; then
  number=$(mktemp)
  Xvfb -displayfd 3 -screen 0 1600x1200x24 -nolisten tcp 3>"$number" >/dev/null 2>&1 &
  server=$!
  waited=0
  while [ ! -s "$number" ] && [ $waited -lt 100 ] && kill -0 $server 2>/dev/null; do
    sleep 0.05
    waited=$((waited + 1))
  done
  [ -s "$number" ] && DISPLAY=":$(cat "$number")" && export DISPLAY
  rm -f "$number"
fi
exec pneuma "$@"
