#!/usr/bin/env bash
# The Debian package and the archive hold what they should, and what they hold works where it was unpacked.
# Needs CPACK, CONFIG (CPackConfig.cmake), JSON_CHECK (json_check), SCHEMAS. Checks by lintian, desktop-file-validate and appstreamcli where they are.
SCRIPT=$(realpath "$0")
. "$(dirname "$0")/lib.sh"
cd "$FOLDER" || exit 1
pack packages
deb=$(echo packages/*.deb)
dpkg-deb -x "$deb" "Lungenflügel hier" || fail "the package cannot be unpacked"
mkdir archive && tar -xzf packages/*.tar.gz -C archive --strip-components 1 || fail "the archive cannot be unpacked"

for root in "Lungenflügel hier/usr" archive; do
  for file in bin/pneuma bin/pneuma-desktop share/applications/org.pneuma.Pneuma.desktop \
    share/metainfo/org.pneuma.Pneuma.metainfo.xml share/mime/packages/org.pneuma.Pneuma.xml \
    share/thumbnailers/org.pneuma.Pneuma.thumbnailer \
    share/icons/hicolor/scalable/apps/org.pneuma.Pneuma.svg share/icons/hicolor/symbolic/apps/org.pneuma.Pneuma-symbolic.svg share/man/man1/pneuma.1.gz share/man/man1/pneuma-desktop.1.gz \
    share/bash-completion/completions/pneuma share/zsh/vendor-completions/_pneuma \
    share/fish/vendor_completions.d/pneuma.fish share/doc/pneuma/copyright share/doc/pneuma/LICENSE share/doc/pneuma/docs/guide/cohort.md share/doc/pneuma/examples/demo.sh share/doc/pneuma/sbom.spdx.json share/pneuma/schemas/recipe.schema.json; do
    [ -s "$root/$file" ] || fail "$root lacks $file"
  done
  for size in 16 22 24 32 48 64 128 256 512; do
    icon=$root/share/icons/hicolor/${size}x$size/apps/org.pneuma.Pneuma.png
    [ "$(od -An -t u1 -j 18 -N 2 "$icon" 2>/dev/null | awk '{ print $1 * 256 + $2 }')" = "$size" ] || fail "$icon is not $size pixels wide"
  done
  [ ! -e "$root/include" ] && [ ! -e "$root/lib" ] || fail "$root holds what only developers need"
  "$root/bin/pneuma" doctor >doctor.txt 2>&1 || fail "doctor of $root: $(tail -n 3 doctor.txt)"
  (cd "$root" && ./bin/pneuma sample "$FOLDER/chest" -q --force) || fail "the sample chest of $root"
done
size=$(stat -c %s "$deb")
[ "$size" -lt 30000000 ] || fail "the package has $size bytes"
for needed in libvtk9.1 libqt5widgets5 libopencv-core406 libtbb12; do
  dpkg-deb -f "$deb" Depends | grep -q "$needed" || fail "the package does not depend on $needed"
done
gzip -dc "Lungenflügel hier/usr/share/man/man1/pneuma.1.gz" | grep -q '^.SS pneuma grow' || fail "the manual page does not tell of grow"
# Every library that a program names is in the bill of materials, and everything that it names stands in it.
sbom=archive/share/doc/pneuma/sbom.spdx.json
"$JSON_CHECK" "$SCHEMAS/sbom.schema.json" "$sbom" || fail "the bill of materials breaks its form"
needed=$(for program in archive/bin/*; do objdump -p "$program" | awk '$1 == "NEEDED" { print $2 }'; done | sort -u)
[ "$(wc -l <<<"$needed")" -gt 20 ] || fail "the programs name too few libraries: $needed"
for library in $needed; do
  grep '"comment": "Shared libraries: ' "$sbom" | tr ':,.' '   ' | grep -qw -- "$(tr '.' ' ' <<<"$library")" || fail "the bill of materials lacks $library"
done
for library in Boost CGAL CLI11 Eigen nanoflann nlohmann-json; do
  grep -A 1 "\"name\": \"$library\"" "$sbom" | grep -Eq '"versionInfo": "[0-9]' || fail "the bill of materials lacks $library or its version"
done
grep -o '"relatedSpdxElement": "[^"]*"' "$sbom" | cut -d '"' -f 4 | while read -r id; do
  grep -q "\"SPDXID\": \"$id\"" "$sbom" || fail "the bill of materials relates to $id, which is not in it"
done || exit 1
# A project is known by its first bytes, whatever it is called.
if command -v update-mime-database >/dev/null && command -v gio >/dev/null; then
  cp "$(dirname "$SCRIPT")/../data/project_version_1.pneuma" nameless
  update-mime-database archive/share/mime >/dev/null 2>&1 || fail "the types of files cannot be taken over"
  known=$(XDG_DATA_HOME=$PWD/archive/share XDG_DATA_DIRS=/nowhere gio info -a standard::content-type nameless | awk '/content-type:/ { print $2 }')
  [ "$known" = application/x-pneuma ] || fail "a project is taken for $known"
fi
# What starts the program from a desktop.
for key in 'Exec=pneuma-desktop %F' 'TryExec=pneuma-desktop' 'Icon=org.pneuma.Pneuma' 'Actions=OpenFolder;SampleChest;' \
  'MimeType=application/x-pneuma;.*' 'StartupWMClass=.*' 'Keywords=lung;CT;DICOM;lobe;fissure;airway;bronchi;breathing;.*'; do
  grep -q "^$key$" archive/share/applications/*.desktop || fail "the desktop file lacks $key"
done
[ "$(grep -c '<caption>' archive/share/metainfo/*.xml)" -ge 3 ] || fail "the metainfo has fewer than three screenshots with captions"
! grep -q '@[A-Z]' archive/share/metainfo/*.xml || fail "the metainfo was not filled in"
if command -v lintian >/dev/null; then
  said=$(lintian --fail-on error "$deb" 2>&1) || fail "lintian: $(grep '^E:' <<<"$said" || echo "$said")"
fi
if command -v desktop-file-validate >/dev/null; then
  desktop-file-validate archive/share/applications/*.desktop || fail "the desktop file"
fi
if command -v appstreamcli >/dev/null; then
  appstreamcli validate --no-net archive/share/metainfo/*.xml >appstream.log 2>&1 || fail "the metainfo: $(cat appstream.log)"
fi
echo "packages hold what they should: $size bytes"
