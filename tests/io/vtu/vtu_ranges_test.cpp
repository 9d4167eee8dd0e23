// A VTK file that all ranks read, each its shares of the arrays, gives the mesh that is read as a whole; a
// file that needs more than that is left to the root, and gives the same mesh or message.
#include "io/vtu/vtu_ranges.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "io/model/distribute.hpp"
#include "io/native/native_file.hpp"
#include "io/vtu/vtu_file.hpp"
#include "mesher/base/error.hpp"
#include "tests/io/as_whole.hpp"
#include "tests/io/read_plane.hpp"
#include "tests/io/same_mesh.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::expect_same;
using test::TemporaryFolder;
using test::world;

/// Two squares, the first divided, as another program may write them: numbers of several types, edges in any
/// order and direction, a vector with a third component of 0.
struct Grid {
  std::vector<float> points{0, 0, 2, 1, 0, 2, 2, 0, 2, 0, 1, 2, 1, 1, 2, 2, 1, 2};
  std::vector<std::int32_t> nodes{0, 1, 1, 2, 5, 4, 0, 1, 3, 1, 4, 3, 1, 2, 2, 5, 3, 4, 5, 4, 0, 3};
  std::vector<std::int64_t> offsets{2, 6, 9, 12, 14, 16, 18, 20, 22};
  std::vector<std::uint8_t> types{3, 9, 5, 5, 3, 3, 3, 3, 3};
  std::vector<std::int32_t> boundary{1, 0, 0, 0, 1, 2, 3, 3, 2};
  std::vector<double> velocity{1, 2, 0, 3, 4, 0, 5, 6, 0, 7, 8, 0, 9, 10, 0, 11, 12, 0};
  std::vector<float> pressure{0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5, 8.5};
  std::vector<std::int32_t> mark{1, 2, 3, 4, 5, 6, 7, 8, 9};
  std::string more_cell_data, encoding = "raw", names = "98 111 116 0 115 105 0 116 0",
                              tail = "</AppendedData></VTKFile>";

  std::string text() const {
    std::string data = "_";
    const auto array = [&](const char* name, const char* type, int components, const auto& values) {
      const std::string tag = "<DataArray Name=\"" + std::string(name) + "\" type=\"" + type +
                              "\" NumberOfComponents=\"" + std::to_string(components) +
                              "\" format=\"appended\" offset=\"" + std::to_string(data.size() - 1) + "\"/>";
      const auto raw = std::as_bytes(std::span(values));
      const auto size = static_cast<std::uint32_t>(raw.size());
      data.append(reinterpret_cast<const char*>(&size), sizeof size);
      data.append(reinterpret_cast<const char*>(raw.data()), raw.size());
      return tag;
    };
    std::string head =
        "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"><UnstructuredGrid>"
        "<FieldData><DataArray Name=\"boundary_names\" type=\"UInt8\" format=\"ascii\">" +
        names + "</DataArray></FieldData><Piece NumberOfPoints=\"6\" NumberOfCells=\"9\"><Points>";
    head += array("Points", "Float32", 3, points) + "</Points><Cells>" +
            array("connectivity", "Int32", 1, nodes) + array("offsets", "Int64", 1, offsets) +
            array("types", "UInt8", 1, types) + "</Cells><PointData>" +
            array("velocity", "Float64", 3, velocity) + "</PointData><CellData>" +
            array("pressure", "Float32", 1, pressure) + array("boundary", "Int32", 1, boundary) +
            more_cell_data + array("mark", "Int32", 1, mark) +
            "</CellData></Piece></UnstructuredGrid><AppendedData encoding=\"" + encoding + "\">";
    return head + data + tail;
  }
};

std::string refusal_by_ranges(const std::string& text) {
  const TemporaryFolder folder;
  const std::string path = folder.write("m.vtu", text);
  return test::refusal_text([&] { read_vtu_ranges(world(), path); });
}

void expect_as_whole(const std::string& text) {
  SCOPED_TRACE(text.substr(0, 2000));
  const TemporaryFolder folder;
  test::expect_as_whole<read_vtu>("vtu", folder.write("m.vtu", text));
}

TEST(VtuRanges, GiveTheMeshThatIsReadAsAWhole) {
  const std::string text = Grid{}.text();
  EXPECT_EQ(refusal_by_ranges(text), "");
  expect_as_whole(text);
  const TemporaryFolder folder;
  const LoadedMesh part = read_vtu_ranges(world(), folder.write("m.vtu", text)),
                   whole = gathered(world(), part);
  ASSERT_EQ(part.mesh.boundaries.size(), 3U);
  EXPECT_EQ(part.mesh.boundaries[0].name, "bot");
  EXPECT_EQ(part.mesh.owned_nodes,
            6 * (world().rank() + 1) / world().size() - 6 * world().rank() / world().size());
  ASSERT_TRUE(part.solution);
  EXPECT_EQ(part.solution->names, (std::vector<std::string>{"velocity_x", "velocity_y"}));
  if (!world().is_root()) return;
  EXPECT_EQ(whole.solution->cells.values, (std::vector<double>{2.5, 3.5, 1.5}));
}

TEST(VtuRanges, GiveWhatWasWritten) {
  const TemporaryFolder folder;
  const Communicator alone(MPI_COMM_SELF);
  const std::string
      path = folder.file("m.vtu"),
      text =
          "6\n0 0\n1 0\n1 1\n0 1\n2 0\n2 1\n1\n1\n1 2 3\n1\n2 5 6 3\n3\n# layers left 2 0.25\n"
          "#edges (left)\n1\n4 1\n#edges (right)\n1\n5 6\n#edges (others)\n5\n1 2\n2 5\n6 3\n3 4\n"
          "3 1\n# inner line cut 1\n# 2 3\n# node 4 corner\n# pair left right translation 2 0\n";
  LoadedMesh mesh = read_native(alone, folder.write("m.mesh", text));
  mesh.mesh.triangles.push_back({NodeId{0}, NodeId{2}, NodeId{3}});
  mesh.triangle_to_block.push_back(0);
  mesh.mesh.boundaries[2].edges.pop_back();
  if (world().is_root()) write_mesh_file(alone, mesh, path);
  world().barrier();
  const LoadedMesh whole = gathered(world(), read_vtu_ranges(world(), path));
  if (!world().is_root()) return;
  expect_same(whole, test::read_plane<read_vtu>(path));
  EXPECT_EQ(whole.mesh.boundaries.at(0).layers.count, 2);
  EXPECT_EQ(whole.inner_curves.size(), 1U);
  EXPECT_EQ(whole.mesh.pairs.size(), 1U);
  EXPECT_EQ(whole.mesh.named_nodes.size(), 1U);
}

/// Each is changed in one thing, which the root alone repairs, reports or refuses.
TEST(VtuRanges, AreOfFilesThatNeedNoMore) {
  std::vector<Grid> grids(14);
  grids[0].points[2] = 1;                                       // not in one plane
  grids[1].points[4] = std::numeric_limits<float>::infinity();  //
  grids[2].nodes[21] = 6;                                       // no such point
  std::swap(grids[3].nodes[7], grids[3].nodes[8]);              // clockwise
  grids[4].offsets[8] = 23;                                     //
  grids[5].offsets[2] = 5;                                      //
  grids[6].types[1] = 7;                                        // a polygon
  grids[7].boundary[8] = 4;                                     // without a name
  grids[8].velocity[17] = std::numeric_limits<double>::quiet_NaN();
  grids[9].pressure.pop_back();
  grids[10].names = "98 111 116";
  grids[11].tail = "";
  grids[11].mark.clear();
  grids[12].nodes[21] = 4;  // of no cell
  grids[13].encoding = "base64";
  for (std::size_t g = 0; g < grids.size(); ++g) {
    SCOPED_TRACE(g);
    EXPECT_TRUE(g == 10 || g == 11 || !refusal_by_ranges(grids[g].text()).empty());
    expect_as_whole(grids[g].text());
  }
  Grid third;
  third.velocity[17] = 0.5;
  expect_as_whole(third.text());
}

TEST(VtuRanges, SayWhatIsSaidOfDamagedFilesAsAWhole) {
  std::mt19937 random(4);  // the same on all ranks
  const auto below = [&](std::size_t end) { return random() % end; };
  for (int trial = 0; trial < 30; ++trial) {
    std::string text = Grid{}.text();
    const std::size_t at = below(text.size());
    switch (below(3)) {
      case 0: text.resize(at); break;
      case 1: text[at] = static_cast<char>(below(256)); break;
      default: text.erase(at, 1 + below(9)); break;
    }
    expect_as_whole(text);
  }
}

}  // namespace
}  // namespace quadloop::io
