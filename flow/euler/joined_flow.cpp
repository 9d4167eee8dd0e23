#include "flow/euler/joined_flow.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "flow/euler/scheme/turned.hpp"
#include "mesher/base/error.hpp"
#include "mesher/geometry/turn.hpp"

namespace quadloop::flow::euler {

namespace {

bool sees_free_stream(const BoundaryModel& boundary) {
  return boundary.condition == Condition::farfield || boundary.condition == Condition::inflow;
}

}  // namespace

void require_usable_with_pairs(const Mesh& mesh, const FlowModel& model, const EulerOptions& options) {
  const PeriodicPair& first = mesh.pairs.front();
  const auto refuse = [&](const char* what, const char* remedy) {
    throw InputError(
        fmt::format("boundaries '{}' and '{}' are a periodic pair, with which the built-in flow "
                    "solver does not support {}; {}",
                    first.from, first.to, what, remedy));
  };
  if (options.far_field == EulerOptions::FarField::vortex)
    refuse("far_field = \"vortex\"", "use \"uniform\"");
  if (!options.goals.empty()) refuse("output functionals (goal)", "remove them, or use a sensor");
  const bool rotates = std::ranges::any_of(mesh.pairs, &PeriodicPair::rotates);
  if (rotates && options.mach > 0 && std::ranges::any_of(model.boundaries, sees_free_stream)) {
    refuse("a free stream at a far field or inflow if the pair is a rotation",
           "the free stream does not turn with it: use an external solver");
  }
}

Field at_joined_nodes(const PeriodicMesh& joined, const Field& given) {
  if (given.width() == 0) return given;
  const std::size_t rows = given.values.size() / given.width();
  QUADLOOP_REQUIRE(rows == joined.node_of.size(), "a row for each owned node", rows, joined.node_of.size());
  Field field = given;
  field.values.clear();
  for (const NodeId node : joined.node_of.ids()) {
    if (!joined.mesh.owns(joined.node_of[node])) continue;
    const auto row = given.row(node);
    field.values.insert(field.values.end(), row.begin(), row.end());
  }
  return field;
}

Field at_given_nodes(const DualMesh& mesh, const PeriodicMesh& joined, const Field& flow) {
  const std::size_t width = flow.width();
  Field all = flow, result = flow;
  all.values.resize(width * mesh.nodes());
  mesh.exchange().update_rows(all.values, width);
  result.values.clear();
  for (const NodeId node : joined.node_of) {
    const auto row = all.row(node);
    result.values.insert(result.values.end(), row.begin(), row.end());
    const double degrees = joined.maps.degrees(shift_of(mesh.halo().image(node)));
    if (degrees == 0) continue;
    for (std::size_t column = 0; column + 1 < width; ++column) {
      if (!flow.names[column].starts_with("x_velocity")) continue;  // that along y follows
      double* of_node = result.values.data() + result.values.size() - width + column;
      const Point velocity = turned(Point{of_node[0], of_node[1]}, unit_vector(degrees));
      of_node[0] = velocity.x;
      of_node[1] = velocity.y;
    }
  }
  return result;
}

}  // namespace quadloop::flow::euler
