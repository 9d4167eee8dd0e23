// What is written does not depend on how many ranks hold it, and comes back as it was. The references are
// written by each rank's own communicator of one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <utility>

#include "io/cgns/cgns_file.hpp"
#include "io/formats.hpp"
#include "io/msh/msh_file.hpp"
#include "io/native/binary_file.hpp"
#include "io/native/native_file.hpp"
#include "io/solution_file.hpp"
#include "io/su2/su2_csv_file.hpp"
#include "io/su2/su2_dat_file.hpp"
#include "io/su2/su2_file.hpp"
#include "io/tree/tree_file.hpp"
#include "io/vtu/vtu_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "tests/io/read_plane.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/io/write_alone.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::TemporaryFolder;
using test::world;

constexpr std::int32_t columns = 500;
constexpr std::int32_t leaves = 150000;  // more than two chunks

void expect_same_mesh(const LoadedMesh& loaded, const Mesh& mesh) {
  EXPECT_EQ(loaded.mesh.points, mesh.points);
  EXPECT_EQ(loaded.mesh.triangles, mesh.triangles);
  EXPECT_EQ(loaded.mesh.quads, mesh.quads);
  ASSERT_EQ(loaded.mesh.boundaries.size(), mesh.boundaries.size());
  for (std::size_t b = 0; b < mesh.boundaries.size(); ++b) {
    EXPECT_EQ(loaded.mesh.boundaries[b].name, mesh.boundaries[b].name);
    EXPECT_EQ(loaded.mesh.boundaries[b].edges, mesh.boundaries[b].edges);
    EXPECT_EQ(loaded.mesh.boundaries[b].layers, mesh.boundaries[b].layers);
  }
  EXPECT_EQ(loaded.mesh.strips, mesh.strips);
  EXPECT_TRUE(validate(loaded.mesh).empty());
}

void expect_same_solution(const LoadedMesh& loaded, const Field& solution) {
  ASSERT_TRUE(loaded.solution);
  EXPECT_EQ(loaded.solution->values, solution.values);
}

Mesh layered(Mesh mesh) {
  mesh.boundaries[0].layers = {1, 0.7};
  mesh.strips = {test::strip_across(mesh, columns)};
  return mesh;
}

/// The whole sample, and this rank's part of it.
struct Sample {
  Mesh mesh = layered(test::sample_mesh(columns));
  Field solution = test::sample_solution(mesh);
  Mesh own = test::share_of(mesh, world().rank(), world().size());
  Field own_solution = test::share_of(solution, mesh, own);
  Communicator alone{MPI_COMM_SELF};
};

TEST(NativeFile, SameBytesOnAnyNumberOfRanksAndComesBack) {
  const TemporaryFolder folder;
  const Sample sample;
  test::write_alone(world(), sample.own, folder.file("many.mesh"), &sample.own_solution);
  if (!world().is_root()) return;
  test::write_alone(sample.alone, sample.mesh, folder.file("one.mesh"), &sample.solution);
  EXPECT_TRUE(test::bytes_of(folder.file("many.mesh")) == test::bytes_of(folder.file("one.mesh")));
  const LoadedMesh loaded = read_native(sample.alone, folder.file("many.mesh"));
  expect_same_mesh(loaded, sample.mesh);
  expect_same_solution(loaded, sample.solution);
  EXPECT_EQ(loaded.solution->names, sample.solution.names);
  EXPECT_EQ(loaded.solution->constants, sample.solution.constants);  // CGNS has no place for them
  EXPECT_EQ(test::files_in(folder.path()), 2U);
}

TEST(BinaryFile, SameBytesOnAnyNumberOfRanksAndComesBack) {
  const TemporaryFolder folder;
  const Sample sample;
  const auto write = [&](const Communicator& comm, const Mesh& mesh, const Field& solution,
                         const std::string& path) {
    OutputSet outputs(comm);
    write_mesh(outputs, mesh, path, &solution);
    outputs.commit();
  };
  write(world(), sample.own, sample.own_solution, folder.file("many.qmesh"));
  if (!world().is_root()) return;
  write(sample.alone, sample.mesh, sample.solution, folder.file("one.qmesh"));
  EXPECT_TRUE(test::bytes_of(folder.file("many.qmesh")) == test::bytes_of(folder.file("one.qmesh")));
  const LoadedMesh loaded = read_binary(sample.alone, folder.file("many.qmesh"));
  expect_same_mesh(loaded, sample.mesh);
  expect_same_solution(loaded, sample.solution);
  EXPECT_EQ(loaded.solution->names, sample.solution.names);
  EXPECT_EQ(loaded.solution->constants, sample.solution.constants);
  EXPECT_EQ(test::files_in(folder.path()), 2U);
}

TEST(Su2File, SameBytesOnAnyNumberOfRanksAndComesBack) {
  const TemporaryFolder folder;
  Sample sample;
  test::write_alone(world(), sample.own, folder.file("many.su2"));
  if (!world().is_root()) return;
  test::write_alone(sample.alone, sample.mesh, folder.file("one.su2"));
  EXPECT_TRUE(test::bytes_of(folder.file("many.su2")) == test::bytes_of(folder.file("one.su2")));
  sample.mesh.boundaries.at(1).name = "far_field";  // SU2 takes no blanks
  sample.mesh.boundaries[0].layers = {};            // nor layers
  sample.mesh.strips = {};
  expect_same_mesh(test::read_plane<read_su2>(folder.file("many.su2")), sample.mesh);
}

TEST(MshFile, SameBytesOnAnyNumberOfRanksAndComesBack) {
  const TemporaryFolder folder;
  Sample sample;
  test::write_alone(world(), sample.own, folder.file("many.msh"));
  if (!world().is_root()) return;
  test::write_alone(sample.alone, sample.mesh, folder.file("one.msh"));
  EXPECT_TRUE(test::bytes_of(folder.file("many.msh")) == test::bytes_of(folder.file("one.msh")));
  const LoadedMesh loaded = test::read_plane<read_msh>(folder.file("many.msh"));
  sample.mesh.boundaries[0].layers = {};  // it has no place for them
  sample.mesh.strips = {};
  expect_same_mesh(loaded, sample.mesh);
  EXPECT_EQ(loaded.block_names, std::vector<std::string>{"domain"});
  EXPECT_TRUE(loaded.warnings.empty());
}

TEST(VtuFile, SameBytesOnAnyNumberOfRanksAndComesBack) {
  const TemporaryFolder folder;
  const Sample sample;
  test::write_alone(world(), sample.own, folder.file("many.vtu"), &sample.own_solution);
  if (!world().is_root()) return;
  test::write_alone(sample.alone, sample.mesh, folder.file("one.vtu"), &sample.solution);
  EXPECT_TRUE(test::bytes_of(folder.file("many.vtu")) == test::bytes_of(folder.file("one.vtu")));
  const LoadedMesh loaded = test::read_plane<read_vtu>(folder.file("many.vtu"));
  expect_same_mesh(loaded, sample.mesh);
  expect_same_solution(loaded, sample.solution);
  EXPECT_EQ(loaded.solution->names, sample.solution.names);
}

/// Of a file and what stands beside it, or of a folder's files.
std::string bytes_below(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  std::string all;
  for (const std::string& file : files) all += file.substr(folder.size()) + test::bytes_of(file);
  return all;
}

TEST(EveryFormat, SameBytesOnAnyNumberOfRanks) {
  int formats = 0;
  for (const FileFormat& format : file_formats()) {
    if (!format.holds(Content::mesh)) continue;
    SCOPED_TRACE(format.name);
    const test::TemporaryFolder folder;
    for (const char* part : {"many", "one"}) {
      if (world().is_root()) std::filesystem::create_directory(folder.file(part));
    }
    const Sample sample;
    OutputSet many(world());
    format.write(many, MeshStream(world(), sample.own, &sample.own_solution),
                 folder.file("many") + "/a." + format.name);
    many.commit();
    if (!world().is_root()) continue;
    OutputSet one(sample.alone);
    format.write(one, MeshStream(sample.alone, sample.mesh, &sample.solution),
                 folder.file("one") + "/a." + format.name);
    one.commit();
    EXPECT_TRUE(bytes_below(folder.file("many")) == bytes_below(folder.file("one")));
    ++formats;
  }
  EXPECT_GE(world().sum(formats), 10);
}

TEST(Su2Csv, SameBytesOnAnyNumberOfRanksAndComesBack) {
  const TemporaryFolder folder;
  const Sample sample;
  OutputSet many(world());
  write_su2_csv(many, sample.own, folder.file("many.csv"), sample.own_solution);
  many.commit();
  if (!world().is_root()) return;
  OutputSet one(sample.alone);
  write_su2_csv(one, sample.mesh, folder.file("one.csv"), sample.solution);
  one.commit();
  EXPECT_TRUE(test::bytes_of(folder.file("many.csv")) == test::bytes_of(folder.file("one.csv")));
  const LoadedSolution loaded = read_solution(folder.file("many.csv"));
  EXPECT_EQ(loaded.points, sample.mesh.points);
  EXPECT_EQ(loaded.solution.names, sample.solution.names);
  EXPECT_EQ(loaded.solution.values, sample.solution.values);
}

TEST(Su2Dat, SameBytesOnAnyNumberOfRanks) {
  const TemporaryFolder folder;
  const Sample sample;
  OutputSet many(world());
  write_su2_dat(many, sample.own, folder.file("many.dat"), sample.own_solution);
  many.commit();
  if (!world().is_root()) return;
  OutputSet one(sample.alone);
  write_su2_dat(one, sample.mesh, folder.file("one.dat"), sample.solution);
  one.commit();
  EXPECT_TRUE(test::bytes_of(folder.file("many.dat")) == test::bytes_of(folder.file("one.dat")));
}

TEST(CgnsFile, ComesBackAsTheNativeFileDoes) {
  const TemporaryFolder folder;
  const Sample sample;
  test::write_alone(world(), sample.own, folder.file("m.cgns"), &sample.own_solution);
  if (!world().is_root()) return;
  const LoadedMesh loaded = test::read_plane<read_cgns>(folder.file("m.cgns"));
  expect_same_mesh(loaded, sample.mesh);
  expect_same_solution(loaded, sample.solution);
  EXPECT_EQ(loaded.mesh.boundaries.at(1).condition, BoundaryCondition::farfield);
  EXPECT_EQ(loaded.blocks, 1);
}

TEST(CgnsFile, ComesBackWith64BitSizes) {
  const TemporaryFolder folder;
  const Sample sample;
  for (const CgnsSizes sizes : {CgnsSizes::as_needed, CgnsSizes::always_64_bits}) {
    OutputSet outputs(world());
    const bool wide = sizes == CgnsSizes::always_64_bits;
    write_cgns(outputs, MeshStream(world(), sample.own, &sample.own_solution),
               folder.file(wide ? "wide.cgns" : "usual.cgns"), sizes);
    outputs.commit();
  }
  if (!world().is_root()) return;
  const LoadedMesh loaded = test::read_plane<read_cgns>(folder.file("wide.cgns"));
  expect_same_mesh(loaded, sample.mesh);
  expect_same_solution(loaded, sample.solution);
  const auto more = std::ssize(test::bytes_of(folder.file("wide.cgns"))) -
                    std::ssize(test::bytes_of(folder.file("usual.cgns")));
  EXPECT_GE(more, 4 * (3 * std::ssize(sample.mesh.triangles) + 4 * std::ssize(sample.mesh.quads)));
}

TEST(CgnsFile, RefusesWhatIsNone) {
  const TemporaryFolder folder;
  if (!world().is_root()) return;
  test::write_bytes(folder.file("text.cgns"), "no CGNS at all\n");
  EXPECT_THROW(read_cgns(Communicator(MPI_COMM_SELF), folder.file("text.cgns")), InputError);
  EXPECT_THROW(read_cgns(Communicator(MPI_COMM_SELF), folder.file("missing.cgns")), InputError);
}

TEST(TreeFile, SameBytesEachTimeAndOnAnyNumberOfRanks) {
  const TemporaryFolder folder;
  const TreeRecord own = test::sample_tree(leaves, world().rank(), world().size()),
                   all = test::sample_tree(leaves, 0, 1);
  const Communicator alone(MPI_COMM_SELF);
  write_tree(world(), own, folder.file("many.h5"));
  write_tree(world(), own, folder.file("again.h5"));
  if (!world().is_root()) return;
  write_tree(alone, all, folder.file("one.h5"));
  const std::string one = test::bytes_of(folder.file("one.h5"));
  EXPECT_FALSE(one.empty());
  EXPECT_TRUE(test::bytes_of(folder.file("many.h5")) == one);
  EXPECT_TRUE(test::bytes_of(folder.file("again.h5")) == one);
}

TEST(TreeFile, ComesBackInShares) {
  const TemporaryFolder folder;
  write_tree(world(), test::sample_tree(leaves, world().rank(), world().size()), folder.file("t.h5"));
  const TreeRecord read = read_tree(world(), folder.file("t.h5")), all = test::sample_tree(leaves, 0, 1);
  EXPECT_EQ(read.attributes.coordinate_digest, all.attributes.coordinate_digest);
  EXPECT_EQ(read.attributes.root_x, all.attributes.root_x);
  const auto count = std::ssize(read.leaves);
  EXPECT_EQ(world().sum(count), leaves);
  const std::int64_t first = world().exclusive_sum(count);
  for (std::int64_t i = 0; i < count; ++i) {
    const LeafRecord& a = read.leaves[i];
    const LeafRecord& b = all.leaves[first + i];
    const bool same = a.tree_x == b.tree_x && a.tree_y == b.tree_y && a.x == b.x && a.y == b.y &&
                      a.level == b.level && a.wanted == b.wanted && a.block == b.block &&
                      a.triangles == b.triangles && a.quads == b.quads && a.adapted == b.adapted;
    ASSERT_TRUE(same) << first + i;
  }
}

TEST(TreeFile, RefusesWhatIsNoneOnAllRanks) {
  const TemporaryFolder folder;
  EXPECT_EQ(test::status_of([&] { read_tree(world(), folder.file("missing.h5")); }), ExitStatus::bad_input);
  write_tree(world(), test::sample_tree(100, world().rank(), world().size()), folder.file("t.h5"));
  if (world().is_root())
    test::write_bytes(folder.file("t.h5"), test::bytes_of(folder.file("t.h5")).substr(0, 1500));
  world().barrier();
  EXPECT_EQ(test::status_of([&] { read_tree(world(), folder.file("t.h5")); }), ExitStatus::bad_input);
}

/// The refusal of a sample tree of a hundred leaves after one change; the same on every rank, or "not one
/// refusal".
std::string refusal_of_tree(const std::function<void(TreeRecord& whole)>& change) {
  const TemporaryFolder folder;
  TreeRecord whole = test::sample_tree(100, 0, 1);
  change(whole);
  const std::int64_t count = std::ssize(whole.leaves), rank = world().rank(), ranks = world().size();
  TreeRecord own{
      whole.attributes,
      {whole.leaves.begin() + count * rank / ranks, whole.leaves.begin() + count * (rank + 1) / ranks}};
  write_tree(world(), own, folder.file("t.h5"));
  std::string refusal;
  try {
    read_tree(world(), folder.file("t.h5"));
  } catch (const InputError& error) {
    refusal = error.what();
  }
  const auto hash = static_cast<std::int64_t>(std::hash<std::string>{}(refusal));
  return world().minimum(hash) == world().maximum(hash) ? refusal : "not one refusal";
}

TEST(TreeFile, RefusesImpossibleLeavesAndAttributesByName) {
  EXPECT_EQ(refusal_of_tree([](TreeRecord&) {}), "");
  using Change = std::function<void(TreeRecord&)>;
  const std::vector<std::pair<std::string, Change>> refused{
      {"tree (0, 0) at (536870912, 0), level 1 has splits below itself",
       [](TreeRecord& t) { t.leaves[1].adapted = 2; }},
      {"has splits below itself", [](TreeRecord& t) { t.leaves[60].adapted = 0x80000000; }},
      {"target level 2", [](TreeRecord& t) { t.leaves[1].wanted = 2; }},
      {"impossible level", [](TreeRecord& t) { t.leaves[50].level = 31; }},
      {"not on the grid", [](TreeRecord& t) { t.leaves[2].y += 1; }},
      {"none of the trees", [](TreeRecord& t) { t.leaves[99].tree_x = 97; }},
      {"below 0", [](TreeRecord& t) { t.leaves[7].quads = -1; }},
      {"outside the domain, but has cells", [](TreeRecord& t) { t.leaves[1].block = 0; }},
      {"does not follow", [](TreeRecord& t) { std::swap(t.leaves[1], t.leaves[2]); }},
      {"does not follow", [](TreeRecord& t) { t.leaves.erase(t.leaves.begin() + 2); }},
      {"trees", [](TreeRecord& t) { t.leaves.erase(t.leaves.begin() + 50); }},
      {"quadrilaterals", [](TreeRecord& t) { t.attributes.quads += 1; }},
      {"triangles", [](TreeRecord& t) { t.leaves[1].triangles += 1; }},
      {"1000000 by 1 trees", [](TreeRecord& t) { t.attributes.trees_x = 1000000; }},
      {"gradation is nan", [](TreeRecord& t) { t.attributes.gradation = std::nan(""); }},
      {"tree edge is -1", [](TreeRecord& t) { t.attributes.tree_edge = -1; }},
      {"root lies at", [](TreeRecord& t) { t.attributes.root_y = std::numeric_limits<double>::infinity(); }}};
  for (const auto& [part, change] : refused) {
    const std::string refusal = refusal_of_tree(change);
    EXPECT_NE(refusal.find(part), std::string::npos) << part << " is not in: " << refusal;
    EXPECT_NE(refusal.find("t.h5: "), std::string::npos) << refusal;
  }
}

}  // namespace
}  // namespace quadloop::io
