// Fields that cannot be are refused by name and node on all ranks; others are scaled to their range.
#include "adapt/sensor/recovery/scaled_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesher/base/error.hpp"
#include "tests/adapt/sensor/infinite.hpp"
#include "tests/adapt/sensor/shared_leaves.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::field_of;
using test::infinite;
using test::world;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A grid of 16 nodes at (i / 3, j / 3), spread over the ranks.
Mesh grid_part() {
  const Mesh mesh = test::Grid{3}.mesh();
  return test::Pieces(mesh, own_order(mesh)).part;
}

/// The refusal of a field that is 1 but for two nodes (counted from 0), the second of which must not be the
/// one named.
std::string refusal(double value, FieldSign sign) {
  const Mesh mesh = grid_part();
  const Field field = field_of(mesh, "density",
                               [&](std::int64_t node, Point) { return node == 6 || node == 13 ? value : 1; });
  try {
    check_field(world(), mesh, field, sign);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool starts_with(const std::string& text, const std::string& start) { return text.rfind(start, 0) == 0; }

TEST(CheckField, NamesTheFirstNodeThatIsNotFinite) {
  const std::string place = "variable 'density': node 7 at (0.666666666667, 0.333333333333) has the value ";
  for (const FieldSign sign : {FieldSign::any, FieldSign::not_negative, FieldSign::positive}) {
    EXPECT_TRUE(starts_with(refusal(infinite, sign), place + "inf, which is not finite"))
        << refusal(infinite, sign);
    EXPECT_TRUE(starts_with(refusal(-infinite, sign), place + "-inf, which is not finite"))
        << refusal(-infinite, sign);
    EXPECT_NE(refusal(not_a_number, sign).find("nan, which is not finite"), std::string::npos);
  }
}

TEST(CheckField, LooksAtEveryNode) {
  const Mesh mesh = grid_part();
  for (std::int64_t bad = 0; bad < 16; ++bad) {
    const Field field =
        field_of(mesh, "density", [&](std::int64_t node, Point) { return node == bad ? infinite : 1; });
    EXPECT_THROW(check_field(world(), mesh, field, FieldSign::any), InputError) << bad;
  }
}

TEST(CheckField, ChecksTheSign) {
  EXPECT_EQ(refusal(-1, FieldSign::any), "");
  EXPECT_EQ(refusal(0, FieldSign::not_negative), "");
  EXPECT_EQ(refusal(1e-300, FieldSign::positive), "");
  EXPECT_NE(refusal(-1, FieldSign::not_negative).find("node 7 "), std::string::npos);
  EXPECT_NE(refusal(-1, FieldSign::positive).find("node 7 "), std::string::npos);
  EXPECT_NE(refusal(0, FieldSign::positive).find("node 7 "), std::string::npos);
}

TEST(ScaledField, IsScaledToItsRange) {
  const Mesh mesh = grid_part();
  for (const double factor :
       {1.0, -0.25, 0x1p1019, -0x1p-1000}) {  // the third one's range, 30 units wide, overflows
    const Field field = field_of(
        mesh, "q", [&](std::int64_t node, Point) { return factor * static_cast<double>(2 * node - 15); });
    const ScaledField scaled = scaled_by_range(world(), with_ghosts(world(), mesh, field).column(0));
    EXPECT_FALSE(scaled.constant);
    EXPECT_EQ(scaled.rounding, 0x1p-44 * (0.5 * 15 / 15));
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      const double at = static_cast<double>(mesh.global(NodeId{static_cast<std::int32_t>(i)}).value()) / 15;
      EXPECT_EQ(
          scaled.values[i],
          factor > 0
              ? at
              : static_cast<double>(15 - mesh.global(NodeId{static_cast<std::int32_t>(i)}).value()) / 15);
    }
  }
}

TEST(ScaledField, IsConstantWithinRounding) {
  const Mesh mesh = grid_part();
  const auto is_constant = [&](double base, double change) {
    const Field field =
        field_of(mesh, "q", [&](std::int64_t node, Point) { return node == 5 ? base + change : base; });
    return scaled_by_range(world(), with_ghosts(world(), mesh, field).column(0)).constant;
  };
  EXPECT_TRUE(is_constant(0, 0));
  EXPECT_TRUE(is_constant(-7.5, 0));
  EXPECT_TRUE(is_constant(1e5, 1e-10));
  EXPECT_TRUE(is_constant(1, 0x1p-45));
  EXPECT_FALSE(is_constant(1, 0x1p-43));
  EXPECT_FALSE(is_constant(0, 1e-300));
  EXPECT_TRUE(scaled_by_range(world(), {}).constant);
}

}  // namespace
}  // namespace quadloop::adapt
