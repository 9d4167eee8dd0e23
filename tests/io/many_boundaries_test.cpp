// Meshes of thousands of boundaries: coasts have as many islands. What the ranks say to each other does not
// grow with them, time grows with their number and not with its square, and each comes back under its name.
#include <gtest/gtest.h>
#include <mpi.h>

#include <string>
#include <vector>

#include "io/mesh_file.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/support/growth.hpp"
#include "tests/support/world.hpp"

namespace {

int collectives = 0;

}  // namespace

// MPI's profiling interface: these stand before the library's own.
extern "C" {
int MPI_Allreduce(const void* send, void* receive, int count, MPI_Datatype type, MPI_Op operation,
                  MPI_Comm comm) {
  ++collectives;
  return PMPI_Allreduce(send, receive, count, type, operation, comm);
}
int MPI_Exscan(const void* send, void* receive, int count, MPI_Datatype type, MPI_Op operation,
               MPI_Comm comm) {
  ++collectives;
  return PMPI_Exscan(send, receive, count, type, operation, comm);
}
int MPI_Allgatherv(const void* send, int count, MPI_Datatype type, void* receive, const int* counts,
                   const int* offsets, MPI_Datatype to_type, MPI_Comm comm) {
  ++collectives;
  return PMPI_Allgatherv(send, count, type, receive, counts, offsets, to_type, comm);
}
}

namespace quadloop::io {
namespace {

using test::expect_linear;
using test::processor_seconds;
using test::TemporaryFolder;
using test::world;

const std::vector<std::string> formats{"mesh", "cgns", "vtu", "su2", "msh"};

/// The sample with a boundary of its own for every edge.
Mesh mesh_of_many_boundaries(std::int32_t columns) {
  Mesh mesh = test::sample_mesh(columns);
  std::vector<BoundaryEdges> many;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    for (const auto& edge : boundary.edges)
      many.push_back(
          {"an_island_that_has_a_long_name_" + std::to_string(many.size()), boundary.condition, {edge}});
  }
  mesh.boundaries = std::move(many);
  return mesh;
}

/// Of a boundary of one edge share_of() gives all to the last rank: here they are dealt out in turn, to ranks
/// that have copies of the nodes.
Mesh own_share(const Mesh& whole) {
  Mesh dealt = whole;
  for (std::size_t b = 0; b < dealt.boundaries.size(); ++b) {
    BoundaryEdges& boundary = dealt.boundaries[b];
    const auto rank = b % static_cast<std::size_t>(world().size());
    boundary.edges.assign(world().size(),
                          boundary.edges.front());  // one for each rank, of which one is kept
    if (rank != static_cast<std::size_t>(world().rank())) boundary.name += " not here";
  }
  Mesh share = test::share_of(dealt, world().rank(), world().size());
  for (std::size_t b = 0; b < share.boundaries.size(); ++b) {
    if (share.boundaries[b].name == whole.boundaries[b].name) continue;
    share.boundaries[b].name = whole.boundaries[b].name;
    share.boundaries[b].edges.clear();
  }
  return share;
}

void write(const Communicator& comm, const Mesh& mesh, const std::string& path) {
  OutputSet outputs(comm);
  write_mesh(outputs, mesh, path, nullptr);
  outputs.commit();
}

int collectives_of(const Mesh& mesh, const std::string& path) {
  collectives = 0;
  write(world(), mesh, path);
  return collectives;
}

TEST(ManyBoundaries, TakeNoMoreCollectivesThanFew) {
  const TemporaryFolder folder;
  const Mesh few = own_share(mesh_of_many_boundaries(2)), many = own_share(mesh_of_many_boundaries(100));
  for (const std::string& format : formats) {
    const int of_few = collectives_of(few, folder.file("few." + format));
    EXPECT_GT(of_few, 0);
    EXPECT_EQ(collectives_of(many, folder.file("many." + format)), of_few) << format;
  }
}

TEST(ManyBoundaries, ComeBackFromAnyNumberOfRanks) {
  const TemporaryFolder folder;
  const Communicator alone(MPI_COMM_SELF);
  const Mesh whole = mesh_of_many_boundaries(400);
  const Mesh own = own_share(whole);
  for (const std::string& format : formats) {
    write(world(), own, folder.file("many." + format));
    if (!world().is_root()) continue;
    write(alone, whole, folder.file("one." + format));
    const bool stamped = format == "cgns";  // by the library, with the time
    EXPECT_TRUE(stamped ||
                test::bytes_of(folder.file("many." + format)) == test::bytes_of(folder.file("one." + format)))
        << format;
    const LoadedMesh loaded = read_mesh(folder.file("many." + format));
    EXPECT_TRUE(validate(loaded.mesh).empty()) << format;
    ASSERT_EQ(loaded.mesh.boundaries.size(), whole.boundaries.size()) << format;
    for (std::size_t b = 0; b < whole.boundaries.size(); ++b) {
      ASSERT_EQ(loaded.mesh.boundaries[b].name, whole.boundaries[b].name) << format;
      ASSERT_EQ(loaded.mesh.boundaries[b].edges, whole.boundaries[b].edges) << format;
      ASSERT_EQ(loaded.mesh.boundaries[b].condition,
                stamped ? whole.boundaries[b].condition : BoundaryCondition())
          << format;
    }
  }
}

TEST(ManyBoundaries, TakeTimeInProportion) {
  const TemporaryFolder folder;
  if (world().size() > 1) return;
  for (const std::string& format : formats) {
    const std::int32_t columns = format == "cgns" ? 150 : 4000;
    const Mesh few = mesh_of_many_boundaries(columns), many = mesh_of_many_boundaries(8 * columns);
    const std::string few_file = folder.file("few." + format), many_file = folder.file("many." + format);
    const double of_few = processor_seconds([&] { write(world(), few, few_file); });
    expect_linear("writing " + format, of_few, processor_seconds([&] { write(world(), many, many_file); }));
    if (format == "cgns") continue;  // the library's own part of reading is another process's time
    const double few_read = processor_seconds([&] { read_mesh(few_file); });
    expect_linear("reading " + format, few_read, processor_seconds([&] { read_mesh(many_file); }));
  }
}

}  // namespace
}  // namespace quadloop::io
