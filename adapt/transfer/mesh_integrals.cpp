#include "adapt/transfer/mesh_integrals.hpp"

#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "mesher/base/parallel/reproducible_sum.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"

namespace quadloop {

namespace {

/// Of some columns, of what `of_value` makes of each value. The halves of a quad make one term: sums cost more
/// than terms.
template <class OfValue>
std::vector<double> integrals(const Communicator& comm, const Mesh& mesh, Point centre, const Field& field,
                              std::span<const std::size_t> columns, const OfValue& of_value) {
  std::vector<std::vector<double>> terms(columns.size());
  for (std::vector<double>& of_column : terms) of_column.reserve(mesh.triangles.size() + mesh.quads.size());
  const auto add = [&](const CellParts& parts) {
    std::array<double, 2> thirds{};
    for (std::size_t part = 0; part < parts.count; ++part) {
      const auto& [a, b, c] = parts.nodes[part];
      thirds[part] = cross(mesh.point(b) - mesh.point(a), mesh.point(c) - mesh.point(a)) / 6;
    }
    for (std::size_t k = 0; k < columns.size() && parts.count > 0; ++k) {
      const auto value = [&](NodeId node) { return of_value(field.row(node)[columns[k]]); };
      double term = 0;
      for (std::size_t part = 0; part < parts.count; ++part) {
        const auto& [a, b, c] = parts.nodes[part];
        const double of_part = thirds[part] * (value(a) + value(b) + value(c));
        term = part == 0 ? of_part : term + of_part;
      }
      terms[k].push_back(term);
    }
  };
  for (const auto& triangle : mesh.triangles) add(parts_of(mesh, centre, triangle));
  for (const auto& quad : mesh.quads) add(parts_of(mesh, centre, quad));
  std::vector<double> sums;
  for (const std::vector<double>& of_column : terms) sums.push_back(reproducible_sum(comm, of_column));
  return sums;
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
  std::vector<std::size_t> all(field.width());
  std::iota(all.begin(), all.end(), 0);
  return integrals(comm, mesh, centre, field, all, [](double value) { return value; });
}

std::vector<double> integrate_sizes(const Communicator& comm, const Mesh& mesh, Point centre,
                                    const Field& field, const std::vector<double>& of_values) {
  std::vector<double> sizes = of_values;  // densities and pressures are their own absolute values
  std::vector<std::size_t> others;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    if (has_negative(comm, field, k)) others.push_back(k);
  }
  if (others.empty()) return sizes;
  const std::vector<double> of_others =
      integrals(comm, mesh, centre, field, others, [](double value) { return std::abs(value); });
  for (std::size_t i = 0; i < others.size(); ++i) sizes[others[i]] = of_others[i];
  return sizes;
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
