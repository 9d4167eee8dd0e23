#pragma once

#include <span>
#include <vector>

#include "mesher/base/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Rows of `width` values at a mesh's nodes.
struct NodeRows {
  int width = 0;
  std::vector<double> values;

  std::span<const double> of(NodeId node) const {
    const auto columns = static_cast<std::size_t>(width);
    return std::span(values).subspan(static_cast<std::size_t>(node.value()) * columns, columns);
  }
};

/// The rows of the owned nodes, and after them those of the copies, fetched from their owners. *Collective.*
NodeRows rows_with_copies(const Communicator& comm, const Mesh& mesh, std::span<const double> owned,
                          int width);

}  // namespace quadloop
