#include "io/plot/cell_stream.hpp"

#include "io/plot/cell_paint.hpp"

namespace quadloop::io {

ShownCell CellStream::shown(std::size_t cell, const std::vector<double>& values) const {
  const std::span<const NodeId> nodes = cell_nodes(mesh_, cell);
  ShownCell shown;
  shown.width = size32(nodes);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    shown.corners[k] = mesh_.point(nodes[k]);
    if (!values.empty()) shown.values[k] = values[nodes[k].value()];
  }
  return shown;
}

}  // namespace quadloop::io
