// A set of parts: the same bytes whatever number of ranks writes it, and the whole again when it is read.
#include "io/parts/part_files.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <filesystem>

#include "io/mesh_file.hpp"
#include "io/model/distribute.hpp"
#include "io/parts/part_output.hpp"
#include "io/parts/part_reader.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "mesher/partition/partition.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/mesh/same_meshes.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::TemporaryFolder;
using test::world;

Mesh sample() {
  Mesh mesh = test::sample_mesh(60);
  mesh.boundaries[0].layers = {1, 0.7};
  mesh.strips = {test::strip_across(mesh, 60)};
  return mesh;
}

/// With values in the cells too.
Field sample_field(const Mesh& mesh) {
  Field field = test::sample_solution(mesh);
  field.cells.names = {"volume"};
  for (std::size_t i = 0; i < mesh.triangles.size() + mesh.quads.size(); ++i)
    field.cells.values.push_back(1 / static_cast<double>(i + 3));
  return field;
}

/// This rank's share of a whole mesh, and of its field.
struct Share {
  explicit Share(const Mesh& whole)
      : mesh{scatter_mesh(world(), whole, own_order(whole))},
        field{scatter_field(world(), sample_field(whole), mesh, own_order(whole))} {}
  Mesh mesh;
  Field field;
};

void write_set(const Communicator& comm, const Mesh& mesh, const Field& field, const std::string& prefix,
               const std::vector<std::string>& formats, std::int32_t parts = 5) {
  PartFiles files(comm);
  files.write(prefix, part_index(comm, mesh, parts, formats),
              make_parts(comm, mesh, partition(comm, mesh, parts), &field));
  files.commit();
}

void expect_same(const LoadedMesh& read, const Mesh& mesh, const Field& field) {
  test::expect_same_meshes(read.mesh, mesh);
  ASSERT_EQ(read.mesh.boundaries.size(), mesh.boundaries.size());
  for (std::size_t b = 0; b < mesh.boundaries.size(); ++b) {
    EXPECT_EQ(read.mesh.boundaries[b].condition, mesh.boundaries[b].condition);
    EXPECT_EQ(read.mesh.boundaries[b].layers, mesh.boundaries[b].layers);
  }
  EXPECT_EQ(read.mesh.strips, mesh.strips);
  ASSERT_TRUE(read.solution);
  EXPECT_EQ(read.solution->values, field.values);
  EXPECT_EQ(read.solution->cells.names, field.cells.names);
  EXPECT_EQ(read.solution->cells.values, field.cells.values);
  EXPECT_TRUE(read.warnings.empty());
}

TEST(PartFiles, SameBytesOnAnyNumberOfRanks) {
  const TemporaryFolder many, one;
  const Mesh whole = sample();
  const Field field = sample_field(whole);
  const Share own(whole);
  write_set(world(), own.mesh, own.field, many.file("a"), {"mesh", "vtu"});
  world().barrier();
  if (!world().is_root()) return;
  const Communicator alone(MPI_COMM_SELF);
  write_set(alone, whole, field, one.file("a"), {"mesh", "vtu"});
  const std::vector<std::string> names = part_file_names("a", 5, {"mesh", "vtu"});
  EXPECT_EQ(names.size(), 2U + 5 * 3);
  EXPECT_EQ(test::files_in(many.path()), names.size());
  for (const std::string& name : names)
    EXPECT_TRUE(test::bytes_of(many.file(name)) == test::bytes_of(one.file(name))) << name;
}

TEST(PartFiles, ComeBackAsTheWholeFromEachFormat) {
  const TemporaryFolder folder;
  const Mesh whole = sample();
  const Field field = sample_field(whole);
  const Share own(whole);
  for (const std::string format : {"mesh", "vtu", "cgns"})
    write_set(world(), own.mesh, own.field, folder.file(format), {format}, 7);
  world().barrier();
  if (!world().is_root()) return;
  for (const std::string format : {"mesh", "vtu", "cgns"}) {
    const LoadedMesh read = read_mesh(folder.file(format + ".parts"));
    expect_same(read, whole, field);
    const bool keeps_constants = format == "mesh";
    EXPECT_EQ(read.solution->constants.empty(), !keeps_constants);
    for (std::int32_t part = 0; part < 7; ++part) {
      const LoadedMesh one = read_mesh(part_path(folder.file(format), part, format));
      EXPECT_TRUE(validate(one.mesh).empty()) << format << part;
    }
  }
}

TEST(PartFiles, TheirPvtuIsTheWholeInTheOrderOfParts) {
  const TemporaryFolder folder;
  const Mesh whole = sample();
  const Share own(whole);
  write_set(world(), own.mesh, own.field, folder.file("a"), {"vtu"}, 4);
  world().barrier();
  if (!world().is_root()) return;
  const LoadedMesh read = read_mesh(folder.file("a.pvtu"));
  EXPECT_EQ(read.mesh.points.size(), whole.points.size());
  EXPECT_EQ(read.mesh.triangles.size(), whole.triangles.size());
  ASSERT_TRUE(read.solution);
  std::vector<double> found = read.solution->cells.values, wanted = sample_field(whole).cells.values;
  std::ranges::sort(found);
  std::ranges::sort(wanted);
  EXPECT_EQ(found, wanted);
}

/// In three blocks, one after another, but that the first has no quads.
LoadedMesh sample_in_blocks() {
  LoadedMesh whole;
  whole.mesh = test::sample_mesh(12);
  whole.blocks = 3;
  whole.block_names = {"left", "mid dle", "right"};
  for (std::size_t i = 0; i < whole.mesh.triangles.size(); ++i)
    whole.triangle_to_block.push_back(static_cast<std::int32_t>(3 * i / whole.mesh.triangles.size()));
  for (std::size_t i = 0; i < whole.mesh.quads.size(); ++i)
    whole.quad_to_block.push_back(1 + static_cast<std::int32_t>(2 * i / whole.mesh.quads.size()));
  return whole;
}

TEST(PartFiles, OfBlocksComeBackWhicheverBlocksAPartHas) {
  const TemporaryFolder folder;
  const LoadedMesh whole = sample_in_blocks();
  for (const std::string format : {"mesh", "vtu"}) {
    PartFiles files(world());
    write_parts(files, world(), distributed(world(), whole),
                {.prefix = folder.file(format), .parts = 5, .formats = {format}});
    files.commit();
  }
  world().barrier();
  if (!world().is_root()) return;
  for (const std::string format : {"mesh", "vtu"}) {
    const LoadedMesh read = read_mesh(folder.file(format + ".parts"));
    test::expect_same_meshes(read.mesh, whole.mesh);
    EXPECT_EQ(read.block_names, whole.block_names);
    EXPECT_EQ(read.triangle_to_block, whole.triangle_to_block) << format;
    EXPECT_EQ(read.quad_to_block, whole.quad_to_block) << format;
  }
  const LoadedMesh pieces = read_mesh(folder.file("vtu.pvtu"));
  EXPECT_TRUE(pieces.warnings.empty()) << pieces.warnings[0];
  EXPECT_EQ(pieces.blocks, 3);
  EXPECT_EQ(pieces.mesh.boundaries.size(), whole.mesh.boundaries.size());
}

TEST(PartFiles, SayWhereAStripIsDamaged) {
  const TemporaryFolder folder;  // collective
  if (!world().is_root()) return;
  const Mesh whole = sample();
  write_set(Communicator(MPI_COMM_SELF), whole, sample_field(whole), folder.file("a"), {"mesh"});
  std::string text = test::bytes_of(folder.file("a.parts"));
  test::write_bytes(folder.file("a.parts"), text.replace(text.find("# nodes"), 7, "# modes"));
  const LoadedMesh read = read_parts(folder.file("a.parts"));
  EXPECT_TRUE(read.mesh.strips.empty());
  ASSERT_EQ(read.warnings.size(), 1U);
  EXPECT_NE(read.warnings[0].find("a.parts: the comment '# strip "), std::string::npos);
}

TEST(PartFiles, RefuseASetThatDoesNotFitTogether) {
  const TemporaryFolder folder;  // collective
  if (!world().is_root()) return;
  const Communicator alone(MPI_COMM_SELF);
  const Mesh whole = sample();
  const Field field = sample_field(whole);
  const auto refused = [&](const auto& damage) {
    write_set(alone, whole, field, folder.file("a"), {"mesh"});
    EXPECT_NO_THROW(read_parts(folder.file("a.parts")));
    damage(folder);
    EXPECT_THROW(read_parts(folder.file("a.parts")), InputError);
  };
  const auto replace = [](const std::string& path, const std::string& from, const std::string& to) {
    std::string text = test::bytes_of(path);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    test::write_bytes(path, text.replace(at, from.size(), to));
  };
  using Folder = const TemporaryFolder&;
  refused([](Folder in) { std::filesystem::remove(in.file("a.part_0003.mesh")); });
  refused([](Folder in) { std::filesystem::remove(in.file("a.part_0003.links")); });
  refused([](Folder in) {
    std::filesystem::copy_file(in.file("a.part_0001.mesh"), in.file("a.part_0002.mesh"),
                               std::filesystem::copy_options::overwrite_existing);
  });
  refused([](Folder in) {
    std::filesystem::copy_file(in.file("a.part_0001.links"), in.file("a.part_0002.links"),
                               std::filesystem::copy_options::overwrite_existing);
  });
  refused([&](Folder in) { replace(in.file("a.parts"), "#Number of parts\n5", "#Number of parts\n4"); });
  refused([&](Folder in) { replace(in.file("a.parts"), "mesh", "msh"); });
  refused([&](Folder in) { replace(in.file("a.parts"), "\n183 ", "\n999999999 "); });
  refused([&](Folder in) { replace(in.file("a.parts"), "far field", "elsewhere"); });
}

TEST(PartFiles, AreNamedByTheirPart) {
  EXPECT_EQ(part_path("x/a", 2, "mesh"), "x/a.part_0003.mesh");
  EXPECT_EQ(part_name(12345), "part_12346");
  EXPECT_TRUE(is_part_index("x/a.parts"));
  EXPECT_FALSE(is_part_index("x/a.part_0003.mesh"));
  EXPECT_EQ(part_formats({"su2", "cgns", "mesh"}), (std::vector<std::string>{"mesh", "cgns"}));
  EXPECT_EQ(part_formats({"cgns", "vtu"}, 2), std::vector<std::string>{"vtu"});
}

}  // namespace
}  // namespace quadloop::io
