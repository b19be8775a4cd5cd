#!/usr/bin/env bash
# The completion scripts are valid in their shells, and bash's completes commands, options and values.
. "$(dirname "$0")/lib.sh"

for shell in bash zsh fish; do
  succeeds "completion $shell" completion "$shell"
  cp "$logs/out" "completion.$shell"
  command -v "$shell" >/dev/null && expect "$shell does not accept it" "$shell" -n "completion.$shell"
done

# completes "WORDS" EXPECTED: bash offers EXPECTED for the last word.
completes() {
  caseName="completing '$1'"
  cases=$((cases + 1))
  local offers
  offers=$(
    . ./completion.bash
    read -ra COMP_WORDS <<<"$1"
    [[ $1 == *' ' ]] && COMP_WORDS+=("")
    COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
    COMPREPLY=()
    _pneuma
    printf '%s\n' "${COMPREPLY[@]}"
  )
  grep -qx -- "$2" <<<"$offers" || fail "offered: $offers"
}

: >lobe.stl
completes "pneuma gr" grow
completes "pneuma grow --ter" --terminals
completes "pneuma grow --method " centroid
completes "pneuma grow --organ r" right-lung
completes "pneuma grow lo" lobe.stl
completes "pneuma render --colour-by str" strahler
completes "pneuma reproduce h" huang-2004
completes "pneuma reproduce kitaoka-1999 --table th" thorax
completes "pneuma stu" study
completes "pneuma compa" compare
completes "pneuma compare --pic" --picture
completes "pneuma compare --colour-by gen" generation
completes "pneuma study --se" --seeds
completes "pneuma help mea" measure
# The manual page has every command and every option of one, and man finds nothing to complain of.
succeeds "manual page" help --man
cp "$logs/out" pneuma.1
for command in $("$PNEUMA" help | sed -n 's/^  \([a-z]*\)  .*/\1/p'); do
  expect "$command is not in the manual page" grep -q "^.SS pneuma $command\$" pneuma.1
done
for option in $("$PNEUMA" help grow | grep -o -- '--[a-z-]*' | sort -u); do
  expect "$option is not in the manual page" grep -q -- "\\\\fB${option//-/\\\\-}\\\\fR" pneuma.1
done
if command -v groff >/dev/null; then
  caseName="roff"
  cases=$((cases + 1))
  said=$(groff -man -Tutf8 -ww pneuma.1 2>&1 >/dev/null | head -n 3)
  [ -z "$said" ] || fail "groff says: $said"
fi
refuses "the manual page of a command" 2 'man.*COMMAND|COMMAND.*man' help --man grow
finish
