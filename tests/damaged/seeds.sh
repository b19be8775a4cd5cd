#!/usr/bin/env bash
# seeds.sh FOLDER: sound files of every kind that Pneuma reads, small, to be damaged.
# Needs PNEUMA, the program, and AIRWAYS, a table of airways (resources/airways/thorax.json).
set -eu
export LC_ALL=C
: "${PNEUMA:?is the program}" "${AIRWAYS:?is a table of airways}"
rm -rf "$1"
mkdir -p "$1"
cd "$1"
seeds=$PWD
make() { "$PNEUMA" "$@" -q >/dev/null 2>log || { cat log >&2; exit 1; }; }

make sample chest --ct --spacing 5 --thick 10 --cell 6 --noise 0
mkdir ct nhdr mhd surface tree fissures breath

# The CT and its labels in every format, also with their voxels in a file of their own.
for format in nii nii.gz nrrd mha; do make import chest/ct.nii.gz -o ct/ct.$format; done
make segment ct/ct.nii -o ct/labels.nii.gz --surfaces lungs --triangles 600
make segment ct/ct.nii -o ct/labels.nrrd
voxels=$(($(wc -c <ct/ct.nii) - 352))
tail -c $voxels ct/ct.nii >nhdr/ct.raw
cp nhdr/ct.raw mhd/ct.raw
sed '/^$/q' ct/ct.nrrd | sed -e '/^$/d' -e 's/^encoding: .*/encoding: raw/' >nhdr/ct.nhdr
echo 'data file: ct.raw' >>nhdr/ct.nhdr
sed '/^ElementDataFile/q' ct/ct.mha | sed -e 's/^CompressedData = .*/CompressedData = False/' \
  -e '/^CompressedDataSize/d' -e 's/^ElementDataFile = .*/ElementDataFile = ct.raw/' >mhd/ct.mhd

# Lobes; one of them in every format of surfaces.
make lobes lungs --spacing 5 --fissures chest/fissures.json -o split
cp split/rml.vtp surface/s.vtp
for format in stl obj ply; do make export surface/s.vtp -o surface/s.$format; done
awk '$1 == "v" { n++; x[n] = $2 " " $3 " " $4 }
  $1 == "f" { m++; for (i = 2; i < 5; i++) { split($i, word, "/"); corner[m, i - 2] = word[1] } }
  END {
    print "solid lobe" >"surface/text.stl"
    printf "ply\nformat ascii 1.0\nelement vertex %d\nproperty double x\nproperty double y\nproperty double z\n" \
      "element face %d\nproperty list uchar int vertex_indices\nend_header\n", n, m >"surface/text.ply"
    printf "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n" \
      "<Piece NumberOfPoints=\"%d\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"%d\">\n" \
      "<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n", n, m >"surface/text.vtp"
    for (i = 1; i <= n; i++) { print x[i] >"surface/text.ply"; print x[i] >"surface/text.vtp" }
    print "</DataArray>\n</Points>\n<Polys>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">" >"surface/text.vtp"
    for (i = 1; i <= m; i++) {
      a = corner[i, 0]; b = corner[i, 1]; c = corner[i, 2]
      printf "facet normal 0 0 0\nouter loop\nvertex %s\nvertex %s\nvertex %s\nendloop\nendfacet\n", x[a], x[b], x[c] >"surface/text.stl"
      print 3, a - 1, b - 1, c - 1 >"surface/text.ply"
      print a - 1, b - 1, c - 1 >"surface/text.vtp"
    }
    print "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" >"surface/text.vtp"
    for (i = 1; i <= m; i++) print 3 * i >"surface/text.vtp"
    print "</DataArray>\n</Polys>\n</Piece>\n</PolyData>\n</VTKFile>" >"surface/text.vtp"
    print "endsolid lobe" >"surface/text.stl"
  }' surface/s.obj

# Airways: grown in the lobes, and central ones.
make grow split --terminals 30 --method centroid -o tree/t.vtp
for format in swc csv json; do make export chest/central.vtp -o tree/c.$format; done
awk '!/^#/ { n++; at[$1] = n - 1; x[n] = $3 " " $4 " " $5; r[n] = $6; parent[n] = $7 }
  END {
    printf "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n" \
      "<UnstructuredGrid>\n<Piece NumberOfPoints=\"%d\" NumberOfCells=\"%d\">\n<PointData>\n" \
      "<DataArray type=\"Float64\" Name=\"radius\" format=\"ascii\">\n", n, n - 1
    for (i = 1; i <= n; i++) print r[i]
    print "</DataArray>\n</PointData>\n<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">"
    for (i = 1; i <= n; i++) print x[i]
    print "</DataArray>\n</Points>\n<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">"
    for (i = 1; i <= n; i++) if (parent[i] > 0) print at[parent[i]], i - 1
    print "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">"
    for (i = 1; i < n; i++) print 2 * i
    print "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">"
    for (i = 1; i < n; i++) print 3
    print "</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>"
  }' tree/c.swc >tree/c.vtu

# Fissures in every format.
for format in json mrk.json fcsv csv; do make fissures split --points 8 -o fissures/f.$format; done
cat >fissures/planes.json <<'END'
{"schema": "pneuma/fissures/1", "space": "LPS", "units": "mm", "fissures": {
  "right-oblique": {"plane": {"point": [-75, 0, 0], "normal": [0, -0.7, 0.7]}},
  "right-horizontal": {"plane": {"point": [-75, -30, 20], "normal": [0, 0, 1]}},
  "left-oblique": {"plane": {"point": [75, 0, 0], "normal": [0, -0.7, 0.7]}}}}
END

# What steps are told by files.
cat >recipe.json <<END
{"schema": "pneuma/recipe/1", "open": {"ct": "$seeds/ct/ct.nii"}, "lungs": {"triangles": 600},
 "airways": {"method": "kitaoka", "terminals": 60}}
END
make run recipe.json -o case.pneuma
cat >edits.json <<'END'
{"schema": "pneuma/lung-edits/1", "space": "LPS", "units": "mm", "edits": [
  {"tool": "paint", "lung": "right", "shape": "ball", "radius_mm": 12, "points": [[-60.5, 12, 8], [-58, 15, 8]]},
  {"tool": "erase", "radius_mm": 8, "points": [[-60, 0, 0]]}]}
END
cp "$AIRWAYS" airways.json
awk 'BEGIN {
  print "exp_x,exp_y,exp_z,insp_x,insp_y,insp_z"
  for (n = 0; n < 60; n++) {
    x = 75 * (n % 2 == 0 ? -1 : 1) + 35 * sin(n * 1.7); y = 10 + 55 * sin(n * 2.9 + 1); z = 75 * sin(n * 0.7 + 2)
    printf "%.6f,%.6f,%.6f,%.6f,%.6f,%.6f\n", x, y, z, x * 1.05, y - 3, z - 8 - z * 0.05
  }
}' >marks.csv
awk 'BEGIN {
  print "exp_i,exp_j,exp_k,insp_i,insp_j,insp_k"
  for (n = 0; n < 60; n++) {
    i = 20 + n % 7; j = 22 + n % 5; k = 10 + n % 11
    print (n % 2 ? i : i + 22) "," j "," k "," (n % 2 ? i : i + 22) "," j "," k - 1
  }
}' >voxels.csv
make estimate lungs --landmarks marks.csv --gain 500 -o constants.json
awk 'BEGIN {
  print "seconds,pressure_cmH2O,volume_ml"
  for (i = 0; i <= 80; i++) {
    t = i / 20; v = t < 1.6 ? 250 * (1 - cos(3.14159 * t / 1.6)) : 500 * exp(-(t - 1.6) / 0.5)
    printf "%.3f,%.4f,%.3f\n", t, 5 + v / 100 + 0.5 * sin(t), v
  }
}' >breath.csv
awk 'BEGIN {
  print "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz"
  for (i = 0; i < 12; i++) printf "%.3f,%d,-900,0,0.70710678,0.70710678,0,0\n", i * 0.015, i
}' >poses.csv
for name in 'first case' second; do
  echo "$name,$PWD/ct/ct.nii.gz,$PWD/fissures/f.json,$PWD/recipe.json,1,\"a, b\""
done | sed '1i case,ct,fissures,recipe,series,group' >cases.csv
make breathe lungs --frames 2 -o breath/breath.pvd
if [ -n "${DISPLAY:-}" ]; then make render surface/s.vtp --size 160x120 -o picture.png; fi
rm -f log
