// Names and elements as CGNS has them. On one rank alone.
#include "io/cgns/cgns_names.hpp"

#include <cgnslib.h>
#include <gtest/gtest.h>

#include <set>

#include "io/cgns/cgns_exponents.hpp"
#include "io/cgns/cgns_faces.hpp"
#include "mesher/geometry/boundary_conditions.hpp"

namespace quadloop::io {
namespace {

using Names = std::vector<std::string>;

TEST(CgnsNames, AreShortDistinctAndWithoutSlashes) {
  const std::string of_40(40, 'a');
  const Names names{"wall", "wall", "a/b", "a_b", of_40, of_40 + "x", "", "ZoneBC", "TRI_3", "domain", ".."};
  const Names found = cgns_boundary_names(names);
  ASSERT_EQ(found.size(), names.size());
  std::set<std::string> distinct(found.begin(), found.end());
  EXPECT_EQ(distinct.size(), names.size());
  for (const std::string& name : found) {
    EXPECT_LE(name.size(), 32U);
    EXPECT_EQ(name.find('/'), std::string::npos);
    EXPECT_FALSE(name.empty());
  }
  EXPECT_EQ(found[0], "wall");
  EXPECT_EQ(found[1], "wall_2");
  EXPECT_EQ(found[2], "a_b");
  EXPECT_EQ(found[3], "a_b_2");
  EXPECT_EQ(found[5], std::string(30, 'a') + "_2");
  EXPECT_NE(found[7], "ZoneBC");
  EXPECT_EQ(cgns_boundary_names(names), found);
}

TEST(CgnsNames, AreNotCutInsideACharacter) {
  const std::string name = std::string(31, 'a') + "\xC3\xA9";
  EXPECT_EQ(cgns_boundary_names({name})[0], std::string(31, 'a'));
  EXPECT_EQ(cgns_boundary_names({std::string(30, 'a') + "\xC3\xA9"})[0], std::string(30, 'a') + "\xC3\xA9");
}

TEST(CgnsNames, ManyOfOneNameStayDistinct) {
  const Names found = cgns_boundary_names(Names(1200, std::string(40, 'b')));
  EXPECT_EQ(std::set<std::string>(found.begin(), found.end()).size(), 1200U);
  EXPECT_EQ(found.back(), std::string(27, 'b') + "_1200");
}

TEST(CgnsNames, VariablesHaveTheirNamesInTheStandard) {
  const Names ours{"density", "x_velocity", "entropy", "Density"};
  const Names found = cgns_variable_names(ours);
  EXPECT_EQ(found, (Names{"Density", "VelocityX", "entropy", "Density_2"}));
  EXPECT_EQ(variable_name_of_cgns("VelocityX"), "x_velocity");
  EXPECT_EQ(variable_name_of_cgns("Entropy"), "Entropy");
}

TEST(CgnsNames, VariablesAreNothingElseOfASolution) {
  const Names ours{"GridLocation", "Rind", "a/b", "x_velocity", std::string(40, 'y')};
  const Names found = cgns_variable_names(ours);
  EXPECT_EQ(found, (Names{"GridLocation_2", "Rind_2", "a_b", "VelocityX", std::string(32, 'y')}));
  const Names shown = cgns_variable_renames(ours);
  EXPECT_EQ(shown, (Names{"GridLocation_2", "Rind_2", "a_b", "x_velocity", std::string(32, 'y')}));
}

TEST(CgnsExponents, AreThoseOfTheStandard) {
  EXPECT_EQ(cgns_exponents("Density"), (CgnsExponents{1, -3}));
  EXPECT_EQ(cgns_exponents("Pressure"), (CgnsExponents{1, -1, -2}));
  EXPECT_EQ(cgns_exponents("VelocityX"), (CgnsExponents{0, 1, -1}));
  EXPECT_EQ(cgns_exponents("MomentumZ"), (CgnsExponents{1, -2, -1}));
  EXPECT_EQ(cgns_exponents("VelocityMagnitude"), (CgnsExponents{0, 1, -1}));
  EXPECT_EQ(cgns_exponents("Mach"), CgnsExponents{});
  for (const char* const name : {"", "X", "Velocity", "VelocityW", "density", "CoordinateMagnitude"})
    EXPECT_FALSE(cgns_exponents(name)) << name;
}

TEST(CgnsNames, ConditionsComeBack) {
  for (const auto& [word, condition] : BoundaryCondition::words) {
    const int type = cgns_condition(condition);
    const bool has_type = condition != BoundaryCondition::interface && condition != BoundaryCondition::none;
    EXPECT_EQ(type != BCTypeUserDefined, has_type) << word;
    EXPECT_EQ(condition_of_cgns(type), has_type ? condition : BoundaryCondition::none) << word;
    EXPECT_EQ(condition_of_cgns_family(type, cgns_family_condition(condition)), condition) << word;
  }
  EXPECT_EQ(cgns_condition(BoundaryCondition::viscous_wall), BCWallViscous);
  EXPECT_EQ(condition_of_cgns(BCWallViscousIsothermal), BoundaryCondition::viscous_wall);
  EXPECT_TRUE(condition_of_cgns(BCWallViscousHeatFlux).is_wall());
  EXPECT_EQ(condition_of_cgns(BCTunnelOutflow), BoundaryCondition::outflow);
  EXPECT_EQ(condition_of_cgns(-3), BoundaryCondition::none);
}

using Face = CgnsFaces::Face;
constexpr Face edge(std::int32_t number) {
  return {number, number + 1, FileBoundary::no_node, FileBoundary::no_node};
}

TEST(CgnsFaces, AreTakenOnceEach) {
  CgnsFaces faces;
  faces.begin_section("one");
  faces.add(7, edge(7));
  faces.add(5, edge(5));
  faces.begin_section("empty");
  faces.begin_section("two");
  faces.add(5, edge(50));  // a number that stands twice
  faces.add(9, edge(9));
  faces.sort();
  EXPECT_EQ(faces.size(), 4U);
  EXPECT_EQ(faces.take(5), edge(5));
  EXPECT_EQ(faces.take(5), edge(50));
  EXPECT_EQ(faces.take(5), std::nullopt);
  EXPECT_EQ(faces.take(6), std::nullopt);
  EXPECT_EQ(faces.take(10), std::nullopt);
  std::vector<std::pair<std::string, Face>> left;
  faces.for_each_left([&](const std::string& section, const Face& e) { left.emplace_back(section, e); });
  EXPECT_EQ(left, (std::vector<std::pair<std::string, Face>>{{"one", edge(7)}, {"two", edge(9)}}));
}

TEST(CgnsFaces, MayBeNone) {
  CgnsFaces faces;
  faces.sort();
  EXPECT_EQ(faces.take(1), std::nullopt);
  faces.for_each_left([](const std::string&, const Face&) { FAIL(); });
}

}  // namespace
}  // namespace quadloop::io
