// Every pair of formats: what both have a place for comes through to the bit, and what is lost is said. On
// one rank alone.
#include "io/mesh_file.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>

#include "io/formats.hpp"
#include "mesher/base/error.hpp"
#include "tests/io/sample_mesh.hpp"

namespace quadloop::io {
namespace {

enum class Kind { hybrid, triangles };

bool holds_solution(const std::string& format) {
  return format == "mesh" || format == "qmesh" || format == "cgns" || format == "vtu" || format == "pvtu";
}

/// A mesh with coordinates that need all digits, as a file gives it.
LoadedMesh sample(Kind kind, bool solved) {
  LoadedMesh loaded;
  Mesh& mesh = loaded.mesh = test::sample_mesh(7);
  for (Point& p : mesh.points) p = {p.x / 3 + 1e-17, std::sqrt(p.y) - 1e-300};
  mesh.boundaries[1].name = "far-field";
  mesh.boundaries[0].layers = {1, 1 / 3.0};
  mesh.strips = {test::strip_across(mesh, 7)};
  if (kind == Kind::triangles) {
    for (const auto& [a, b, c, d] : mesh.quads) {
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
    mesh.quads.clear();
  }
  loaded.triangle_to_block.assign(mesh.triangles.size(), 0);
  loaded.quad_to_block.assign(mesh.quads.size(), 0);
  if (solved) loaded.solution = test::sample_solution(mesh);
  return loaded;
}

/// Medit's files number the boundaries.
bool numbers_names(const std::string& format) { return format == "medit"; }

LoadedMesh through_file(const LoadedMesh& loaded, const std::string& path) {
  const Communicator alone(MPI_COMM_SELF);
  write_mesh_file(alone, loaded, path);
  LoadedMesh back = read_mesh(path);
  EXPECT_TRUE(back.warnings.empty()) << back.warnings.front();
  return back;
}

bool keeps_constants(const std::string& format) { return format_named(format)->holds(Content::constants); }

/// A file of faces alone does not tell with which of its nodes a cell begins.
bool keeps_first_nodes(const std::string& format) { return format != "fluent.msh"; }

/// Each cell from its lowest node on.
template <class Cells>
Cells from_lowest(Cells cells) {
  for (auto& nodes : cells) std::ranges::rotate(nodes, std::ranges::min_element(nodes));
  return cells;
}

void expect_same_cells(const Mesh& back, const Mesh& mesh, bool to_the_node) {
  EXPECT_EQ(back.points, mesh.points);
  if (to_the_node) {
    EXPECT_EQ(back.triangles, mesh.triangles);
    EXPECT_EQ(back.quads, mesh.quads);
  }
  EXPECT_EQ(from_lowest(back.triangles), from_lowest(mesh.triangles));
  EXPECT_EQ(from_lowest(back.quads), from_lowest(mesh.quads));
  ASSERT_EQ(back.boundaries.size(), mesh.boundaries.size());
  for (std::size_t b = 0; b < mesh.boundaries.size(); ++b) {
    EXPECT_EQ(back.boundaries[b].name, mesh.boundaries[b].name);
    EXPECT_EQ(back.boundaries[b].edges, mesh.boundaries[b].edges);
  }
}

/// From a file in the one format to one in the other.
void convert_and_compare(LoadedMesh loaded, const std::string& first, const std::string& second) {
  if (numbers_names(first) || numbers_names(second)) {
    for (std::size_t b = 0; b < loaded.mesh.boundaries.size(); ++b)
      loaded.mesh.boundaries[b].name = "boundary_" + std::to_string(b + 3);
  }
  const test::TemporaryFolder folder;
  const LoadedMesh between = through_file(loaded, folder.file("a." + first));
  const LoadedMesh back = through_file(between, folder.file("b." + second));
  expect_same_cells(back.mesh, loaded.mesh, keeps_first_nodes(first) && keeps_first_nodes(second));
  const bool transferred = loaded.solution && holds_solution(first),
             kept = transferred && holds_solution(second);
  ASSERT_EQ(back.solution.has_value(), kept);
  if (kept) {
    EXPECT_EQ(back.solution->names, loaded.solution->names);
    EXPECT_EQ(back.solution->values, loaded.solution->values);
    EXPECT_EQ(back.solution->constants.empty(), !(keeps_constants(first) && keeps_constants(second)));
  }
  const bool layers_carried = format_named(first)->holds(Content::layers);
  const bool layers_kept = layers_carried && format_named(second)->holds(Content::layers);
  EXPECT_EQ(back.mesh.strips, layers_kept ? loaded.mesh.strips : std::vector<StripLayers>{});
  EXPECT_EQ(back.mesh.boundaries[0].layers, layers_kept ? loaded.mesh.boundaries[0].layers : WallLayers{});
  const BoundaryCondition carried_condition = test::condition_back(first, BoundaryCondition::wall);
  const BoundaryCondition condition = test::condition_back(second, carried_condition);
  const bool knows_conditions = format_named(first)->holds(Content::conditions);
  EXPECT_EQ(back.mesh.boundaries[0].condition, condition);
  const std::size_t losses =
      (knows_conditions && condition != carried_condition ? 1U : 0U) + (transferred && !kept ? 1U : 0U) +
      (kept && keeps_constants(first) && !keeps_constants(second) ? 1U : 0U) +
      (layers_carried && !layers_kept ? 1U : 0U) +
      (!knows_conditions && format_named(second)->unknown_boundary != nullptr ? 1U : 0U);
  EXPECT_EQ(losses_in(Communicator(MPI_COMM_SELF), between, folder.file("b." + second)).size(), losses);
}

TEST(MeshFile, EveryPairOfFormatsKeepsTheMesh) {
  for (const Kind kind : {Kind::hybrid, Kind::triangles}) {
    for (const bool solved : {false, true}) {
      const LoadedMesh loaded = sample(kind, solved);
      for (const std::string& first : read_formats_for({Content::mesh})) {
        for (const std::string& second : read_formats_for({Content::mesh})) {
          SCOPED_TRACE(first + " to " + second + (solved ? ", solved" : ""));
          convert_and_compare(loaded, first, second);
        }
      }
    }
  }
}

TEST(MeshFile, TheFormatIsThatOfTheSuffixUnlessItIsNamed) {
  const test::TemporaryFolder folder;
  const LoadedMesh loaded = sample(Kind::hybrid, false);
  const Communicator alone(MPI_COMM_SELF);
  write_mesh_file(alone, loaded, folder.file("a.su2"));
  for (const char* name : {"b", "b.xyz", "b.mesh"}) {
    write_mesh_file(alone, loaded, folder.file(name), "su2");
    EXPECT_EQ(test::bytes_of(folder.file(name)), test::bytes_of(folder.file("a.su2")));
  }
  EXPECT_EQ(
      losses_in(Communicator(MPI_COMM_SELF), sample(Kind::hybrid, true), folder.file("b.mesh"), "su2").size(),
      3U);
}

/// One block with a name, then two: kept, or a line says that they are not.
TEST(MeshFile, NamesOfBlocksAreKeptOrReported) {
  int with_names = 0, without = 0;
  for (const std::string& format : read_formats_for({Content::mesh})) {
    for (const bool two : {false, true}) {
      SCOPED_TRACE(format + (two ? ", two" : ", one"));
      if (two && !format_named(format)->holds(Content::blocks)) continue;
      const test::TemporaryFolder folder;
      const std::string path = folder.file("a." + format);
      LoadedMesh loaded = sample(Kind::hybrid, false);
      loaded.mesh.strips.clear();
      loaded.block_names = {"water"};
      if (two) {
        loaded.block_names.emplace_back("steel");
        loaded.blocks = 2;
        loaded.quad_to_block.back() = 1;
      }
      std::string losses;
      for (const std::string& loss : losses_in(Communicator(MPI_COMM_SELF), loaded, path))
        losses += loss + "\n";
      write_mesh_file(Communicator(MPI_COMM_SELF), loaded, path);
      const FileFormat& row = *format_named(format);
      const bool kept = row.holds(Content::block_names) && (two || row.single_block_name);
      EXPECT_EQ(losses.find("names of blocks, which are omitted: 'water'") == std::string::npos, kept)
          << losses;
      EXPECT_EQ(read_mesh(path).block_names == loaded.block_names, kept);
      ++(kept ? with_names : without);
    }
  }
  EXPECT_GT(with_names, 0);
  EXPECT_GT(without, 0);
}

/// Every condition through every format: it comes back, or a line names it and its boundary.
TEST(MeshFile, ConditionsAreKeptOrReported) {
  int kept = 0, reported = 0;
  for (const std::string& format : read_formats_for({Content::mesh})) {
    for (const auto& [word, condition] : BoundaryCondition::words) {
      SCOPED_TRACE(format + ", " + word);
      const test::TemporaryFolder folder;
      LoadedMesh loaded = sample(Kind::hybrid, false);
      loaded.mesh.boundaries[0].condition = condition;
      loaded.mesh.boundaries[1].condition = BoundaryCondition::farfield;
      const LoadedMesh back = through_file(loaded, folder.file("a." + format));
      const BoundaryCondition wanted = test::condition_back(format, condition);
      EXPECT_STREQ(back.mesh.boundaries[0].condition.word(), wanted.word());
      std::string losses;
      for (const std::string& loss :
           losses_in(Communicator(MPI_COMM_SELF), loaded, folder.file("a." + format)))
        losses += loss + "\n";
      const bool stores_some = format_named(format)->holds(Content::conditions);
      const std::string line = std::string(word) +
                               (stores_some ? std::string(" becomes ") + wanted.word() : "") + " ('" +
                               loaded.mesh.boundaries[0].name + "'";
      EXPECT_EQ(losses.find(line) == std::string::npos, wanted == condition) << losses;
      ++(wanted == condition ? kept : reported);
    }
  }
  EXPECT_EQ(kept, 5 * 9 - 6 + 7);
  EXPECT_EQ(reported, 6 + 7 * 8);
}

/// The same for a boundary between two blocks, which a format may omit.
TEST(MeshFile, ConditionsBetweenBlocksAreKeptOrReported) {
  for (const std::string& format : read_formats_for({Content::mesh, Content::blocks, Content::conditions})) {
    for (const char* word : {"none", "interface", "wall", "viscous_wall"}) {
      SCOPED_TRACE(format + ", " + word);
      const test::TemporaryFolder folder;
      const std::string path = folder.file("a." + format);
      LoadedMesh loaded = sample(Kind::hybrid, false);
      loaded.mesh.strips.clear();
      loaded.block_names = {"water", "steel"};
      loaded.blocks = 2;
      loaded.quad_to_block.back() = 1;
      const auto [a, b, c, d] = loaded.mesh.quads.back();
      loaded.mesh.boundaries.push_back({"between", *BoundaryCondition::named(word), {{a, d}}});
      std::string losses;
      for (const std::string& loss : losses_in(Communicator(MPI_COMM_SELF), loaded, path))
        losses += loss + "\n";
      write_mesh_file(Communicator(MPI_COMM_SELF), loaded, path);
      const Mesh back = read_mesh(path).mesh;
      const auto found = std::ranges::find(back.boundaries, "between", &BoundaryEdges::name);
      const bool is_stored = format != "polyMesh";
      ASSERT_EQ(found != back.boundaries.end(), is_stored);
      EXPECT_EQ(losses.find("no patch in this format and are omitted: 'between'; OpenFOAM's "
                            "'splitMeshRegions -cellZonesOnly' makes patches of them") == std::string::npos,
                is_stored);
      if (!is_stored) continue;
      const bool is_interior = format == "fluent.msh" && std::string(word) == "none";
      const std::string wanted =
          is_interior ? "interface" : test::condition_back(format, *BoundaryCondition::named(word)).word();
      EXPECT_EQ(found->condition.word(), wanted);
      EXPECT_EQ(losses.find("'between'") == std::string::npos, wanted == word || is_interior) << losses;
    }
  }
}

TEST(MeshFile, NamesInOtherCodesBecomeUtf8) {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("a.su2");
  test::write_bytes(path,
                    "NDIME= 2\nNELEM= 1\n5 0 1 2\nNPOIN= 3\n0 0\n1 0\n0 1\nNMARK= 1\n"
                    "MARKER_TAG= Fl\xfcgel\x07\nMARKER_ELEMS= 3\n3 0 1\n3 1 2\n3 2 0\n");
  const LoadedMesh loaded = read_mesh(path);
  EXPECT_EQ(loaded.mesh.boundaries.at(0).name, "Fl\xc3\xbcgel_");
  EXPECT_EQ(loaded.warnings.size(), 1U);
}

TEST(MeshFile, AFormatThatHoldsNoMeshIsOurOwnMistake) {
  const test::TemporaryFolder folder;
  const LoadedMesh loaded = sample(Kind::hybrid, true);
  const Communicator alone(MPI_COMM_SELF);
  OutputSet outputs(alone);
  for (const char* name : {"a", "a.xyz", "a.csv"})
    EXPECT_THROW(write_mesh(outputs, loaded, folder.file(name)), Fault) << name;
  EXPECT_THROW(write_mesh(outputs, loaded, folder.file("a.mesh"), "csv"), Fault);
  EXPECT_THROW(write_mesh(outputs, loaded.mesh, folder.file("a.xyz")), Fault);
}

}  // namespace
}  // namespace quadloop::io
