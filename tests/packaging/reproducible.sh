#!/usr/bin/env bash
# The same build packed twice gives the same bytes: at another time, in another zone, in another language and folder. Needs CPACK, CONFIG (CPackConfig.cmake).
. "$(dirname "$0")/lib.sh"
umask 022 # a Debian package tells of it in its own header, which is cpack's
pack "$FOLDER/one"
sleep 1.1 # times of files and archives are told in seconds
(
  export TZ=Asia/Tokyo LC_ALL=C.UTF-8
  pack "$FOLDER/an other"
) || exit 1
for package in "$FOLDER"/one/pneuma*; do
  cmp "$package" "$FOLDER/an other/$(basename "$package")" || fail "$(basename "$package") differs"
done
# Files and folders inside are everybody's, whatever the umask of who packs.
(umask 077 && pack "$FOLDER/private") || exit 1
cmp "$FOLDER"/one/*.tar.gz "$FOLDER"/private/*.tar.gz || fail "the archive depends on the umask"
[ "$(dpkg-deb -c "$FOLDER"/one/*.deb)" = "$(dpkg-deb -c "$FOLDER"/private/*.deb)" ] || fail "the package depends on the umask"
# Not by luck: names are in order, and nothing is newer than the release.
tar -tzf "$FOLDER"/one/*.tar.gz | LC_ALL=C sort -c || fail "the archive's order is that of some disk"
dpkg-deb --fsys-tarfile "$FOLDER"/one/*.deb | tar -t | LC_ALL=C sort -c || fail "the package's order is that of some disk"
times=$(TZ=UTC tar -tvzf "$FOLDER"/one/*.tar.gz | awk '{ print $4, $5 }' | sort -u)
[ "$(wc -l <<<"$times")" -eq 1 ] || fail "files have several times: $times"
(cd "$FOLDER/one" && sha256sum pneuma*)
