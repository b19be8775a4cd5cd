// seeds FOLDER: small sound files of every format into FOLDER/<target>/, and the project that the
// target project-member needs as FOLDER/case.pneuma.
#include <cstdio>
#include <exception>
#include <fstream>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/fissure_file.h"
#include "io/member_archive.h"
#include "io/surface_file.h"
#include "io/tree_file.h"
#include "io/volume_file.h"
#include "pipeline/case_parts.h"
#include "pipeline/project.h"
#include "support/dicom_maker.h"
#include "support/sample_trees.h"
#include "targets.h"

namespace fs = std::filesystem;
using namespace pneuma;

namespace {

class Seeds {
 public:
  explicit Seeds(fs::path folder) : folder_(std::move(folder)) {
    for (const fuzz::Target& target : fuzz::targets())
      fs::create_directories(folder_ / target.name);
  }

  fs::path path(const std::string& target, const std::string& name) const {
    return folder_ / target / name;
  }

  void put(const std::string& target, const std::string& name, const std::string& text) const {
    writeFile(path(target, name), text);
  }

 private:
  fs::path folder_;
};

TriangleMesh tetrahedron() {
  TriangleMesh mesh;
  mesh.points = {Vec3(-99.5, 0, 0), Vec3(-10, 0, 0), Vec3(-50, 80, 0), Vec3(-50, 30, 90)};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return mesh;
}

void putVolumes(const Seeds& seeds) {
  CtImage ct;
  ct.geometry.size = {4, 5, 3};
  ct.geometry.spacing = Vec3(1.0, 1.0, 2.5);
  LabelImage labels;
  labels.geometry = ct.geometry;
  for (std::size_t i = 0; i < ct.geometry.voxelCount(); ++i) {
    ct.voxels.push_back(static_cast<std::int16_t>(-1000 + 20 * static_cast<int>(i)));
    labels.voxels.push_back(static_cast<std::uint8_t>(i % 6));
  }
  for (const auto& [target, endings] : std::map<std::string, std::vector<std::string>>{
           {"nifti", {".nii", ".nii.gz"}}, {"nrrd", {".nrrd"}}, {"mha", {".mha"}}}) {
    for (const std::string& ending : endings) {
      writeVolume(seeds.path(target, "ct" + ending), ct);
      writeVolume(seeds.path(target, "labels" + ending), labels);
    }
  }
  const std::string voxels(reinterpret_cast<const char*>(ct.voxels.data()), 2 * ct.voxels.size());
  seeds.put("nrrd", "raw.nrrd",
            "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 4 5 3\n"
            "space directions: (1,0,0) (0,1,0) (0,0,2.5)\nkinds: domain domain domain\n"
            "endian: little\nencoding: raw\nspace origin: (0,0,0)\n\n" +
                voxels);
  seeds.put("mha", "raw.mha",
            "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
            "CompressedData = False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\n"
            "ElementSpacing = 1 1 2.5\nDimSize = 4 5 3\nElementType = MET_SHORT\n"
            "ElementDataFile = LOCAL\n" +
                voxels);
}

void putDicom(const Seeds& seeds) {
  using testing::DicomMaker;
  using testing::DicomSyntax;
  const auto hu = [](int i, int j) { return -900.0 + 10 * i + j; };
  std::vector<ArchiveMember> series;
  for (int k = 0; k < 3; ++k) {
    series.push_back(
        {std::to_string(k) + ".dcm",
         DicomMaker(2.0 * k).pixels(hu).setText(0x00200013, "IS", std::to_string(k)).bytes()});
  }
  seeds.put("dicom", "explicit", series[0].content);
  for (const auto& [name, syntax] :
       {std::pair{"implicit", DicomSyntax::ImplicitLittle}, std::pair{"rle", DicomSyntax::Rle},
        std::pair{"jpeg", DicomSyntax::JpegLossless}}) {
    seeds.put("dicom", name, DicomMaker().pixels(hu).syntax(syntax).bytes());
  }
  writeArchive(seeds.path("zip", "packed"), series);
  for (ArchiveMember& member : series) member.packed = false;
  writeArchive(seeds.path("zip", "stored"), series);
}

void putSurfaces(const Seeds& seeds) {
  const TriangleMesh mesh = tetrahedron();
  for (const std::string format : {"stl", "obj", "ply", "vtp"}) {
    writeSurface(seeds.path(format, "binary." + format), mesh);
  }
  seeds.put("stl", "text",
            "solid t\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 9 0\nvertex 9 0 0\n"
            "endloop\nendfacet\nendsolid t\n");
  seeds.put("ply", "text",
            "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 3\nproperty float x\n"
            "property float y\nproperty float z\nelement face 1\n"
            "property list uchar int vertex_indices\nend_header\n0 0 0\n9 0 0\n0 9 0\n3 0 1 2\n");
  seeds.put(
      "vtp", "text",
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\">\n"
      "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 9 0 0 0 "
      "9 "
      "0</DataArray></Points>\n<Polys><DataArray type=\"Int64\" Name=\"connectivity\" "
      "format=\"ascii\">0 1 2</DataArray><DataArray type=\"Int64\" Name=\"offsets\" "
      "format=\"ascii\">3</DataArray></Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n");
  seeds.put("pvd", "breath",
            "<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n"
            "<DataSet timestep=\"0\" part=\"0\" file=\"a.vtp\"/>\n"
            "<DataSet timestep=\"0.5\" part=\"0\" file=\"b.vtp\"/>\n</Collection>\n</VTKFile>\n");
}

void putTrees(const Seeds& seeds) {
  const AirwayTree tree = testing::SymmetricTree{3}.tree();
  writeTree(seeds.path("vtp", "tree.vtp"), tree);
  writeTree(seeds.path("swc", "tree.swc"), tree);
  writeTree(seeds.path("tree-csv", "tree.csv"), tree);
  writeTree(seeds.path("tree-json", "tree.json"), tree);
  seeds.put(
      "vtu", "tree",
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "<UnstructuredGrid>\n<Piece NumberOfPoints=\"3\" NumberOfCells=\"2\">\n<PointData>"
      "<DataArray type=\"Float64\" Name=\"radius\" format=\"ascii\">5 4 3</DataArray></PointData>\n"
      "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 0 0 -9 "
      "4 0 "
      "-14</DataArray></Points>\n<Cells><DataArray type=\"Int64\" Name=\"connectivity\" "
      "format=\"ascii\">0 1 1 2</DataArray><DataArray type=\"Int64\" Name=\"offsets\" "
      "format=\"ascii\">2 4</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">3 "
      "3</DataArray></Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
}

void putTables(const Seeds& seeds) {
  seeds.put("csv", "landmarks",
            "exp_x,exp_y,exp_z,insp_x,insp_y,insp_z\n1,2,3,4,5,6\n2,3,4,5,6,7\n");
  seeds.put("csv", "cases", "case,ct,group\nA,ct.nii,\"a, \"\"b\"\"\"\n");
  seeds.put("csv", "breath", "seconds,pressure_cmH2O,volume_ml\n0,5,0\n0.5,8,300\n1,10,500\n");
  seeds.put("csv", "poses",
            "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz\n0,0,-900,0,1,0,0,0\n0.1,1,-900,0,1,0,0,0\n");
  seeds.put(
      "json", "recipe",
      R"({"schema":"pneuma/recipe/1","open":{"files":["a.stl"]},"airways":{"method":"kitaoka","terminals":9}})");
  seeds.put(
      "json", "edits",
      R"({"schema":"pneuma/lung-edits/1","space":"LPS","units":"mm","edits":[{"tool":"paint","lung":"right",)"
      R"("shape":"ball","radius_mm":12,"points":[[-60.5,12,8]]}]})");
  seeds.put(
      "json", "planes",
      R"({"schema":"pneuma/fissures/1","space":"LPS","units":"mm","fissures":{"right-oblique":)"
      R"({"plane":{"point":[-75,0,0],"normal":[0,-0.7,0.7]}}}})");
  seeds.put(
      "json", "pictures",
      R"({"schema":"pneuma/pictures/1","pictures":[{"name":"a","arguments":["a.stl"],"limit":0.03}]})");
}

void putFissures(const Seeds& seeds) {
  GivenFissures fissures;
  for (const Fissure fissure :
       {Fissure::RightOblique, Fissure::RightHorizontal, Fissure::LeftOblique}) {
    std::vector<Vec3> points;
    const double x = fissure == Fissure::LeftOblique ? 60.0 : -60.0;
    for (int n = 0; n < 4; ++n) points.emplace_back(x + 9 * (n % 2), 9 * (n / 2), 5.0 * n);
    fissures[fissure].points = points;
  }
  writeFissures(seeds.path("json", "fissures.json"), fissures);
  writeFissures(seeds.path("markups", "fissures.mrk.json"), fissures);
  writeFissures(seeds.path("fcsv", "fissures.fcsv"), fissures);
  writeFissures(seeds.path("csv", "fissures.csv"), fissures);
}

/// A case of a surface and a tree; and each of its members with its number before it.
void putProjects(const Seeds& seeds, const fs::path& project) {
  writeProject(project,
               openCase({seeds.path("ply", "binary.ply"), seeds.path("tree-json", "tree.json")}));
  fs::copy_file(project, seeds.path("pneuma", "case"));
  char number = 0;
  for (const ArchiveMember& member : readArchive(project)) {
    seeds.put("project-member", std::to_string(number), std::string(1, number) + member.content);
    ++number;
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: seeds FOLDER\n");
    return 2;
  }
  try {
    fs::remove_all(argv[1]);
    const Seeds seeds(argv[1]);
    putVolumes(seeds);
    putDicom(seeds);
    putSurfaces(seeds);
    putTrees(seeds);
    putTables(seeds);
    putFissures(seeds);
    putProjects(seeds, fs::path(argv[1]) / "case.pneuma");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "seeds: %s\n", error.what());
    return 1;
  }
  return 0;
}
