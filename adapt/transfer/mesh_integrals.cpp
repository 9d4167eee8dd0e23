#include "adapt/transfer/mesh_integrals.hpp"

#include <cmath>

#include "mesher/base/reproducible_sum.hpp"

namespace quadloop {

namespace {

/// Of the column's values as `value_of` takes them.
template <class ValueOf>
double integral(const Communicator& comm, std::span<const CellTriangle> triangles, const std::vector<double>& thirds, const ValueOf& value_of,
                std::vector<double>& terms) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& [a, b, c] = triangles[i].nodes;
    terms[i] = thirds[i] * (value_of(a) + value_of(b) + value_of(c));
  }
  return reproducible_sum(comm, terms);
}

}  // namespace

MeshIntegrals integrate(const Communicator& comm, const Mesh& mesh, std::span<const CellTriangle> triangles, const NodeRows& rows) {
  std::vector<double> thirds, terms(triangles.size());
  thirds.reserve(triangles.size());
  for (const CellTriangle& triangle : triangles) {
    const auto& [a, b, c] = triangle.nodes;
    thirds.push_back(cross(mesh.point(b) - mesh.point(a), mesh.point(c) - mesh.point(a)) / 6);
  }
  MeshIntegrals integrals;
  for (std::size_t k = 0; k < static_cast<std::size_t>(rows.width); ++k) {
    const auto value = [&](NodeId node) { return rows.of(node)[k]; };
    const auto size = [&](NodeId node) { return std::abs(rows.of(node)[k]); };
    integrals.of_values.push_back(integral(comm, triangles, thirds, value, terms));
    integrals.of_sizes.push_back(integral(comm, triangles, thirds, size, terms));
  }
  return integrals;
}

}  // namespace quadloop
