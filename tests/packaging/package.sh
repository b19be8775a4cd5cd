#!/usr/bin/env bash
# The Debian package and the archive hold what they should, and what they hold works where it was unpacked.
# Needs CPACK, CONFIG (CPackConfig.cmake). Checks by lintian, desktop-file-validate and appstreamcli where they are.
set -u
: "${CPACK:?}" "${CONFIG:?}"
FOLDER=$(mktemp -d)
trap 'rm -rf "$FOLDER"' EXIT

fail() {
  echo "FAILED: $1"
  exit 1
}

cd "$FOLDER" || exit 1
"$CPACK" --config "$CONFIG" -B packages >cpack.log 2>&1 || fail "cpack: $(tail -n 5 cpack.log)"
deb=$(echo packages/*.deb)
dpkg-deb -x "$deb" "unpacked here" || fail "the package cannot be unpacked"
mkdir archive && tar -xzf packages/*.tar.gz -C archive --strip-components 1 || fail "the archive cannot be unpacked"

for root in "unpacked here/usr" archive; do
  for file in bin/pneuma bin/pneuma-desktop share/applications/org.pneuma.Pneuma.desktop \
    share/metainfo/org.pneuma.Pneuma.metainfo.xml share/mime/packages/org.pneuma.Pneuma.xml \
    share/icons/hicolor/scalable/apps/org.pneuma.Pneuma.svg share/man/man1/pneuma.1.gz share/man/man1/pneuma-desktop.1.gz \
    share/bash-completion/completions/pneuma share/zsh/vendor-completions/_pneuma \
    share/fish/vendor_completions.d/pneuma.fish share/doc/pneuma/copyright share/doc/pneuma/LICENSE share/pneuma/schemas/recipe.schema.json; do
    [ -s "$root/$file" ] || fail "$root lacks $file"
  done
  "$root/bin/pneuma" doctor >doctor.txt 2>&1 || fail "doctor of $root: $(tail -n 3 doctor.txt)"
  (cd "$root" && ./bin/pneuma sample "$FOLDER/chest" -q --force) || fail "the sample chest of $root"
done
size=$(stat -c %s "$deb")
[ "$size" -lt 30000000 ] || fail "the package has $size bytes"
for needed in libvtk9.1 libqt5widgets5 libopencv-core406 libtbb12; do
  dpkg-deb -f "$deb" Depends | grep -q "$needed" || fail "the package does not depend on $needed"
done
gzip -dc "unpacked here/usr/share/man/man1/pneuma.1.gz" | grep -q '^.SS pneuma grow' || fail "the manual page does not tell of grow"
if command -v lintian >/dev/null; then
  errors=$(lintian "$deb" 2>/dev/null | grep '^E:')
  [ -z "$errors" ] || fail "lintian: $errors"
fi
if command -v desktop-file-validate >/dev/null; then
  desktop-file-validate archive/share/applications/*.desktop || fail "the desktop file"
fi
if command -v appstreamcli >/dev/null; then
  appstreamcli validate --no-net archive/share/metainfo/*.xml >appstream.log 2>&1 || fail "the metainfo: $(cat appstream.log)"
fi
echo "packages hold what they should: $size bytes"
