#!/usr/bin/env bash
# Dockerfile and Flatpak manifest, as far as they can be looked at without Docker and a Flatpak runtime: what they take
# is there, what they allow is no more than drawing, what they download has a checksum; and the container's entry works.
set -u
ROOT=$(cd "$(dirname "$0")/../.." && pwd)
. "$ROOT/tests/packaging/lib.sh"
cd "$ROOT" || exit 1

# --- Flatpak
manifest=packaging/flatpak/org.pneuma.Pneuma.yml
grep -q '^id: org.pneuma.Pneuma$' "$manifest" || fail "the manifest has another id than the metainfo"
grep -q '<id>org.pneuma.Pneuma</id>' packaging/linux/org.pneuma.Pneuma.metainfo.xml.in || fail "the metainfo has another id"
allowed=$(awk '/^finish-args:/ { on = 1; next } /^[^ ]/ { on = 0 } on { print $2 }' "$manifest" | sort | paste -sd ' ')
[ "$allowed" = "--device=dri --share=ipc --socket=fallback-x11 --socket=wayland" ] || fail "the manifest allows: $allowed"
awk '
  /^ +(- )?type: archive/ { archives++ }
  /^ +url: / { if ($2 !~ /^https:/) { print "no https: " $2; exit 1 } urls++; getline; if ($1 != "sha256:" || $2 !~ /^[0-9a-f]+$/ || length($2) != 64) { print "no checksum behind " $0; exit 1 } }
  /git|branch:/ && /type:/ { print "not an archive: " $0; exit 1 }
  END { if (archives < 10 || archives != urls) { print archives " archives, " urls " addresses"; exit 1 } }' "$manifest" || fail "the manifest's sources"
if python3 -c 'import yaml' 2>/dev/null; then
  python3 - "$manifest" <<'END' || fail "the manifest is no YAML of a Flatpak"
import sys, yaml
m = yaml.safe_load(open(sys.argv[1]))
assert m["runtime"] == "org.kde.Platform" and m["sdk"] == "org.kde.Sdk" and m["command"] == "pneuma-desktop"
assert not [a for a in m["finish-args"] if "network" in a or "filesystem" in a]
names = [module["name"] for module in m["modules"]]
assert len(set(names)) == len(names) and names[-1] == "pneuma"
for module in m["modules"]:
    assert module["sources"] and module.get("buildsystem", "autotools") in ("autotools", "cmake-ninja", "simple")
    for source in module["sources"]:
        assert source["type"] == "dir" or len(source["sha256"]) == 64, source
END
else
  echo "PyYAML is not installed: the manifest's form is not checked"
fi
if command -v flatpak-builder >/dev/null; then
  said=$(cd "$FOLDER" && flatpak-builder --show-manifest "$ROOT/$manifest" 2>&1 >/dev/null) && [ -z "$said" ] || fail "flatpak-builder does not take the manifest: $said"
fi

# --- container
docker=packaging/docker/Dockerfile
[ "$(grep -c '^FROM debian:bookworm' "$docker")" -eq 2 ] && [ "$(grep -c '^FROM' "$docker")" -eq 2 ] || fail "the stages are not of Debian 12"
for source in $(awk '$1 == "COPY" && $2 !~ /^--from/ { for (i = 2; i < NF; i++) print $i }' "$docker"); do
  [ -e "$source" ] || fail "the Dockerfile copies $source, which is not there"
  [ "$source" = . ] || ! grep -qx "${source%%/*}" .dockerignore || fail "$source is left out by .dockerignore"
done
[ "$(awk '$1 == "USER" { user = $2 } END { print user }' "$docker")" = pneuma ] || fail "the container works as root"
! grep -Eq 'curl|wget|http|^ADD' "$docker" || fail "the Dockerfile downloads something besides packages"
grep -q '^LABEL' "$docker" || fail "there are no labels"
awk '/^RUN/ { on = 1; sub(/^RUN /, "") } on { print } on && !/\\$/ { on = 0 }' "$docker" | bash -n || fail "a step of the Dockerfile is no shell"
entry=packaging/docker/entrypoint.sh
[ -x "$entry" ] && sh -n "$entry" || fail "the container's entry cannot be run"
# The entry: arguments, exit code and signals are pneuma's, with a display and without Xvfb.
mkdir "$FOLDER/bin"
cat >"$FOLDER/bin/pneuma" <<'END'
#!/bin/sh
echo "$DISPLAY|$1|$2|$$"
ps -o pid=,comm= --ppid $$ 2>/dev/null | while read -r child name; do [ "$name" != Xvfb ] || kill "$child"; done
exit 7
END
chmod +x "$FOLDER/bin/pneuma"
said=$(env -u DISPLAY PATH="$FOLDER/bin:$PATH" sh -c 'echo $$ >"$0"; exec "$@"' "$FOLDER/pid" "$ROOT/$entry" info "a file")
code=$?
[ $code -eq 7 ] || fail "the exit code is $code, not pneuma's"
shown='[|]info[|]a file[|]'$(cat "$FOLDER/pid")
if command -v Xvfb >/dev/null; then
  grep -Eq "^:[0-9]+$shown$" <<<"$said" || fail "with a display: $said"
fi
mkdir "$FOLDER/poor"
for tool in sh mktemp sleep cat rm; do ln -s "$(command -v $tool)" "$FOLDER/poor/$tool"; done
cp "$FOLDER/bin/pneuma" "$FOLDER/poor/pneuma"
said=$(env -i PATH="$FOLDER/poor" "$FOLDER/poor/sh" "$ROOT/$entry" doctor)
grep -q '^|doctor|' <<<"$said" || fail "without Xvfb: $said"
echo "Flatpak and container allow what they should"
