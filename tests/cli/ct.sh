#!/usr/bin/env bash
# CTs: what is said of them, how they become a volume file, and how they lose their names.
# Needs MAKE_DICOM (make_dicom), JSON_CHECK (json_check) and SCHEMAS (resources/schemas).
. "$(dirname "$0")/lib.sh"

# keeps SCHEMA: what was printed last is as the schema says.
keeps() { expect "the JSON breaks $1: $("$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$logs/out" 2>&1 | head -n 3)" \
  "$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$logs/out"; }

for way in sound gap tilt mr uneven two head far; do "$MAKE_DICOM" "$way" "$way"; done

succeeds "info" info sound
prints '^sound: DICOM CT$'
prints '12 x 10 x 20 voxels'
prints '2.000 x 2.000 x 3.000 mm'
prints 'towards left, back, head'
expect "a name is printed unasked" bash -c "! grep -q 'Doe' '$logs/out'"
succeeds "info with names" info sound --phi
prints 'PatientName: Doe\^Jane'
succeeds "info as JSON" info sound --json
keeps info
expect "a name is in the JSON unasked" bash -c "! grep -q 'Doe' '$logs/out'"
succeeds "info of a gap" info gap
prints '2 slices are missing between S 118 mm and S 127 mm'
succeeds "info of a tilt" info tilt --json
keeps info
prints '"tilt_deg": 11.3'
succeeds "info of two series" info two
prints '^ +2 '
succeeds "info of one file" info sound/003.dcm
prints '12 x 10 x 20 voxels'

for extension in nii.gz nii nrrd mha; do
  succeeds "import to $extension" import sound -o "ct.$extension"
  succeeds "info of $extension" info "ct.$extension" --json
  keeps info
  prints '"percentile_1": -8'
done
succeeds "import as JSON" import sound -o json.nrrd --json
keeps import
succeeds "import with gaps filled" import gap -o filled.nrrd --fill-gaps
expect "there is no warning of the slices made up" grep -q 'interpolated from their neighbours' "$logs/err"
expect "a filled gap differs from the truth" cmp ct.nrrd filled.nrrd
succeeds "import with the tilt undone" import tilt -o straight.nrrd --fix-tilt
succeeds "info of what was straightened" info straight.nrrd
prints 'gantry tilt +0.0 deg'
succeeds "import resampled" import uneven -o cubes.mha --resample 1.5mm
succeeds "info of what was resampled" info cubes.mha
prints '1.500 x 1.500 x 1.500 mm'
succeeds "import of the second series" import two -o second.nrrd --series 2
prints '12 x 10 x 5 voxels'
succeeds "import of a series by UID" import two -o uid.nrrd --series 1.2.826.0.1.3680043.9.2
expect "another series came by UID" cmp second.nrrd uid.nrrd
kept=series-$(printf 1.2.826.0.1.3680043.9.2 | sha256sum | cut -c 1-16) # as projects and recipes name it
succeeds "import of a series by the name that is kept" import two -o kept.nrrd --series "$kept"
expect "another series came by its name" cmp second.nrrd kept.nrrd
succeeds "import of another part of the body when asked" import head -o head.nrrd --series 1
succeeds "import of a volume" import ct.nrrd -o again.nrrd
expect "a volume changed on its way" cmp ct.nrrd again.nrrd

succeeds "anonymize" anonymize sound -o clean --key "a secret"
prints '20 files of 1 series'
prints 'PatientName +20'
expect "a name is left" bash -c "! grep -rlq 'Doe^Jane' clean"
succeeds "info of anonymized files" info clean
succeeds "anonymize again, as JSON" anonymize sound -o clean2 --key "a secret" --json
keeps anonymize
expect "the same key gives other files" diff -r clean clean2
echo "a secret" >keyfile
succeeds "anonymize with a key file" anonymize sound -o clean3/ --key-file keyfile
expect "the key's file gives other files than the key" diff -r clean clean3
cp -r sound mixed
ln -s loop mixed/loop
: >mixed/notes.txt
printf 'PK\3\4 a document' >mixed/notes.docx
succeeds "anonymize beside other files" anonymize mixed -o clean4 --key "a secret" --json
keeps anonymize
prints '"left_out": 2'
prints '2 files that are no DICOM were left out'
expect "other files make others" diff -r clean clean4
succeeds "info of a folder with a link to itself" info mixed
succeeds "import of anonymized files" import clean -o clean.nrrd
expect "the pixels changed" cmp ct.nrrd clean.nrrd

mkfifo gap/pipe.dcm
refuses "a pipe among slices, by its name" 3 "pipe.dcm. is a device or a pipe" import gap/pipe.dcm -o x.nrrd --fill-gaps
rm gap/pipe.dcm
refuses "a gap" 4 '2 slices are missing between S 118 mm and S 127 mm.*--fill-gaps' import gap -o x.nrrd
refuses "another modality" 5 'modality is MR' import mr -o x.nrrd
refuses "info of another modality" 5 'modality is MR' info mr
refuses "another part of the body" 5 'not of the chest.*HEAD.*import --series 1' import head -o x.nrrd
refuses "slices beyond all measure" 4 'position or direction that is no number' import far -o x.nrrd
refuses "a header apart from its voxels" 5 'nii.gz, .nii, .nrrd or .mha' import sound -o x.nhdr
refuses "labels with a header apart" 5 'nii.gz, .nii, .nrrd or .mha' segment sound -o x.mhd
refuses "an output that is the input" 2 'same file' import ct.nrrd -o ct.nrrd --force
refuses "an output that is the input by another path" 2 'same file' import ct.nrrd -o "../${PWD##*/}/ct.nrrd" --force
refuses "labels onto their CT" 2 'same file' segment ct.nrrd -o ct.nrrd --force
refuses "surfaces below no folder" 6 'does not exist' segment sound --surfaces x/y/z
refuses "surfaces in a file" 6 'not a folder' segment sound --surfaces ct.nrrd
longName=$(printf 'a%.0s' {1..300})
refuses "surfaces with too long a name" 6 'name is too long' segment sound --surfaces "$longName"
refuses "a CT with too long a name" 3 'too long; check its name' info "$longName.nrrd"
refuses "a folder with too long a name" 3 'too long; check' import "$longName" -o x.nrrd
refuses "a series that is not there" 2 "no series '3'" import two -o x.nrrd --series 3
succeeds "info of the second series" info two --series 2
prints '12 x 10 x 5 voxels'
refuses "info of a series that is not there" 2 "no series '3'" info two --series 3
refuses "an unknown format" 5 'nii.gz' import sound -o x.png
refuses "an output that is there" 6 'exists already' import sound -o ct.nrrd
refuses "no folder" 3 'nowhere' import nowhere -o x.nrrd
refuses "a negative spacing" 2 'resample' import sound -o x.nrrd --resample -1
refuses "anonymize into a full folder" 6 'not an empty folder' anonymize sound -o clean
mkdir empty
refuses "a short key" 2 'shorter than 8 characters' anonymize sound -o y --key 1234567
refuses "an empty key" 2 'shorter than 8 characters' anonymize sound -o y --key ''
refuses "a key file as key" 2 'is a file.*--key-file' anonymize sound -o y --key keyfile
refuses "a key file that is not there" 3 'no file.*such/key.txt' anonymize sound -o y --key-file /no/such/key.txt
echo short >shortkey
refuses "a key file with a short key" 4 'shortkey.*shorter than 8' anonymize sound -o y --key-file shortkey
refuses "key and key file" 2 'key' anonymize sound -o y --key "a secret" --key-file keyfile
refuses "anonymized into no folder" 6 'does not exist' anonymize sound -o x/y --key "a secret"
refuses "anonymize nothing" 3 'no DICOM file' anonymize empty -o y
head -c 900 sound/004.dcm >sound/cut.dcm
refuses "anonymize a cut file" 4 'cut.dcm' anonymize sound -o y --key "a secret"
refuses "import with a cut file" 4 'cut.dcm' import sound -o x.nrrd
finish
