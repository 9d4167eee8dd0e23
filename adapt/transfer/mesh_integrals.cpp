#include "adapt/transfer/mesh_integrals.hpp"

#include <cmath>

#include "mesher/base/parallel/reproducible_sum.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"

namespace quadloop {

namespace {

/// Of the node values that `value_of` gives. The halves of a quad make one term: sums cost more than terms.
template <class ValueOf>
double integral(const Communicator& comm, const Mesh& mesh, std::span<const CellTriangle> triangles,
                const ValueOf& value_of) {
  std::vector<double> terms;
  terms.reserve(triangles.size());
  std::int64_t last_cell = -1;
  for (const CellTriangle& triangle : triangles) {
    const auto& [a, b, c] = triangle.nodes;
    const double third = cross(mesh.point(b) - mesh.point(a), mesh.point(c) - mesh.point(a)) / 6;
    const double term = third * (value_of(a) + value_of(b) + value_of(c));
    if (triangle.number / 2 == last_cell) {
      terms.back() += term;
    } else {
      terms.push_back(term);
    }
    last_cell = triangle.number / 2;
  }
  return reproducible_sum(comm, terms);
}

/// Over the nodes of all ranks.
bool has_negative(const Communicator& comm, const Field& field, std::size_t column) {
  bool negative = false;
  for (std::size_t i = column; i < field.values.size(); i += field.width())
    negative = negative || field.values[i] < 0;
  return comm.any(negative);
}

}  // namespace

std::vector<double> integrate(const Communicator& comm, const Mesh& mesh,
                              std::span<const CellTriangle> triangles, const Field& field) {
  std::vector<double> integrals;
  for (std::size_t k = 0; k < field.width(); ++k) {
    integrals.push_back(integral(comm, mesh, triangles, [&](NodeId node) { return field.row(node)[k]; }));
  }
  return integrals;
}

std::vector<double> integrate_sizes(const Communicator& comm, const Mesh& mesh,
                                    std::span<const CellTriangle> triangles, const Field& field,
                                    const std::vector<double>& of_values) {
  std::vector<double> integrals = of_values;  // densities and pressures are their own absolute values
  for (std::size_t k = 0; k < integrals.size(); ++k) {
    if (!has_negative(comm, field, k)) continue;
    integrals[k] = integral(comm, mesh, triangles, [&](NodeId node) { return std::abs(field.row(node)[k]); });
  }
  return integrals;
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
