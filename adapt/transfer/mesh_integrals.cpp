#include "adapt/transfer/mesh_integrals.hpp"

#include <array>
#include <cmath>
#include <span>

#include "mesher/base/parallel/reproducible_sum.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"

namespace quadloop::adapt {

namespace {

/// The integrand: a variable, or its absolute value.
struct Column {
  std::size_t variable = 0;
  bool of_size = false;
};

/// The cells' contributions to the integrals of some columns. The halves of a quadrilateral form one term, as
/// summation costs more than terms.
class CellTerms {
 public:
  /// Mesh, field and columns must outlive it.
  CellTerms(const Mesh& mesh, Point centre, const Field& field, std::span<const Column> columns)
      : mesh_{mesh}, centre_{centre}, field_{field}, columns_{columns}, terms_(columns.size()) {
    for (std::vector<double>& of_column : terms_) of_column.reserve(mesh.cell_count());
  }

  void add(const std::array<NodeId, 3>& triangle) { add(parts_of(mesh_.points, centre_, triangle)); }
  void add(const std::array<NodeId, 4>& quad) {
    const std::array<Point, 4> p = corners_of(mesh_, quad);
    if (is_rectangle(p))
      add_rectangle(quad, cross(p[1] - p[0], p[2] - p[0]) / 6, farthest_corner(centre_, p) % 2);
    else
      add(parts_of(mesh_.points, centre_, quad));
  }

  std::span<const std::vector<double>> terms() const { return terms_; }

 private:
  double value(NodeId node, const Column& column) const {
    const double of_node = field_.values[node.value() * field_.width() + column.variable];
    return column.of_size ? std::abs(of_node) : of_node;
  }

  void add(const TrianglesOfCell& parts) {
    std::array<double, 2> thirds{};
    for (std::size_t part = 0; part < parts.count; ++part) {
      const auto& [a, b, c] = parts.nodes[part];
      thirds[part] = cross(mesh_.point(b) - mesh_.point(a), mesh_.point(c) - mesh_.point(a)) / 6;
    }
    for (std::size_t k = 0; k < columns_.size() && parts.count > 0; ++k) {
      const auto term = [&](std::size_t part) {
        const auto& [a, b, c] = parts.nodes[part];
        return thirds[part] * (value(a, columns_[k]) + value(b, columns_[k]) + value(c, columns_[k]));
      };
      terms_[k].push_back(parts.count == 1 ? term(0) : term(0) + term(1));
    }
  }

  /// Fast path for rectangles: `third` is a third of the equal areas of both halves, `first` the first corner
  /// of the diagonal, 0 or 1.
  void add_rectangle(const std::array<NodeId, 4>& quad, double third, std::size_t first) {
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      const auto at = [&](std::size_t corner) { return value(quad[(first + corner) % 4], columns_[k]); };
      const double one = at(0), two = at(1), opposite = at(2), last = at(3);
      terms_[k].push_back(third * (one + two + opposite) + third * (opposite + last + one));
    }
  }

  const Mesh& mesh_;
  Point centre_;
  const Field& field_;
  std::span<const Column> columns_;
  std::vector<std::vector<double>> terms_;  ///< for each column
};

std::vector<double> integrals(const Communicator& comm, const Mesh& mesh, Point centre, const Field& field,
                              std::span<const Column> columns) {
  CellTerms cells(mesh, centre, field, columns);
  mesh.for_each_cell([&](const auto& triangle) { cells.add(triangle); });
  std::vector<double> sums;
  for (const std::vector<double>& of_column : cells.terms())
    sums.push_back(reproducible_sum(comm, of_column));
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
  for (std::size_t k = 0; k < field.width(); ++k) {  // densities and pressures equal their absolute values
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

double total_area(const Communicator& comm, const Mesh& mesh) {
  std::vector<double> areas;
  for (const CellShape& shape : cell_shapes(mesh)) areas.push_back(shape.area);
  return reproducible_sum(comm, areas);
}

}  // namespace quadloop::adapt
