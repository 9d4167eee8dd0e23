#include "adapt/transfer/mesh_integrals.hpp"

#include <array>
#include <cmath>
#include <span>

#include "mesher/base/parallel/reproducible_sum.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"

namespace quadloop {

namespace {

/// What is summed up: a variable, or its absolute value.
struct Column {
  std::size_t variable = 0;
  bool of_size = false;
};

/// The halves of a quad make one term: sums cost more than terms.
std::vector<double> integrals(const Communicator& comm, const Mesh& mesh, Point centre, const Field& field,
                              std::span<const Column> columns) {
  std::vector<std::vector<double>> terms(columns.size());
  for (std::vector<double>& of_column : terms) of_column.reserve(mesh.triangles.size() + mesh.quads.size());
  const auto add = [&](const TrianglesOfCell& parts) {
    std::array<double, 2> thirds{};
    for (std::size_t part = 0; part < parts.count; ++part) {
      const auto& [a, b, c] = parts.nodes[part];
      thirds[part] = cross(mesh.point(b) - mesh.point(a), mesh.point(c) - mesh.point(a)) / 6;
    }
    for (std::size_t k = 0; k < columns.size() && parts.count > 0; ++k) {
      const auto value = [&, column = columns[k]](NodeId node) {
        const double of_node = field.row(node)[column.variable];
        return column.of_size ? std::abs(of_node) : of_node;
      };
      const auto term = [&](std::size_t part) {
        const auto& [a, b, c] = parts.nodes[part];
        return thirds[part] * (value(a) + value(b) + value(c));
      };
      terms[k].push_back(parts.count == 1 ? term(0) : term(0) + term(1));
    }
  };
  for (const auto& triangle : mesh.triangles) add(parts_of(mesh, centre, triangle));
  for (const auto& quad : mesh.quads) add(parts_of(mesh, centre, quad));
  std::vector<double> sums;
  for (const std::vector<double>& of_column : terms) sums.push_back(reproducible_sum(comm, of_column));
  return sums;
}

std::vector<Column> all_variables(const Field& field) {
  std::vector<Column> columns;
  for (std::size_t k = 0; k < field.width(); ++k) columns.push_back({k, false});
  return columns;
}

/// Over the nodes of all ranks.
bool has_negative(const Communicator& comm, const Field& field, std::size_t column) {
  bool negative = false;
  for (std::size_t i = column; i < field.values.size(); i += field.width())
    negative = negative || field.values[i] < 0;
  return comm.any(negative);
}

}  // namespace

std::vector<double> integrate(const Communicator& comm, const Mesh& mesh, Point centre, const Field& field) {
  return integrals(comm, mesh, centre, field, all_variables(field));
}

NodalIntegrals integrate_with_sizes(const Communicator& comm, const Mesh& mesh, Point centre,
                                    const Field& field) {
  std::vector<Column> columns = all_variables(field);
  for (std::size_t k = 0; k < field.width(); ++k) {  // densities and pressures are their own absolute values
    if (has_negative(comm, field, k)) columns.push_back({k, true});
  }
  const std::vector<double> sums = integrals(comm, mesh, centre, field, columns);
  NodalIntegrals found{{sums.begin(), sums.begin() + std::ssize(field.names)}, {}};
  found.sizes = found.values;
  for (std::size_t k = field.width(); k < sums.size(); ++k) found.sizes[columns[k].variable] = sums[k];
  return found;
}

CellIntegrals integrate_cells(const Communicator& comm, const Mesh& mesh, const CellValues& cells) {
  const std::vector<CellShape> shapes = cell_shapes(mesh);
  CellIntegrals integrals;
  for (std::size_t k = 0; k < cells.width(); ++k) {
    std::vector<double> terms(shapes.size()), sizes(shapes.size());
    for (std::size_t cell = 0; cell < shapes.size(); ++cell) {
      terms[cell] = shapes[cell].area * cells.values[cell * cells.width() + k];
      sizes[cell] = std::abs(terms[cell]);
    }
    integrals.values.push_back(reproducible_sum(comm, terms));
    integrals.sizes.push_back(reproducible_sum(comm, sizes));
  }
  return integrals;
}

}  // namespace quadloop
