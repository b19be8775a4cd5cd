#!/usr/bin/env bash
# Packs two builds and says whether their packages are the same bytes, or where they differ.
#   packaging/compare-builds.sh BUILD1 BUILD2
# Both are build folders of one commit, made by one compiler at any paths. Exit code 0: equal; 1: not; 2: usage.
set -euo pipefail
export LC_ALL=C
umask 022
if (($# != 2)) || [[ ! -f $1/CPackConfig.cmake || ! -f $2/CPackConfig.cmake ]]; then
  echo "usage: packaging/compare-builds.sh BUILD1 BUILD2 (build folders, with a CPackConfig.cmake)" >&2
  exit 2
fi
builds=("$(realpath "$1")" "$(realpath "$2")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for n in 0 1; do
  cpack --config "${builds[n]}/CPackConfig.cmake" -B "$work/$n" >"$work/log" 2>&1 || {
    tail -n 5 "$work/log" >&2
    exit 1
  }
  rm -rf "$work/$n/_CPack_Packages"
done

different=0
diff <(ls "$work/0") <(ls "$work/1") || {
  echo "DIFFERENT: there are other packages"
  different=1
}
for package in "$work"/0/*; do
  name=$(basename "$package")
  if cmp -s "$package" "$work/1/$name"; then
    echo "equal: $name $(sha256sum <"$package" | cut -c1-64)"
  else
    echo "DIFFERENT: $name"
    different=1
  fi
done
((different)) || exit 0

# Which files, and of a program which part and which text.
for n in 0 1; do
  mkdir "$work/files$n"
  tar -xzf "$work/$n"/*.tar.gz -C "$work/files$n" --strip-components 1
  tar -tvzf "$work/$n"/*.tar.gz >"$work/list$n"
done
echo "-- order, times and rights of the files in the archive"
diff "$work/list0" "$work/list1" | head -n 20 || true
while read -r file; do
  echo "-- $file"
  if readelf -h "$work/files0/$file" >/dev/null 2>&1; then
    for n in 0 1; do
      readelf -SW "$work/files$n/$file" | awk '/^ +\[ *[0-9]+\] [.]/ { sub(/^ +\[ *[0-9]+\] /, ""); print $1 }' | while read -r section; do
        objcopy -O binary --only-section="$section" --set-section-flags "$section=alloc" "$work/files$n/$file" "$work/section" 2>/dev/null || continue
        echo "$section $(sha256sum <"$work/section" | cut -c1-16)"
      done >"$work/sections$n"
      strings -a "$work/files$n/$file" | sort -u >"$work/strings$n"
    done
    echo "   sections: $(diff "$work/sections0" "$work/sections1" | awk '/^</ { print $2 }' | paste -sd ' ')"
    diff "$work/strings0" "$work/strings1" | grep '^[<>]' | head -n 20 || true
  else
    diff "$work/files0/$file" "$work/files1/$file" | head -n 20 || true
  fi
done < <(cd "$work/files0" && find . -type f | sort | while read -r file; do cmp -s "$file" "$work/files1/$file" || echo "$file"; done)

echo "-- objects and libraries of the builds that differ"
(cd "${builds[0]}" && find modules app -name '*.o' -o -name '*.a' | sort) | while read -r object; do
  cmp -s "${builds[0]}/$object" "${builds[1]}/$object" || echo "   $object"
done | head -n 40
exit 1
