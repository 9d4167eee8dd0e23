// The reader of a polyMesh: polygons of plane meshes, cyclic patches. On one rank alone.
#include <gtest/gtest.h>

#include <filesystem>

#include "io/foam/foam_file.hpp"
#include "io/foam/foam_polygons.hpp"
#include "io/mesh_file.hpp"
#include "io/model/check_mesh3d.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "tests/io/read_plane.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/io/write_alone.hpp"

namespace quadloop::io {
namespace {

std::string foam_list(const std::string& rows, int count) {
  return "FoamFile { version 2.0; format ascii; class any; object any; }\n" + std::to_string(count) +
         "\n(\n" + rows + "\n)\n";
}

/// One cell thick: a square of two units below with a node in the middle of its upper side, on which stand
/// two unit squares. The sides are patches of `type`, the two ends of `ends`.
std::string write_plane(const test::TemporaryFolder& folder, const std::string& type,
                        const std::string& ends) {
  const std::string path = folder.file("a.polyMesh");
  std::filesystem::create_directory(path);
  const auto write = [&](const char* name, const std::string& rows, int count) {
    test::write_bytes(path + "/" + name, foam_list(rows, count));
  };
  write("points",
        "(0 0 0) (2 0 0) (2 2 0) (1 2 0) (0 2 0) (2 3 0) (1 3 0) (0 3 0)"
        "(0 0 1) (2 0 1) (2 2 1) (1 2 1) (0 2 1) (2 3 1) (1 3 1) (0 3 1)",
        16);
  write("faces",
        "4(2 3 11 10) 4(3 4 12 11) 4(6 3 11 14)"
        "4(0 1 9 8) 4(6 7 15 14) 4(5 6 14 13)"
        "4(1 2 10 9) 4(2 5 13 10) 4(4 0 8 12) 4(7 4 12 15)"
        "5(0 4 3 2 1) 4(2 3 6 5) 4(3 4 7 6) 5(8 9 10 11 12) 4(10 13 14 11) 4(11 14 15 12)",
        16);
  write("owner", "0 0 1 0 2 1 0 1 0 2 0 1 2 0 1 2", 16);
  write("neighbour", "1 2 2", 3);
  write("boundary",
        "low { type wall; nFaces 1; startFace 3; } up { type wall; nFaces 2; startFace 4; }"
        "right { type " +
            type +
            "; neighbourPatch left; nFaces 2; startFace 6; }"
            "left { type " +
            type +
            "; inGroups List<word> 1(cyclic); neighbourPatch right; nFaces 2; startFace 8; }"
            "ends { type " +
            ends + "; nFaces 6; startFace 10; }",
        5);
  return path;
}

TEST(FoamReader, DividesPolygonsOfPlaneMeshes) {
  const test::TemporaryFolder folder;
  const std::string path = write_plane(folder, "patch", "empty");
  const LoadedMesh loaded = test::read_plane<read_foam>(path);
  for (const MeshFault& fault : validate(loaded.mesh))
    ADD_FAILURE() << name_of(fault.rule) << ": " << fault.what;
  EXPECT_EQ(loaded.mesh.points.size(), 8U);
  EXPECT_EQ(loaded.mesh.quads.size(), 2U + 1U);
  EXPECT_EQ(loaded.mesh.triangles.size(), 1U);
  EXPECT_EQ(loaded.mesh.boundaries.size(), 4U);
  EXPECT_EQ(loaded.warnings,
            std::vector<std::string>{path + ": divided 1 polygonal cell into 2 triangles and quads"});
  const std::optional<FileMesh> mesh3d = test::read_mesh3d(path);
  EXPECT_TRUE(check_mesh3d(*mesh3d).faults.empty());
}

TEST(FoamReader, RefusesPolygonsInSpace) {
  const test::TemporaryFolder folder;
  const std::string path = write_plane(folder, "patch", "wall");
  EXPECT_THROW(test::read_mesh3d(path), InputError);
}

TEST(FoamReader, KeepsCyclicPatchesAndReportsThem) {
  const test::TemporaryFolder folder;
  const std::string path = write_plane(folder, "cyclic", "empty");
  const LoadedMesh loaded = test::read_plane<read_foam>(path);
  EXPECT_EQ(loaded.mesh.boundaries.at(2).name, "right");
  EXPECT_EQ(loaded.mesh.boundaries.at(3).name, "left");
  EXPECT_EQ(loaded.warnings.at(0),
            path + ": patches of a cyclic type are plain boundaries here, not periodic: 'right' and 'left'");
}

TEST(DividePolygon, TakesTheBestPieces) {
  const auto pieces = [](const std::vector<Point3>& corners) { return divide_polygon(corners); };
  EXPECT_EQ(pieces({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {0, 1, 0}}).size(),
            2U);  // two squares
  const auto arrow =
      pieces({{0, 0, 0}, {4, -3, 0}, {1, 0, 0}, {4, 3, 0}, {3, 4, 0}});  // one corner turns inwards
  EXPECT_FALSE(arrow.empty());
  EXPECT_TRUE(pieces({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}).empty());
}

}  // namespace
}  // namespace quadloop::io
