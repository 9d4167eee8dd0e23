#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Cell averages: a row of width() values for each of this rank's cells, triangles first, then quads. The
/// names are the same on all ranks.
struct CellValues {
  std::vector<std::string> names;
  std::vector<double> values;

  std::size_t width() const { return names.size(); }
  std::vector<double> column(std::size_t variable) const;
};

/// Nodal values, and optionally cell averages, of named variables. `values` has a row of width() values for
/// each owned node, in the mesh's order; rows of ghosts may follow (with_ghosts()). Names and constants are
/// the same on all ranks.
struct Field {
  std::vector<std::string> names;  ///< found by variable(), variable_names.hpp
  std::vector<double> values;
  std::vector<double> constants;  ///< iteration, time, Mach number and other data of the solver
  CellValues cells = {};

  /// Whether there is no variable, neither at nodes nor in cells.
  bool empty() const { return names.empty() && cells.names.empty(); }
  std::size_t width() const { return names.size(); }
  std::span<const double> row(NodeId node) const {
    return std::span(values).subspan(node.value() * width(), width());
  }
  std::span<double> row(NodeId node) { return std::span(values).subspan(node.value() * width(), width()); }
  /// Returns the values of one variable, one for each row.
  std::vector<double> column(std::size_t variable) const;
};

/// Returns the named variables, in this order: the nodal variables if the field has them, else the cell
/// variables. They keep the names that they have in the field. Throws InputError as variable() does.
Field selected(const Field& field, std::span<const std::string> wanted, const std::string& where);

/// Appends nodal variables: `values` has a row of names.size() values for each node.
void append_columns(Field& field, std::span<const std::string> names, std::span<const double> values);

/// Returns the rows of owned nodes followed by those of the mesh's ghosts, fetched from their owners;
/// existing ghost rows are ignored. *Collective.*
Field with_ghosts(const Communicator& comm, const Mesh& mesh, Field field);

}  // namespace quadloop
