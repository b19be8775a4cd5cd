#!/usr/bin/env bash
# CTs: what is said of them, how they become a volume file, and how they lose their names.
# Needs MAKE_DICOM (make_dicom), JSON_CHECK (json_check) and SCHEMAS (resources/schemas).
. "$(dirname "$0")/lib.sh"

# keeps SCHEMA: what was printed last is as the schema says.
keeps() { expect "the JSON breaks $1: $("$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$logs/out" 2>&1 | head -n 3)" \
  "$JSON_CHECK" "$SCHEMAS/$1.schema.json" "$logs/out"; }

for way in sound gap tilt mr uneven two; do "$MAKE_DICOM" "$way" "$way"; done

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
succeeds "import of a volume" import ct.nrrd -o again.nrrd
expect "a volume changed on its way" cmp ct.nrrd again.nrrd

succeeds "anonymize" anonymize sound -o clean --key secret
prints '20 files of 1 series'
prints 'PatientName +20'
expect "a name is left" bash -c "! grep -rlq 'Doe^Jane' clean"
succeeds "info of anonymized files" info clean
succeeds "anonymize again, as JSON" anonymize sound -o clean2 --key secret --json
keeps anonymize
expect "the same key gives other files" diff -r clean clean2
echo secret >key
succeeds "anonymize with a key file" anonymize sound -o clean3 --key key
expect "the key's file gives other files than the key" diff -r clean clean3
succeeds "import of anonymized files" import clean -o clean.nrrd
expect "the pixels changed" cmp ct.nrrd clean.nrrd

refuses "a gap" 4 '2 slices are missing between S 118 mm and S 127 mm.*--fill-gaps' import gap -o x.nrrd
refuses "another modality" 5 'modality is MR' import mr -o x.nrrd
refuses "info of another modality" 5 'modality is MR' info mr
refuses "a series that is not there" 2 "no series '3'" import two -o x.nrrd --series 3
refuses "an unknown format" 5 'nii.gz' import sound -o x.png
refuses "an output that is there" 6 'exists already' import sound -o ct.nrrd
refuses "no folder" 3 'nowhere' import nowhere -o x.nrrd
refuses "a negative spacing" 2 'resample' import sound -o x.nrrd --resample -1
refuses "anonymize into a full folder" 6 'not an empty folder' anonymize sound -o clean
mkdir empty
refuses "anonymize nothing" 3 'no DICOM file' anonymize empty -o y
head -c 900 sound/004.dcm >sound/cut.dcm
refuses "anonymize a cut file" 4 'cut.dcm' anonymize sound -o y --key k
refuses "import with a cut file" 4 'cut.dcm' import sound -o x.nrrd
finish
