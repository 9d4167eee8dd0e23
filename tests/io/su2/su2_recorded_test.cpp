// Files that SU2 8.1 itself wrote, for flow.cfg on plate.su2 in the folder recorded.
#include <gtest/gtest.h>

#include "io/mesh_file.hpp"
#include "io/solution_file.hpp"
#include "io/su2/su2_csv_file.hpp"
#include "io/su2/su2_dat_file.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::TemporaryFolder;
using Names = std::vector<std::string>;

std::string recorded(const std::string& name) {
  return std::string(QUADLOOP_SOURCE_DIR) + "/tests/io/su2/recorded/" + name;
}

TEST(Su2Recorded, TheBinaryRestartFileIsReadAndWrittenBackByteByByte) {
  const LoadedMesh plate = read_mesh(recorded("plate.su2"));
  const LoadedSolution loaded = read_solution(recorded("restart.dat"));
  EXPECT_EQ(loaded.nodes, 25);
  EXPECT_NO_THROW(require_same_mesh(loaded, plate.mesh));
  EXPECT_EQ(loaded.solution.names,
            (Names{"Density", "Momentum_x", "Momentum_y", "Energy", "Nu_Tilde", "Pressure", "Temperature",
                   "Mach", "Pressure_Coefficient", "Velocity_x", "Velocity_y", "Laminar_Viscosity",
                   "Skin_Friction_Coefficient_x", "Skin_Friction_Coefficient_y", "Heat_Flux", "Y_Plus",
                   "Eddy_Viscosity"}));
  const TemporaryFolder folder;
  OutputSet outputs(test::world());
  write_su2_dat(outputs, plate.mesh, folder.file("r.dat"), loaded.solution);
  outputs.commit();
  EXPECT_TRUE(test::bytes_of(folder.file("r.dat")) == test::bytes_of(recorded("restart.dat")));
}

TEST(Su2Recorded, TheTextRestartFileHasTheSameFlowAndOurLayout) {
  const LoadedMesh plate = read_mesh(recorded("plate.su2"));
  const LoadedSolution text = read_solution(recorded("restart.csv")),
                       binary = read_solution(recorded("restart.dat"));
  EXPECT_NO_THROW(require_same_mesh(text, plate.mesh));
  const std::size_t width = text.solution.width(), all = binary.solution.width();
  ASSERT_EQ(text.solution.names, Names(binary.solution.names.begin(), binary.solution.names.begin() + 5));
  for (std::size_t i = 0; i < 25 * width; ++i) {
    const double value = binary.solution.values[i / width * all + i % width];
    EXPECT_NEAR(text.solution.values[i], value, 1e-14 * std::abs(value)) << "SU2 prints 16 digits";
  }
  const TemporaryFolder folder;
  OutputSet outputs(test::world());
  write_su2_csv(outputs, plate.mesh, folder.file("r.csv"), text.solution);
  outputs.commit();
  const std::string head = test::bytes_of(recorded("restart.csv"));
  EXPECT_TRUE(test::bytes_of(folder.file("r.csv")).starts_with(head.substr(0, head.find('\n'))));
  EXPECT_EQ(read_solution(folder.file("r.csv")).solution.values, text.solution.values);
}

}  // namespace
}  // namespace quadloop::io
