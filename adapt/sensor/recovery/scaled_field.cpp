#include "adapt/sensor/recovery/scaled_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "mesher/base/error.hpp"
#include "mesher/mesh/cells/cell_owners.hpp"

namespace quadloop::adapt {

namespace {

/// The fault of a value and its remedy; nullptr if there is none.
const char* fault_of(double value, FieldSign sign) {
  if (!std::isfinite(value)) return "which is not finite; correct the solution";
  if (sign == FieldSign::not_negative && value < 0)
    return "but an error is never negative; correct what the solver writes";
  if (sign == FieldSign::positive && value <= 0)
    return "but a target size must be above 0; correct what the solver writes";
  return nullptr;
}

/// `place` is "node" or "cell"; `number` counts from 1.
[[noreturn]] void refuse(const std::string& name, const char* place, std::int64_t number, Point p,
                         double value, const char* fault) {
  std::ostringstream message;
  message.precision(12);
  message << "variable '" << name << "': " << place << " " << number << " at (" << p.x << ", " << p.y
          << ") has the value " << value << ", " << fault;
  throw InputError(message.str());
}

void check_variable(const Mesh& mesh, const Field& field, std::size_t variable, FieldSign sign) {
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
    const double value = field.row(NodeId{node})[variable];
    if (const char* fault = fault_of(value, sign))
      refuse(field.names[variable], "node", mesh.first_node + node + 1, mesh.point(NodeId{node}), value,
             fault);
  }
}

/// Checks one kind of cells, triangles or quadrilaterals; a cell's place is its first corner.
template <class Cells>
void check_cells(const Mesh& mesh, const Cells& cells, const CellValues& values, std::size_t first_row,
                 std::int64_t first_number, std::size_t variable, FieldSign sign) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double value = values.values[(first_row + i) * values.width() + variable];
    if (const char* fault = fault_of(value, sign))
      refuse(values.names[variable], "cell", first_number + static_cast<std::int64_t>(i) + 1,
             mesh.point(cells[i][0]), value, fault);
  }
}

}  // namespace

void check_field(const Communicator& comm, const Mesh& mesh, const Field& field, FieldSign sign) {
  for (std::size_t variable = 0; variable < field.width(); ++variable) {
    // Nodes are numbered in rank order, so the lowest rank that throws has the first node.
    comm.together([&] { check_variable(mesh, field, variable, sign); });
  }
  if (field.cells.width() == 0) return;
  const CellOwners owners(comm, mesh);
  const auto triangles = std::ssize(mesh.triangles);
  for (std::size_t variable = 0; variable < field.cells.width(); ++variable) {
    comm.together(
        [&] { check_cells(mesh, mesh.triangles, field.cells, 0, owners.number(0), variable, sign); });
    comm.together([&] {
      check_cells(mesh, mesh.quads, field.cells, triangles, owners.number(triangles), variable, sign);
    });
  }
}

ScaledField scaled_by_range(const Communicator& comm, std::vector<double> values) {
  ScaledField scaled;
  scaled.values = std::move(values);
  double smallest = std::numeric_limits<double>::infinity(), largest = -smallest;
  for (const double value : scaled.values) {
    smallest = std::min(smallest, value);
    largest = std::max(largest, value);
  }
  smallest = comm.minimum(smallest);
  largest = comm.maximum(largest);
  constexpr double share = 0x1p-44;
  const double size = std::max(std::abs(smallest), std::abs(largest));
  const double half_range = 0.5 * largest - 0.5 * smallest;  // the full range may overflow
  scaled.constant = !(half_range > 0.5 * share * size);      // also true if there are no nodes
  for (double& value : scaled.values)
    value = scaled.constant ? 0 : (0.5 * value - 0.5 * smallest) / half_range;
  scaled.rounding = scaled.constant ? 0 : share * (0.5 * size / half_range);
  return scaled;
}

}  // namespace quadloop::adapt
