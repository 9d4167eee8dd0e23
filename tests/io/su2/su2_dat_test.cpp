// SU2's binary restart files, byte by byte.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "io/solution_file.hpp"
#include "io/su2/su2_dat_file.hpp"
#include "mesher/base/error.hpp"
#include "tests/io/reader_check.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::TemporaryFolder;
using Names = std::vector<std::string>;

template <class Number>
std::string bytes_of_number(Number value, bool turned) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  if (turned) std::ranges::reverse(bytes);
  return bytes;
}

/// As SU2 writes it, here or on a machine with the other order of bytes.
std::string restart_file(const Names& names, const std::vector<double>& values, bool turned = false) {
  std::string text;
  const auto nodes = static_cast<std::int32_t>(values.size() / names.size());
  for (const std::int32_t number : {535532, static_cast<std::int32_t>(names.size()), nodes, 0, 0})
    text += bytes_of_number(number, turned);
  for (std::string name : names) {
    name.resize(33);
    text += name;
  }
  for (const double value : values) text += bytes_of_number(value, turned);
  return text;
}

LoadedSolution read_bytes(const std::string& bytes) {
  const TemporaryFolder folder;
  test::write_bytes(folder.file("r.dat"), bytes);
  return read_solution(folder.file("r.dat"));
}

std::string refusal_of(const std::string& bytes) {
  try {
    read_bytes(bytes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no refusal";
}

const Names columns{"x", "y", "Density", "Nu_Tilde"};
const std::vector<double> rows{0, 0, 1, 2, 1, 0.5, 3, 4};

TEST(Su2Dat, ReadsNamesCoordinatesAndRowsInEitherOrderOfBytes) {
  for (const bool turned : {false, true}) {
    const LoadedSolution loaded = read_bytes(restart_file(columns, rows, turned));
    EXPECT_EQ(loaded.nodes, 2);
    EXPECT_EQ(loaded.solution.names, (Names{"Density", "Nu_Tilde"}));
    EXPECT_EQ(loaded.solution.values, (std::vector<double>{1, 2, 3, 4}));
    EXPECT_EQ(loaded.points, (std::vector<Point>{{0, 0}, {1, 0.5}}));
  }
}

TEST(Su2Dat, PassesOverWhatOldVersionsHaveBehindTheRows) {
  EXPECT_EQ(read_bytes(restart_file(columns, rows) + std::string(68, '\1')).solution.values,
            (std::vector<double>{1, 2, 3, 4}));
}

TEST(Su2Dat, RefusesWhatIsNone) {
  const std::string whole = restart_file(columns, rows);
  const auto expect = [](const std::string& bytes, const std::string& part) {
    const std::string said = refusal_of(bytes);
    EXPECT_NE(said.find("r.dat: " + part), std::string::npos) << said;
  };
  expect("", "is too short");
  expect("TITLE = \"a file of Tecplot\"", "is no binary restart file of SU2");
  expect(whole.substr(0, whole.size() - 1), "promises 4 variables at 2 nodes, but has");
  expect(whole.substr(0, 60), "promises 4 variables at 2 nodes, but has");
  std::string many = whole;
  std::memset(many.data() + 4, 0x7f, 8);
  expect(many, "promises 2139062143 variables at 2139062143 nodes, but has");
  expect(restart_file({"x", "y"}, {0, 0}), "has no variables beside coordinates");
  expect(restart_file({"x", "rho"}, {0, 0}), "has only one of the coordinates");
  expect(restart_file({"x", "y", "z", "rho"}, {0, 0, 0, 1}), "is of a mesh in three dimensions");
}

TEST(Su2Dat, IsWrittenAsSu2ReadsIt) {
  const Mesh mesh = test::sample_mesh(2);
  Field solution{{"density", "x_velocity", "y_velocity", "pressure"}, {}, {}};
  std::vector<double> expected;
  for (std::size_t node = 0; node < mesh.points.size(); ++node) {
    for (const double value : {2.0, 3.0, -4.0, 5.0}) solution.values.push_back(value);
    for (const double value : {mesh.points[node].x, mesh.points[node].y, 2.0, 6.0, -8.0, 35.0})
      expected.push_back(value);
  }
  const TemporaryFolder folder;
  OutputSet outputs(test::world());
  write_su2_dat(outputs, mesh, folder.file("r.dat"), solution, 1.5);
  outputs.commit();
  EXPECT_TRUE(test::bytes_of(folder.file("r.dat")) ==
              restart_file({"x", "y", "Density", "Momentum_x", "Momentum_y", "Energy"}, expected));
  require_same_mesh(read_solution(folder.file("r.dat")), mesh);
}

}  // namespace
}  // namespace quadloop::io
