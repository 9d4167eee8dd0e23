// The table of formats: what lists are made from it, and that each row reads what it writes.
#include "io/formats.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include "tests/io/sample_mesh.hpp"

namespace quadloop {
namespace {

using Names = std::vector<std::string>;

TEST(Formats, AreListedByWhatTheyHold) {
  EXPECT_EQ(formats_for({}), (Names{"mesh", "cgns", "vtu", "su2", "msh", "csv"}));
  EXPECT_EQ(formats_for({Content::mesh}), (Names{"mesh", "cgns", "vtu", "su2", "msh"}));
  EXPECT_EQ(formats_for({Content::mesh, Content::solution}), (Names{"mesh", "cgns", "vtu"}));
  EXPECT_EQ(formats_for({Content::constants}), (Names{"mesh"}));
  EXPECT_EQ(formats_for({Content::blocks, Content::conditions}), Names{});
}

TEST(Formats, StandInASentenceBySuffix) {
  EXPECT_EQ(suffixes_for({Content::mesh}), ".mesh, .cgns, .vtu, .su2 or .msh");
  EXPECT_EQ(suffixes_for({Content::solution}, "and"), ".mesh, .cgns, .vtu and .csv");
  EXPECT_EQ(suffixes_for({Content::conditions}), ".cgns");
}

TEST(Formats, AreFoundByNameAndSuffix) {
  EXPECT_EQ(format_named("vtu")->name, "vtu");
  EXPECT_EQ(format_of("a/b.tree.cgns")->name, "cgns");
  for (const char* path : {"a", "a.MESH", "mesh", "a.mesh/b", ".mesh", "a.tree.h5", "a."})
    EXPECT_EQ(format_of(path), nullptr) << path;
  EXPECT_EQ(format_named(""), nullptr);
  EXPECT_EQ(format_named(".vtu"), nullptr);
}

/// Through the functions of its row alone, as a mesh or, where it holds none, as a solution.
void expect_same_solution(const FileFormat& format, const std::string& path, const Mesh& mesh,
                          const Field& solution) {
  if (format.holds(Content::mesh)) {
    const LoadedMesh loaded = format.read_mesh(path);
    EXPECT_EQ(loaded.mesh.points, mesh.points);
    ASSERT_EQ(loaded.solution.has_value(), format.holds(Content::solution));
    if (!loaded.solution) return;
    EXPECT_EQ(loaded.solution->values, solution.values);
    EXPECT_EQ(loaded.solution->constants,
              format.holds(Content::constants) ? solution.constants : std::vector<double>{});
  } else {
    EXPECT_EQ(format.read_solution(path).solution.values, solution.values);
  }
}

TEST(Formats, EachReadsWhatItWrites) {
  const Communicator alone(MPI_COMM_SELF);
  const test::TemporaryFolder folder;
  LoadedMesh whole;
  whole.mesh = test::sample_mesh(5);
  whole.triangle_to_block.assign(whole.mesh.triangles.size(), 0);
  whole.quad_to_block.assign(whole.mesh.quads.size(), 0);
  whole.solution = test::sample_solution(whole.mesh);
  for (const FileFormat& format : file_formats()) {
    SCOPED_TRACE(format.name);
    const std::string path = folder.file("a." + format.name), of_whole = folder.file("b." + format.name);
    OutputSet outputs(alone);
    format.write(outputs, whole.mesh, path, &*whole.solution, 1.4);
    if (format.write_whole != nullptr) format.write_whole(outputs, whole, of_whole);
    outputs.commit();
    EXPECT_EQ(format.write_whole != nullptr, format.holds(Content::mesh));
    expect_same_solution(format, path, whole.mesh, *whole.solution);
    if (format.write_whole == nullptr) continue;
    EXPECT_EQ(test::bytes_of(of_whole), test::bytes_of(path));
  }
}

}  // namespace
}  // namespace quadloop
