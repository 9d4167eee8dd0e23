#include "flow/euler/implicit/line_system.hpp"

#include <Eigen/LU>
#include <unordered_map>

namespace quadloop::flow::euler {

namespace {

using RowMajorMatrix = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
using RowMajorMap = Eigen::Map<const RowMajorMatrix>;
using DoubleVectorMap = Eigen::Map<Eigen::Vector4d>;

}  // namespace

LineSystem::LineSystem(const Communicator& comm, const DualMesh& mesh, const Colouring& colours)
    : mesh_{mesh}, links_(mesh.nodes()), node_colours_(mesh.nodes(), -1) {
  const std::vector<NodeLine> found = find_lines(comm, mesh, colours);
  if (!comm.any(!found.empty())) return;
  std::unordered_map<GlobalNodeId, NodeId> here;  // nodes of this rank's edges
  for (const NodeId node : mesh.ids()) {
    if (!mesh.is_image(node)) here.emplace(mesh.global(node), node);
  }
  std::vector<GlobalNodeId> others;
  for (const NodeLine& line : found) {
    std::vector<NodeId> locals;
    std::vector<std::int32_t> rows;
    for (const GlobalNodeId node : line.nodes) {
      const auto at = here.find(node);
      locals.push_back(at == here.end() ? NodeId{} : at->second);
      const bool owned = locals.back().valid() && mesh.is_owned(locals.back());
      rows.push_back(owned ? locals.back().value()
                           : mesh.owned_nodes() + static_cast<std::int32_t>(others.size()));
      if (!owned) others.push_back(node);
    }
    for (std::size_t k = 0; k < locals.size(); ++k) {
      if (!locals[k].valid() || !mesh.is_owned(locals[k])) continue;
      links_[locals[k]] = {k > 0 ? locals[k - 1] : NodeId{},
                           k + 1 < locals.size() ? locals[k + 1] : NodeId{}};
      node_colours_[locals[k]] = line.colour;
    }
    lines_.push_back({std::move(rows), line.colour});
  }
  exchange_.emplace(comm, NodeOwners(comm, mesh.first_node()), mesh.owned_nodes(), others);
  blocks_.resize(mesh.owned_nodes() + others.size());
}

void LineSystem::set_block(NodeId node, NodeId neighbour, const Matrix4& block) {
  (links_[node].before == neighbour ? blocks_[node.value()].before : blocks_[node.value()].after) = block;
}

void LineSystem::factor(const IdVector<NodeId, Matrix4>& diagonal) {
  for (const NodeId node : mesh_.owned_ids()) blocks_[node.value()].inverse = diagonal[node];
  exchange_->update(blocks_);
  for (const Line& line : lines_) {
    const Blocks* before = nullptr;
    for (const std::int32_t row : line.rows) {
      Eigen::Map<RowMajorMatrix> block(blocks_[row].inverse.data());
      if (before != nullptr) {
        block -= RowMajorMap(blocks_[row].before.data()) *
                 (RowMajorMap(before->inverse.data()) * RowMajorMap(before->after.data())).eval();
      }
      block = block.inverse().eval();
      before = &blocks_[row];
    }
  }
}

void LineSystem::solve(int colour, std::vector<Row>& rows) const {
  exchange_->update(rows, [&](std::int32_t node) { return node_colours_[NodeId{node}] == colour; });
  for (const Line& line : lines_) {
    if (line.colour != colour) continue;
    for (std::size_t k = 0; k < line.rows.size(); ++k) {
      const Blocks& blocks = blocks_[line.rows[k]];
      DoubleVectorMap right(rows[line.rows[k]].data());
      if (k > 0) right -= RowMajorMap(blocks.before.data()) * DoubleVectorMap(rows[line.rows[k - 1]].data());
      right = (RowMajorMap(blocks.inverse.data()) * right).eval();
    }
    for (std::size_t k = line.rows.size() - 1; k-- > 0;) {
      const Blocks& blocks = blocks_[line.rows[k]];
      DoubleVectorMap(rows[line.rows[k]].data()) -=
          RowMajorMap(blocks.inverse.data()) *
          (RowMajorMap(blocks.after.data()) * DoubleVectorMap(rows[line.rows[k + 1]].data())).eval();
    }
  }
}

}  // namespace quadloop::flow::euler
