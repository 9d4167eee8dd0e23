#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// What a solver keeps in the cells of a mesh, a mean over each: for each of this rank's cells, its
/// triangles, then its quads, a row of width() values. Names are the same on all ranks.
struct CellValues {
  std::vector<std::string> names;
  std::vector<double> values;

  std::size_t width() const { return names.size(); }
  std::vector<double> column(std::size_t variable) const;
};

/// What a solver keeps at the nodes and in the cells of a mesh, by the names of its variables: for each owned
/// node, in the mesh's order, a row of width() values. After them may stand rows of the copies
/// (with_copies()). Names and constants are the same on all ranks.
struct Field {
  std::vector<std::string> names;  ///< found by variable(), variable_names.hpp
  std::vector<double> values;
  std::vector<double> constants;  ///< iteration, time, Mach number: whatever else the solver keeps
  CellValues cells = {};

  /// No variable, neither at nodes nor in cells.
  bool empty() const { return names.empty() && cells.names.empty(); }
  std::size_t width() const { return names.size(); }
  std::span<const double> row(NodeId node) const {
    return std::span(values).subspan(node.value() * width(), width());
  }
  std::span<double> row(NodeId node) { return std::span(values).subspan(node.value() * width(), width()); }
  /// The values of one variable, at as many nodes as there are rows.
  std::vector<double> column(std::size_t variable) const;
};

/// The variables of these names, in this order, under the names that the field has for them: those at nodes
/// where one has the name, else those in cells. Throws InputError as variable() does.
Field selected(const Field& field, std::span<const std::string> wanted, const std::string& where);

/// More variables at the nodes, behind those that the field has: `values` has a row of them for each node. A
/// field without variables gets these rows alone.
void append_columns(Field& field, std::span<const std::string> names, std::span<const double> values);

/// With the rows of owned nodes and after them those of the mesh's copies, fetched from their owners; what
/// stood after the owned nodes' rows is not read. *Collective.*
Field with_copies(const Communicator& comm, const Mesh& mesh, Field field);

}  // namespace quadloop
