#!/usr/bin/env bash
# Pictures of a list, drawn again and compared; to be run under an X server.
# Needs JSON_CHECK (json_check) and SCHEMAS (resources/schemas).
. "$(dirname "$0")/lib.sh"

keeps() { expect "$2 breaks $1: $("$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$2" 2>&1 | head -n 3)" \
  "$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$2"; }
# list FILE PICTURE...: a list of these.
list() {
  local file=$1 text=
  shift
  for picture in "$@"; do text+=${text:+,}$picture; done
  echo "{\"schema\": \"pneuma/pictures/1\", \"size\": \"120x90\", \"pictures\": [$text]}" >"$file"
}

mkdir kept
fiveBalls kept/lobes
anterior='{"name": "anterior", "inputs": ["lobes"]}'
left='{"name": "left", "inputs": ["lobes"], "options": ["--view", "left", "--hide", "RUL"]}'
list kept/pictures.json "$anterior" "$left"
keeps pictures kept/pictures.json

ends "references that are missing" 3 regress kept -o page
expect "it does not say which" grep -q "2 references are missing, first 'kept/references/anterior.png'" "$logs/err"
expect "there is no page" test -s page/index.html -a -s page/left.new.png
expect "the folder of the pictures was written to" test ! -e kept/references
refuses "a page that is there" 6 "index.html.*exists" regress kept -o page
ends "the references are written" 0 regress kept -o page --update --force
expect "there are not two references" test "$(find kept/references -name '*.png' | wc -l)" -eq 2
succeeds "all is as it was" regress kept -o page -f
prints '^  left +0.0000 +0.0300  same$'
prints '^2 of 2 look as their references do; see page/index.html$'
succeeds "the result as JSON" regress kept -o page -f --json
cp "$logs/out" result.json
keeps regress result.json
succeeds "one of them" regress kept -o one --only left
expect "the other one was drawn too" test ! -e one/anterior.new.png
expect "a reference is not what render draws" test "$("$PNEUMA" render kept/lobes --size 120x90 -q -o a.png; cksum <a.png)" = "$(cksum <kept/references/anterior.png)"
refuses "a part of no name" 2 "only.*part of a picture's name" regress kept -o none --only middle

list kept/pictures.json "$anterior" '{"name": "left", "inputs": ["lobes"], "options": ["--view", "left"]}'
before=$(cksum kept/references/*)
ends "one that differs" 8 regress kept -o differs
expect "it does not say which" grep -q '^pneuma: over its limit: left: 0\.[0-9]*, the limit is 0.03$' "$logs/err"
expect "the page has no difference" test -s differs/left.difference.png -a -s differs/left.reference.png
expect "the page does not begin with it" awk '/id="left"/ { l = NR } /id="anterior"/ { a = NR } END { exit !(l < a) }' differs/index.html
expect "the page needs the network or a script" test -z "$(grep -Ei 'https?:|<script' differs/index.html)"
expect "references were changed" test "$before" = "$(cksum kept/references/*)"
ends "it is the reference from now on" 0 regress kept -o differs --update -f
prints '^  left +0\.[0-9]+ +0.0300  differs, updated$'
succeeds "it is" regress kept -o differs -f
list kept/pictures.json '{"name": "left", "inputs": ["lobes"], "limit": 0.9, "reason": "anything goes"}'
succeeds "a looser limit with its reason" regress kept -o loose
expect "the page does not tell the reason" grep -q 'anything goes' loose/index.html
sed -i 's/120x90/100x90/' kept/pictures.json
ends "a reference of another size" 8 regress kept -o size
expect "it does not say so" grep -q 'left: it has 100 x 90 pixels, its reference 120 x 90' "$logs/err"
list kept/other.json '{"name": "ready", "picture": "references/left.png", "reference": "references/left.png"}'
succeeds "a list of another name, a picture that is there" regress kept/other.json -o ready
DISPLAY= succeeds "which needs no display" regress kept/other.json -o ready -f
cd kept || exit 1
refuses "a page among the pictures" 2 "folder of the pictures" regress .
refuses "a list beside one" 2 "folder of the pictures" regress other.json -o page
cd .. || exit 1

# bad NAME REGEX PICTURE...: a list that is refused with 4.
bad() {
  local name=$1 regex=$2
  shift 2
  list kept/pictures.json "$@"
  refuses "$name" 4 "$regex" regress kept -o bad
}
bad "no picture" "lists no pictures"
bad "no name" "picture 1 has no \"name\"" '{"inputs": ["lobes"]}'
bad "a name that is a path" "is made of letters" '{"name": "a/b", "inputs": ["lobes"]}'
bad "a hidden name" "is made of letters" '{"name": ".a", "inputs": ["lobes"]}'
bad "a name twice" "\"anterior\" is there twice" "$anterior" "$anterior"
bad "an unknown key" "unknown key \"input\"; did you mean \"inputs\"" '{"name": "a", "input": ["lobes"]}'
bad "an unknown option" "\"a\": a picture has no option '--veiw'; did you mean '--view'" '{"name": "a", "inputs": ["lobes"], "options": ["--veiw", "left"]}'
bad "an option of the list" "has no option '--reference'" '{"name": "a", "inputs": ["lobes"], "options": ["--reference", "a.png"]}'
bad "a view that is none" "\"a\": .*sideways" '{"name": "a", "inputs": ["lobes"], "options": ["--view", "sideways"]}'
bad "options in one text" "list of texts under \"options\"" '{"name": "a", "inputs": ["lobes"], "options": "--view left"}'
bad "neither inputs nor a picture" "either \"inputs\"" '{"name": "a"}'
bad "both" "either \"inputs\"" '{"name": "a", "inputs": ["lobes"], "picture": "references/left.png"}'
bad "an absolute input" "stay in its folder" '{"name": "a", "inputs": ["/lobes"]}'
bad "an input above" "stay in its folder" '{"name": "a", "inputs": ["../lobes"]}'
bad "an input among the options" "stay in its folder" '{"name": "a", "inputs": ["lobes"], "options": ["../lobes"]}'
bad "labels above" "stay in its folder" '{"name": "a", "inputs": ["lobes"], "options": ["--labels", "../labels.nii"]}'
bad "a reference above" "stay in its folder" '{"name": "a", "inputs": ["lobes"], "reference": "../a.png"}'
bad "a reference of another kind" "no .png" '{"name": "a", "inputs": ["lobes"], "reference": "a.jpg"}'
bad "a looser limit without a reason" "no \"reason\"" '{"name": "a", "inputs": ["lobes"], "limit": 0.05}'
bad "a limit that is none" "\"limit\" that is no number" '{"name": "a", "inputs": ["lobes"], "limit": -1}'
list kept/pictures.json '{"name": "a", "inputs": ["nowhere"]}'
refuses "an input that is missing" 3 "\"a\" needs 'kept/nowhere'" regress kept -o bad
ln -s loop kept/loop
list kept/pictures.json '{"name": "a", "inputs": ["loop"]}'
refuses "an input that leads to itself" 3 "'kept/loop'" regress kept -o bad
echo "solid" >kept/lobes/broken.stl
list kept/pictures.json '{"name": "a", "inputs": ["lobes/broken.stl"]}'
refuses "an input that is damaged" 4 "\"a\" of 'kept/pictures.json' cannot be drawn: .*broken.stl" regress kept -o bad
rm kept/lobes/broken.stl
echo "no picture" >kept/references/a.png
list kept/pictures.json '{"name": "a", "inputs": ["lobes"]}'
refuses "a reference that is damaged" 4 "references/a.png.*not a PNG" regress kept -o bad
rm kept/references/a.png
ln -s ../../a.png kept/references/a.png
refuses "a reference that leads away is not written" 4 "leaves its folder" regress kept -o bad --update
echo "{" >kept/pictures.json
refuses "no JSON" 4 "no JSON near byte" regress kept -o bad
echo '{"schema": "pneuma/recipe/1"}' >kept/pictures.json
refuses "a list of another kind" 4 "pneuma/pictures/1" regress kept -o bad
mkdir empty
refuses "an empty folder" 3 "holds no pictures.json" regress empty -o bad
refuses "a folder that is missing" 3 "no folder or list 'nowhere'" regress nowhere -o bad
list kept/pictures.json "$anterior"
DISPLAY= refuses "no display" 10 "xvfb-run" regress kept -o bad
refuses "a page in no folder" 6 "nowhere" regress kept -o nowhere/page
finish
