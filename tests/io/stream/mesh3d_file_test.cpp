// Each format of 3D meshes reads what it writes, the same bytes come from any number of ranks, and what is
// damaged is refused.
#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "io/model/check_mesh3d.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/io/write_alone.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::TemporaryFolder;
using test::world;

std::string bytes_of_file(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// Of a file, or of the files of a folder, with what stands beside it.
std::string bytes_below(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  std::string all;
  for (const auto& file : files) all += file.lexically_relative(folder).string() + bytes_of_file(file);
  return all;
}

std::string path_in(const std::string& folder, const FileFormat& format) {
  return folder + "/" + (format.is_folder ? format.name : "a." + format.name);
}

void write(const Communicator& comm, const Mesh& whole, const Field& solution, const std::string& path,
           ExtrusionAxis axis) {
  const MeshOrder order = own_order(whole);
  const Mesh part = scatter_mesh(comm, whole, order);
  const Field field = scatter_field(comm, solution, part, order);
  OutputSet outputs(comm);
  write_mesh(outputs, extruded(part, {0, 0.5, 2}, axis, &field), path);
  outputs.commit();
}

void expect_sample(const FileMesh& mesh, const FileFormat& format) {
  EXPECT_EQ(mesh.points.size(), 54);
  EXPECT_EQ(mesh.prisms.size(), 20);
  EXPECT_EQ(mesh.hexahedra.size(), 10);
  const Mesh3dStatistics statistics = check_mesh3d(mesh);
  EXPECT_TRUE(statistics.faults.empty()) << statistics.faults.front().what;
  EXPECT_NEAR(statistics.volume, 10 * 2, 1e-12);
  ASSERT_EQ(statistics.patches.size(), 4);
  const std::vector<std::string> own{"wall", "far field", "back", "front"};
  const std::vector<std::string> names = format.boundary_names == nullptr ? own : format.boundary_names(own);
  const std::vector<double> areas{20, 8, 10, 10};
  for (std::size_t n = 0; n < 4; ++n) {
    EXPECT_EQ(statistics.patches[n].name, format.name == "cgns" ? own[n] : names[n]);
    EXPECT_NEAR(statistics.patches[n].area, areas[n], 1e-12);
  }
}

/// Each cell has the values of the plane's cell that it stands on, two layers of each.
void expect_values_of_cells(const FileMesh& mesh, const CellValues& plane, ExtrusionAxis axis) {
  ASSERT_TRUE(mesh.solution);
  const CellValues& cells = mesh.solution->cells;
  ASSERT_EQ(cells.names,
            (axis == ExtrusionAxis::z
                 ? std::vector<std::string>{"pressure", "x_velocity", "y_velocity", "z_velocity"}
                 : std::vector<std::string>{"pressure", "x_velocity", "z_velocity", "y_velocity"}));
  ASSERT_EQ(cells.values.size(), 4 * 30);
  for (std::size_t cell = 0; cell < 30; ++cell) {
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(cells.values[4 * cell + k], plane.values[3 * (cell / 2) + k]);
    EXPECT_EQ(cells.values[4 * cell + 3], 0);
  }
}

TEST(Mesh3dFile, EachReadsWhatItWrites) {
  const Mesh whole = test::sample_mesh(5);
  Field solution = test::sample_solution(whole);
  solution.cells.names = {"pressure", "x_velocity", "y_velocity"};
  for (int i = 0; i < 3 * 15; ++i) solution.cells.values.push_back(1.0 / (i + 3));
  for (const std::string& name : read_formats_for({Content::mesh3d})) {
    for (const ExtrusionAxis axis : {ExtrusionAxis::y, ExtrusionAxis::z}) {
      SCOPED_TRACE(name);
      const FileFormat& format = *format_named(name);
      const TemporaryFolder folder;
      for (const char* part : {"/all", "/alone"}) {
        if (world().is_root()) std::filesystem::create_directory(folder.path() + part);
      }
      const std::string path = path_in(folder.path() + "/all", format);
      write(world(), whole, solution, path, axis);
      if (!world().is_root()) continue;
      const std::optional<FileMesh> mesh = test::read_mesh3d(path);
      ASSERT_TRUE(mesh);
      expect_sample(*mesh, format);
      if (format.holds(Content::solution)) expect_values_of_cells(*mesh, solution.cells, axis);
      if (name == "cgns") continue;  // holds the time
      const Communicator alone(MPI_COMM_SELF);
      write(alone, whole, solution, path_in(folder.path() + "/alone", format), axis);
      EXPECT_EQ(bytes_below(folder.path() + "/all"), bytes_below(folder.path() + "/alone"));
    }
  }
}

TEST(Mesh3dFile, PlaneMeshesAreNone) {
  const TemporaryFolder folder;
  const Communicator alone(MPI_COMM_SELF);
  const Mesh mesh = test::sample_mesh(3);
  int formats = 0;
  for (const std::string& name : read_formats_for({Content::mesh3d, Content::mesh})) {
    if (!world().is_root()) break;
    if (format_named(name)->is_folder) continue;  // that of a plane mesh is one cell thick
    const std::string path = folder.file("a." + name);
    OutputSet outputs(alone);
    format_named(name)->write(outputs, MeshStream(outputs.communicator(), mesh), path);
    outputs.commit();
    EXPECT_FALSE(test::read_mesh3d(path)) << name;
    ++formats;
  }
  EXPECT_GE(world().sum(formats), 4);
}

TEST(Mesh3dFile, NamesOfFormatsStandInSentences) {
  EXPECT_EQ(
      suffixes_for({Content::mesh3d}),
      ".cgns, .vtu, .pvtu, .vtkhdf, .su2, .fluent.msh, .msh, .msh41, .b8.ugrid, .lb8.ugrid or polyMesh");
  EXPECT_EQ(format_of("a/constant/polyMesh/")->name, "polyMesh");
  EXPECT_EQ(format_of("a/b.polyMesh")->name, "polyMesh");
  EXPECT_EQ(format_of("a.lb8.ugrid")->name, "lb8.ugrid");
  EXPECT_THROW(require_mesh3d_suffix("a.mesh"), InputError);
}

/// Bytes changed, or cut off: read as something, or refused; never a crash.
TEST(Mesh3dFile, DamagedOnesAreRefusedOrRead) {
  const TemporaryFolder folder;
  if (!world().is_root()) return;
  const Mesh whole = test::sample_mesh(3);
  const Field solution = test::sample_solution(whole);
  const Communicator alone(MPI_COMM_SELF);
  std::mt19937 random(7);  // NOLINT: the same each time
  for (const char* name :
       {"cgns", "vtu", "pvtu", "su2", "fluent.msh", "msh", "b8.ugrid", "lb8.ugrid", "polyMesh"}) {
    const FileFormat& format = *format_named(name);
    const int damages = format.name == "cgns" ? 12 : 60;  // each in a process of its own
    for (int i = 0; i < damages; ++i) {
      const std::string path = path_in(folder.path(), format);
      write(alone, whole, solution, path, ExtrusionAxis::z);
      const std::vector<std::string> parts{"points", "faces", "owner", "neighbour", "boundary"};
      const std::string damaged = format.is_folder ? path + "/" + parts[random() % 5] : path;
      std::string bytes = bytes_of_file(damaged);
      if (i % 3 == 0) {
        bytes.resize(random() % bytes.size());
      } else {
        for (int k = 0; k < 1 + i % 4; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
      }
      std::ofstream(damaged, std::ios::binary) << bytes;
      try {
        if (const std::optional<FileMesh> mesh = test::read_mesh3d(path)) check_mesh3d(*mesh);
      } catch (const InputError& refusal) {
        EXPECT_NE(std::string(refusal.what()).find(folder.path()), std::string::npos) << refusal.what();
      }
    }
  }
}

TEST(Mesh3dFile, InterfacesBetweenBlocksAreNoPatch) {
  LoadedMesh whole;
  whole.mesh = test::sample_mesh(2);
  whole.blocks = 2;
  Mesh& mesh = whole.mesh;
  mesh.boundaries.push_back({"between", "interface", {{mesh.quads[0][1], mesh.quads[0][2]}}});
  whole.block_names = {"a", "b"};
  whole.triangle_to_block = {0, 0, 0, 0};
  whole.quad_to_block = {0, 1};
  EXPECT_EQ(drop_interfaces(Communicator(MPI_COMM_SELF), whole, "a.su2"), std::vector<std::string>{})
      << "each zone has its faces";
  ASSERT_EQ(mesh.boundaries.size(), 4);
  EXPECT_EQ(mesh.boundaries[2].name, "between");
  EXPECT_EQ(mesh.boundaries[3].name, "a__b");
  EXPECT_EQ(drop_interfaces(Communicator(MPI_COMM_SELF), whole, "a.vtu"),
            std::vector<std::string>{"a.vtu: the 2 edges between two blocks are no patch"});
  EXPECT_EQ(mesh.boundaries.size(), 2);
  EXPECT_EQ(drop_interfaces(Communicator(MPI_COMM_SELF), whole, "a.vtu"), std::vector<std::string>{});
}

}  // namespace
}  // namespace quadloop::io
