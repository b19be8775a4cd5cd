#!/usr/bin/env bash
# A bill of materials (SPDX 2.3, JSON) on the standard output: what the programs link, from the programs themselves.
#   packaging/sbom.sh VERSION PROGRAM... [-- NAME=VERSION=LICENCE[=DEBIAN-PACKAGE]...]
# Behind -- stand the libraries of headers only, which leave no trace in a program. Shared libraries are those that a
# program names itself (NEEDED), by the Debian packages that they are from; where there is no dpkg, by their own names.
# The same programs and packages give the same bytes: the time is SOURCE_DATE_EPOCH (0 without it), and the name of
# the document is a hash of all the rest.
set -euo pipefail
export LC_ALL=C
version=$1
shift
programs=()
while (($#)) && [[ $1 != -- ]]; do
  programs+=("$1")
  shift
done
(($# == 0)) || shift
headers=("$@")

text() { # a JSON string
  local s=${1//\\/\\\\}
  s=${s//\"/\\\"}
  s=${s//$'\t'/ }
  printf '"%s"' "${s//$'\n'/ }"
}

# spdx TEXT: Debian's short name of a licence as an expression of SPDX; NOASSERTION if a part of it has no known name.
spdx() {
  awk -v text="$1" 'BEGIN {
    split("apache-2.0 Apache-2.0 bsd-2-clause BSD-2-Clause bsd-3-clause BSD-3-Clause bsl-1.0 BSL-1.0 boost-1.0 BSL-1.0 " \
          "expat MIT mit MIT zlib Zlib gpl-2 GPL-2.0-only gpl-2+ GPL-2.0-or-later gpl-3 GPL-3.0-only gpl-3+ GPL-3.0-or-later " \
          "lgpl-2 LGPL-2.0-only lgpl-2+ LGPL-2.0-or-later lgpl-2.1 LGPL-2.1-only lgpl-2.1+ LGPL-2.1-or-later " \
          "lgpl-3 LGPL-3.0-only lgpl-3+ LGPL-3.0-or-later mpl-2.0 MPL-2.0", pairs, " ")
    for (i = 1; i in pairs; i += 2) known[pairs[i]] = pairs[i + 1]
    n = split(tolower(text), words, /[ ,]+/)
    for (i = 1; i <= n; i++) {
      if (words[i] == "or" || words[i] == "and") result = result " " toupper(words[i])
      else if (words[i] in known) result = result " " known[words[i]]
      else { print "NOASSERTION"; exit }
    }
    print n ? substr(result, 2) : "NOASSERTION"
  }'
}

# Of a machine-readable copyright file: the licence of "Files: *" on the first line, all names of licences on the second.
licences() {
  awk 'BEGIN { RS = ""; FS = "\n" }
    NR == 1 && $0 !~ /Format:/ { exit }
    {
      files = licence = ""
      for (i = 1; i <= NF; i++) {
        if ($i ~ /^Files:/) files = $i
        if ($i ~ /^License:/) { licence = $i; sub(/^License:[ \t]*/, "", licence); sub(/[ \t]+$/, "", licence) }
      }
      if (files ~ /^Files:[ \t]*\*/ && main == "") main = licence
      if (files != "" && licence != "" && !(licence in seen)) { seen[licence] = 1; all = all (all == "" ? "" : "; ") licence }
    }
    END { print main; print all }' "$1"
}

# debian PACKAGE: sets licence and remarks from what Debian says of the package.
debian() {
  local file=/usr/share/doc/${1%%:*}/copyright words
  licence=NOASSERTION
  remarks=""
  [[ -r $file ]] || return 0
  mapfile -t words < <(licences "$file")
  if [[ -n ${words[0]:-} ]]; then
    licence=$(spdx "${words[0]}")
    remarks="Debian's copyright file names: ${words[1]}"
  else
    remarks="Debian's copyright file is not machine-readable: $file"
  fi
}

# Where every NEEDED library is, and which package has it.
declare -A sonames=() # by package
needed=$(for program in "${programs[@]}"; do objdump -p "$program" | awk '$1 == "NEEDED" { print $2 }'; done | sort -u)
where=$(for program in "${programs[@]}"; do ldd "$program" | awk '$2 == "=>" { print $1, $3 } $1 ~ /^\// { n = split($1, parts, "/"); print parts[n], $1 }'; done | sort -u)
# A library may be known below /lib, /usr/lib or by what a link stands for.
mapfile -t known < <(awk '$2 != "not" { print $2 }' <<<"$where" | sort -u)
owners=$({ printf '%s\n' "${known[@]}" "${known[@]/#/\/usr}" "${known[@]#/usr}" && realpath "${known[@]}"; } | sort -u |
  xargs -d '\n' dpkg-query -S 2>/dev/null || true)
for soname in $needed; do
  path=$(awk -v name="$soname" '$1 == name { print $2; exit }' <<<"$where")
  if [[ -z $path || $path == not ]]; then
    echo "sbom.sh: $soname is not installed here; build and pack on one machine" >&2
    exit 1
  fi
  package=""
  for name in "$path" "/usr$path" "${path#/usr}" "$(realpath "$path")"; do
    package=$(awk -F ': ' -v name="$name" '$2 == name { print $1; exit }' <<<"$owners")
    [[ -z $package ]] || break
  done
  package=${package:-$soname}
  sonames[$package]="${sonames[$package]:+${sonames[$package]}, }$soname"
done

packages=""
relations=""
count=0
# add NAME VERSION LICENCE PURL SUPPLIER RELATION COMMENT REMARKS
add() {
  local id="SPDXRef-$count-$(tr -c 'A-Za-z0-9.\n' '-' <<<"$1")"
  count=$((count + 1))
  packages+=",
    {
      \"SPDXID\": \"$id\",
      \"name\": $(text "$1"),
      \"versionInfo\": $(text "$2"),
      \"supplier\": $(text "$5"),
      \"downloadLocation\": \"NOASSERTION\",
      \"filesAnalyzed\": false,
      \"licenseConcluded\": \"NOASSERTION\",
      \"licenseDeclared\": $(text "$3"),
      \"copyrightText\": \"NOASSERTION\",
      \"primaryPackagePurpose\": \"LIBRARY\",
      \"comment\": $(text "$7")"
  [[ -z $8 ]] || packages+=",
      \"licenseComments\": $(text "$8")"
  [[ -z $4 ]] || packages+=",
      \"externalRefs\": [{\"referenceCategory\": \"PACKAGE-MANAGER\", \"referenceType\": \"purl\", \"referenceLocator\": $(text "$4")}]"
  packages+="
    }"
  relations+=",
    {\"spdxElementId\": \"SPDXRef-pneuma\", \"relationshipType\": \"$6\", \"relatedSpdxElement\": \"$id\"}"
}

# purl NAME VERSION ARCHITECTURE: a package of Debian, as package URLs have it.
purl() { echo "pkg:deb/debian/${1//+/%2B}@$(sed 's/+/%2B/g; s/:/%3A/g; s/~/%7E/g' <<<"$2")?arch=$3"; }

while read -r package; do
  [[ -n $package ]] || continue
  if told=$(dpkg-query -W -f '${Package} ${Version} ${Architecture} ${source:Package} ${source:Version}' "$package" 2>/dev/null); then
    read -r name has architecture source sourceVersion <<<"$told"
    debian "$name"
    add "$name" "$has" "$licence" "$(purl "$name" "$has" "$architecture")" "Organization: Debian" DYNAMIC_LINK \
      "Shared libraries: ${sonames[$package]}. Built by Debian from $source $sourceVersion." "$remarks"
  else
    add "$package" NOASSERTION NOASSERTION "" NOASSERTION DYNAMIC_LINK "Shared libraries: ${sonames[$package]}." ""
  fi
done < <(printf '%s\n' "${!sonames[@]}" | sort)

for library in "${headers[@]}"; do
  IFS='=' read -r name has licence package <<<"$library"
  reference="" supplier=NOASSERTION comment="Headers only: compiled into the programs."
  if [[ -n $package ]] && told=$(dpkg-query -W -f '${Version} ${Architecture}' "$package" 2>/dev/null); then
    read -r debianVersion architecture <<<"$told"
    reference=$(purl "$package" "$debianVersion" "$architecture") supplier="Organization: Debian"
    comment+=" From Debian's package $package $debianVersion."
  fi
  add "$name" "$has" "$licence" "$reference" "$supplier" STATIC_LINK "$comment" ""
done

body="  \"packages\": [
    {
      \"SPDXID\": \"SPDXRef-pneuma\",
      \"name\": \"pneuma\",
      \"versionInfo\": $(text "$version"),
      \"supplier\": \"Organization: The Pneuma developers\",
      \"downloadLocation\": \"NOASSERTION\",
      \"filesAnalyzed\": false,
      \"licenseConcluded\": \"GPL-3.0-or-later\",
      \"licenseDeclared\": \"GPL-3.0-or-later\",
      \"copyrightText\": \"2026 The Pneuma developers\",
      \"primaryPackagePurpose\": \"APPLICATION\",
      \"comment\": $(text "Programs: $(basename -a "${programs[@]}" | paste -sd ' ')")
    }$packages
  ],
  \"relationships\": [
    {\"spdxElementId\": \"SPDXRef-DOCUMENT\", \"relationshipType\": \"DESCRIBES\", \"relatedSpdxElement\": \"SPDXRef-pneuma\"}$relations
  ]"
created=$(date -u -d "@${SOURCE_DATE_EPOCH:-0}" +%Y-%m-%dT%H:%M:%SZ)
cat <<END
{
  "spdxVersion": "SPDX-2.3",
  "dataLicense": "CC0-1.0",
  "SPDXID": "SPDXRef-DOCUMENT",
  "name": "pneuma-$version",
  "documentNamespace": "https://pneuma.example/spdx/pneuma-$version-$(sha256sum <<<"$created$body" | cut -c1-64)",
  "creationInfo": {
    "created": "$created",
    "creators": ["Organization: The Pneuma developers", "Tool: pneuma-sbom.sh"],
    "comment": "What the programs link themselves; what those libraries link in turn is told by the packages of Debian."
  },
$body
}
END
