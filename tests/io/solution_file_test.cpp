// Solutions that solvers leave: tables of SU2, the formats that carry a mesh, names of variables, and
// solutions of another mesh. On one rank alone.
#include "io/solution_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "io/cgns/cgns_file.hpp"
#include "io/mesh_file.hpp"
#include "io/native/native_file.hpp"
#include "io/su2/su2_csv_file.hpp"
#include "io/vtu/vtu_file.hpp"
#include "mesher/base/error.hpp"
#include "tests/io/reader_check.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/io/write_alone.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::replaced;
using test::TemporaryFolder;

template <class Call>
std::string refusal_of(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no refusal";
}

void expect_in(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text << "\nlacks\n" << part;
}

LoadedSolution read_text(const std::string& text) {
  const TemporaryFolder folder;
  test::write_bytes(folder.file("s.csv"), text);
  return read_solution(folder.file("s.csv"));
}

const std::string table =
    "\"PointID\",\"x\",\"y\",\"Density\",\"Momentum_x\"\n0, 0.0, 0, 1.0, 2e-1\n1, 1, 0.5, 3, -4\n2, 1, 2, 5, "
    "6\n";

TEST(Su2Csv, ReadsNamesCoordinatesAndRows) {
  const LoadedSolution loaded = read_text(table);
  EXPECT_EQ(loaded.nodes, 3);
  EXPECT_EQ(loaded.solution.names, (std::vector<std::string>{"Density", "Momentum_x"}));
  EXPECT_EQ(loaded.solution.values, (std::vector<double>{1, 0.2, 3, -4, 5, 6}));
  EXPECT_EQ(loaded.points, (std::vector<Point>{{0, 0}, {1, 0.5}, {1, 2}}));
  EXPECT_FALSE(loaded.mesh);
  EXPECT_EQ(read_text(test::with_crlf(table) + "\r\n").solution.values, loaded.solution.values);
  EXPECT_EQ(read_text("rho\n1\n2\n").solution.values, (std::vector<double>{1, 2}));
  EXPECT_TRUE(read_text("rho\n1\n2\n").points.empty());
}

TEST(Su2Csv, PointIdsSortTheRows) {
  const LoadedSolution loaded = read_text(replaced(replaced(table, "\n0, ", "\n2, "), "\n2, 1,", "\n0, 1,"));
  EXPECT_EQ(loaded.solution.values, (std::vector<double>{5, 6, 3, -4, 1, 0.2}));
  EXPECT_EQ(loaded.points.at(0), (Point{1, 2}));
}

TEST(Su2Csv, RefusesByLine) {
  const auto expect = [](const std::string& text, const std::string& says) {
    expect_in(refusal_of([&] { read_text(text); }), says);
  };
  expect(replaced(table, "3, -4", "3, nan"), "s.csv:3: Momentum_x is not finite: nan");
  expect(replaced(table, "3, -4", "3"), "s.csv:3: 4 values stand under 5 names");
  expect(replaced(table, "3, -4", "3, -4, 7"), "s.csv:3: 6 values stand under 5 names");
  expect(replaced(table, "3, -4", "three, -4"), "s.csv:3: expected a number for Density, found \"three\"");
  expect(replaced(table, "\n2, 1, 2", "\n1, 1, 2"), "rows 2 and 3 have the same PointID 1");
  expect(replaced(table, "\n2, 1, 2", "\n7, 1, 2"), "row 3 has the PointID 7");
  expect("0,1,2\n", "s.csv:1: the first line must name the columns");
  expect("\"PointID\",\"x\",\"y\"\n0,1,2\n", "s.csv:1: the table has no variables");
  expect("\"x\",\"rho\"\n0,1\n", "only one of x and y");
  expect("\"x\",\"y\",\"z\",\"rho\"\n0,1,2,3\n0,1,3,3\n", "s.csv:3: z is 3, before 2");
  expect("rho\n", "no rows");
  expect("", "s.csv:1: the file is empty");
}

/// What comes back of the sample mesh with a row of these values at each node.
LoadedSolution through_csv(const std::vector<std::string>& names, const std::vector<double>& row,
                           std::string* header = nullptr) {
  const Mesh mesh = test::sample_mesh(2);
  Field solution{names, {}, {}};
  for (std::size_t node = 0; node < mesh.points.size(); ++node)
    solution.values.insert(solution.values.end(), row.begin(), row.end());
  const TemporaryFolder folder;
  OutputSet outputs(test::world());
  write_su2_csv(outputs, mesh, folder.file("s.csv"), solution, 1.5);
  outputs.commit();
  const std::string text = test::bytes_of(folder.file("s.csv"));
  if (header != nullptr) *header = text.substr(0, text.find('\n'));
  LoadedSolution loaded = read_solution(folder.file("s.csv"));
  require_same_mesh(loaded, mesh);
  loaded.solution.values.resize(loaded.solution.names.size());  // those of the first node
  return loaded;
}

TEST(Su2Csv, IsWrittenWithConservativeVariablesInFront) {
  std::string header;
  const LoadedSolution made =
      through_csv({"nut", "pressure", "density", "y_velocity", "x_velocity"}, {7, 3, 2, -1, 0.5}, &header);
  EXPECT_EQ(header, R"("PointID","x","y","Density","Momentum_x","Momentum_y","Energy","nut")");
  EXPECT_EQ(made.solution.values, (std::vector<double>{2, 1, -2, 3 / 0.5 + 0.5 * 2 * 1.25, 7}));
}

TEST(Su2Csv, KeepsTheBitsOfSu2sOwnVariables) {
  const double third = 1.0 / 3, tiny = 5e-324;
  std::string header;
  const LoadedSolution kept =
      through_csv({"Mach", "Density", "Energy", "Momentum_x", "Momentum_y", "Pressure"},
                  {0.1, third, 1e150, -tiny, 0.1, 3}, &header);
  EXPECT_EQ(header, R"("PointID","x","y","Density","Momentum_x","Momentum_y","Energy","Mach","Pressure")");
  EXPECT_EQ(kept.solution.values, (std::vector<double>{third, -tiny, 0.1, 1e150, 0.1, 3}));
}

TEST(Su2Csv, LeavesAnIncompressibleSolutionInItsOrder) {
  std::string header;
  const LoadedSolution kept =
      through_csv({"Pressure", "Velocity_x", "Velocity_y", "Nu_Tilde", "Density"}, {1, 2, 3, 4, 5}, &header);
  EXPECT_EQ(header, R"("PointID","x","y","Pressure","Velocity_x","Velocity_y","Nu_Tilde","Density")");
  EXPECT_EQ(kept.solution.values, (std::vector<double>{1, 2, 3, 4, 5}));
}

/// Layout of SU2 7 and 8 (CSU2FileWriter): names in quotes, commas with a blank behind them, 15 decimals.
TEST(Su2Csv, ReadsRowsAsSu2WritesThem) {
  const LoadedSolution left = read_text(
      "\"PointID\",\"x\",\"y\",\"Density\",\"Momentum_x\",\"Momentum_y\",\"Energy\",\"Skin_Friction_"
      "Coefficient_x\"\n"
      "0, 9.997500000000000e-01, -3.632500000000000e-05, 1.500000000000000e+00, 2.500000000000000e+02, "
      "3.725000000000000e+01, 3.806250000000000e+05, 0.000000000000000e+00\n"
      "1, 1.000000000000000e+00, 0.000000000000000e+00, 1.250000000000000e+00, -2.500000000000000e-310, "
      "0.000000000000000e+00, 3.750000000000000e+05, 1.250000000000000e-03\n");
  EXPECT_EQ(left.nodes, 2);
  EXPECT_EQ(left.points, (std::vector<Point>{{0.99975, -3.6325e-5}, {1, 0}}));
  EXPECT_EQ(left.solution.names, (std::vector<std::string>{"Density", "Momentum_x", "Momentum_y", "Energy",
                                                           "Skin_Friction_Coefficient_x"}));
  EXPECT_EQ(left.solution.values,
            (std::vector<double>{1.5, 250, 37.25, 380625, 0, 1.25, -2.5e-310, 0, 375000, 1.25e-3}));
}

TEST(Su2Csv, KeepsOtherVariablesUnderNamesThatAreReadBack) {
  const LoadedSolution kept = through_csv({"height", "x", "a,b", "a_b", "12", "PointID"}, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(kept.solution.names,
            (std::vector<std::string>{"height", "x_", "a_b", "a_b_", "v12", "PointID_"}));
  EXPECT_EQ(kept.solution.values, (std::vector<double>{1, 2, 3, 4, 5, 6}));
}

/// A mesh with its solution in each format.
class Formats : public testing::TestWithParam<std::string> {
 public:
  Mesh mesh = test::sample_mesh(4);
  Field solution = test::sample_solution(mesh);
  TemporaryFolder folder;

  std::string write(const Mesh& other, const Field* values) const {
    const std::string path = folder.file("s" + GetParam());
    if (GetParam() == ".mesh") test::write_alone(test::world(), other, path, values);
    if (GetParam() == ".cgns") test::write_alone(test::world(), other, path, values);
    if (GetParam() == ".vtu") test::write_alone(test::world(), other, path, values);
    return path;
  }
};

TEST_P(Formats, SolutionComesBackAndFitsItsMesh) {
  const LoadedSolution loaded = read_solution(write(mesh, &solution));
  EXPECT_EQ(loaded.solution.names, solution.names);
  EXPECT_EQ(loaded.solution.values, solution.values);
  EXPECT_EQ(loaded.nodes, mesh.owned_nodes);
  ASSERT_TRUE(loaded.mesh);
  EXPECT_EQ(loaded.mesh->mesh.boundaries.size(), mesh.boundaries.size());
  EXPECT_FALSE(loaded.mesh->solution);
  require_same_mesh(loaded, mesh);
}

TEST_P(Formats, AMeshWithoutSolutionIsRefused) {
  const std::string path = write(mesh, nullptr);
  const std::string said = refusal_of([&] { read_solution(path); });
  expect_in(said, path + ": holds a mesh without a solution");
}

TEST_P(Formats, SolutionsOfOtherMeshesAreTold) {
  const Mesh larger = test::sample_mesh(5);
  const Field its = test::sample_solution(larger);
  expect_in(refusal_of([&] { require_same_mesh(read_solution(write(larger, &its)), mesh); }),
            "holds values at 18 nodes, the mesh has 15");
  Mesh moved = mesh;
  moved.points[7].y += 2e-6;
  expect_in(refusal_of([&] { require_same_mesh(read_solution(write(moved, &solution)), mesh); }),
            "node 8 lies at");
  moved.points[7].y = mesh.points[7].y + 0.5e-6;
  require_same_mesh(read_solution(write(moved, &solution)), mesh);
  Mesh flipped = mesh;  // the other diagonal
  flipped.triangles[0] = {mesh.triangles[0][0], mesh.triangles[0][1], mesh.triangles[1][2]};
  flipped.triangles[1] = {mesh.triangles[0][1], mesh.triangles[0][2], mesh.triangles[1][2]};
  expect_in(refusal_of([&] { require_same_mesh(read_solution(write(flipped, &solution)), mesh); }),
            "its triangles contain one with the nodes 6 7 11");
  Mesh reordered = mesh;  // the same cells in another order, begun at other nodes
  std::reverse(reordered.quads.begin(), reordered.quads.end());
  for (auto& nodes : reordered.triangles) std::rotate(nodes.begin(), nodes.begin() + 1, nodes.end());
  require_same_mesh(read_solution(write(reordered, &solution)), mesh);
}

INSTANTIATE_TEST_SUITE_P(SolutionFile, Formats, testing::Values(".mesh", ".cgns", ".vtu"),
                         [](const auto& format) { return format.param.substr(1); });

TEST(SolutionFile, OtherNumbersOfCellsAreTold) {
  const Mesh mesh = test::sample_mesh(2);
  LoadedSolution loaded{"s.vtu", test::sample_solution(mesh), mesh.owned_nodes, LoadedMesh{}, {}};
  loaded.mesh->mesh = mesh;
  loaded.mesh->mesh.quads.pop_back();
  expect_in(refusal_of([&] { require_same_mesh(loaded, mesh); }), "s.vtu: has 1 quads, the mesh 2");
}

TEST(SolutionFile, RefusesFormatsWithoutSolutions) {
  expect_in(refusal_of([] { read_solution("a.su2"); }), "a.su2: no solution is read from the format '.su2'");
  expect_in(refusal_of([] { read_solution("missing.csv"); }), "missing.csv: cannot be opened");
}

TEST(SolutionNames, BlanksBecomeUnderscoresInEveryFormat) {
  EXPECT_EQ(read_text("wave height,b\n1,2\n2,3\n").solution.names,
            (std::vector<std::string>{"wave_height", "b"}));
  const TemporaryFolder folder;
  const Mesh mesh = test::sample_mesh(5);
  Field solution = test::sample_solution(mesh);
  for (std::string& name : solution.names) name = "of \tname " + name;
  test::write_alone(test::world(), mesh, folder.file("a.vtu"), &solution);
  test::write_alone(test::world(), mesh, folder.file("a.mesh"), &solution);
  const auto names = read_solution(folder.file("a.vtu")).solution.names;
  EXPECT_EQ(names, read_solution(folder.file("a.mesh")).solution.names);
  for (const std::string& name : names) EXPECT_EQ(name.find_first_of(" \t"), std::string::npos) << name;
}

TEST(SolutionNames, CgnsKeepsEachVariable) {
  const TemporaryFolder folder;
  const Mesh mesh = test::sample_mesh(5);
  Field solution = test::sample_solution(mesh);
  const std::string of_40(40, 'a');
  for (const auto& names :
       {std::vector<std::string>{of_40 + "1", of_40 + "2"}, {"density", "Density"}, {"a/b", "a_b"}}) {
    solution.names = names;
    test::write_alone(test::world(), mesh, folder.file("a.cgns"), &solution);
    EXPECT_EQ(read_solution(folder.file("a.cgns")).solution.values, solution.values) << names[0];
  }
}

TEST(SolutionNames, TwoOfOneNameAreRefused) {
  expect_in(refusal_of([] { read_text("h,h\n1,2\n"); }), "s.csv: two variables are named 'h'");
  const std::string both = refusal_of([] { read_text("wave height,b,wave_height\n1,2,3\n"); });
  for (const char* part : {"s.csv", "'wave height'", "'wave_height'"}) expect_in(both, part);
  EXPECT_EQ(read_text("h,H\n1,2\n").solution.names.size(), 2U);  // told apart by case where the name is exact
}

/// Three variables, at nodes and in cells.
Field three_variables(const Mesh& mesh) {
  Field solution{{"hhh", "q", "ggg"}, std::vector<double>(3 * mesh.points.size(), 1.5), {}};
  solution.cells = {{"HHH", "Q", "GGG"},
                    std::vector<double>(3 * (mesh.triangles.size() + mesh.quads.size()), 2.5)};
  return solution;
}

TEST(SolutionNames, AMeshWithTwoOfOneNameIsRefused) {
  const TemporaryFolder folder;
  const Mesh mesh = test::sample_mesh(5);
  const Field solution = three_variables(mesh);
  for (const char* name : {"a.mesh", "a.qmesh", "a.vtu"}) {
    const std::string path = folder.file(name);
    OutputSet outputs(test::world());
    write_mesh(outputs, mesh, path, &solution);
    outputs.commit();
    EXPECT_EQ(read_mesh(path).solution->cells.names, solution.cells.names);
    const std::string bytes = test::bytes_of(path);
    for (const auto& [one, other] : {std::pair{"ggg", "hhh"}, {"GGG", "HHH"}}) {
      test::write_bytes(path, replaced(bytes, one, other));
      expect_in(refusal_of([&] { read_mesh(path); }),
                fmt::format("{}: two variables are named '{}'", path, other));
    }
  }
}

TEST(SolutionNames, TwoThatAreOneAsWordsAreNotWritten) {
  const TemporaryFolder folder;
  const Mesh mesh = test::sample_mesh(5);
  for (const char* name : {"a.mesh", "a.qmesh"}) {
    for (const bool in_cells : {false, true}) {
      Field solution = three_variables(mesh);
      (in_cells ? solution.cells.names : solution.names) = {"wave height", "q", "wave_height"};
      const std::string fault = refusal_of([&] {
        OutputSet outputs(test::world());
        write_mesh(outputs, mesh, folder.file(name), &solution);
      });
      for (const char* part : {name, "'wave height'", "'wave_height'"}) expect_in(fault, part);
    }
  }
}

TEST(SolutionFile, ValuesThatOverflowAreRefused) {
  EXPECT_EQ(read_text("h\n1e150\n-1e150\n").nodes, 2);
  const std::string fault = refusal_of([] { read_text("h,g\n1,1\n2,-1.7e308\n"); });
  for (const char* part : {"s.csv", "g is beyond 1e+150", "node 2", "-1.7e+308"}) expect_in(fault, part);
}

}  // namespace
}  // namespace quadloop::io
