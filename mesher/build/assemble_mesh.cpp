#include "mesher/build/assemble_mesh.hpp"

#include <algorithm>

#include "mesher/base/parallel/shared_stage.hpp"
#include "mesher/build/number_nodes.hpp"
#include "mesher/sizes/size_tree.hpp"

namespace quadloop {

namespace {

/// Appends cells and boundary edges leaf by leaf.
class Assembler {
 public:
  Assembler(const Geometry& geometry, const LeafGraph& graph, const CutForest& cut,
            const NodeNumbering& numbers, bool triangles_alone, MeshResult& result)
      : geometry_{geometry},
        graph_{graph},
        cut_{cut},
        numbers_{numbers},
        triangles_alone_{triangles_alone},
        mesh_{result.mesh},
        edge_leaves_{result.edge_leaves} {
    edge_leaves_.resize(geometry.boundaries().size());
    for (const Boundary& b : geometry.boundaries()) mesh_.boundaries.push_back({b.name, b.condition, {}});
    mesh_.blocks.names = geometry.block_names();
    for (std::int32_t s = 0; geometry.has_twins() && s < geometry.size(); ++s) {
      BoundaryEdges& boundary = mesh_.boundaries[geometry.boundary_of(s).value()];
      if (geometry.twin(s) >= 0)
        (geometry.is_inner_line(s) ? boundary.inner_line : boundary.between_blocks) = true;
    }
  }

  void add(LeafId leaf) {
    const std::size_t local = graph_.local_index(leaf);
    if (cut_.states[local] == CutForest::State::inside) add_inside(leaf);
    if (cut_.states[local] == CutForest::State::cut) add_cut(leaf, cut_.entry_of[local]);
  }

  /// The block, from 1, of the first cell after those given; 0 without such a cell.
  std::int16_t block_of_leaf(std::int32_t triangles, std::int32_t quads) const {
    const MeshBlocks& blocks = mesh_.blocks;
    const std::size_t t = triangles, q = quads;
    if (t == mesh_.triangles.size() && q == mesh_.quads.size()) return 0;
    if (!geometry_.has_blocks()) return 1;
    const std::int32_t block = t < blocks.of_triangles.size() ? blocks.of_triangles[t] : blocks.of_quads[q];
    return static_cast<std::int16_t>(block + 1);
  }

 private:
  void add_inside(LeafId leaf) {
    const SideSet hanging = graph_.around(leaf).finer;
    const NodeNumbering::SiteNodes nodes = numbers_.of_leaf(leaf);
    if (hanging.empty()) {
      add_quad(leaf, {nodes[0], nodes[1], nodes[2], nodes[3]});
    } else {
      for (const SiteTriangle& t : hanging_template(hanging))
        mesh_.triangles.push_back({nodes[index_of(t[0])], nodes[index_of(t[1])], nodes[index_of(t[2])]});
    }
    if (geometry_.has_blocks()) put_in_block(cut_.blocks[graph_.local_index(leaf)]);
  }

  /// Sets the block of the cells added last.
  void put_in_block(std::int32_t block) {
    mesh_.blocks.of_triangles.resize(mesh_.triangles.size(), block);
    mesh_.blocks.of_quads.resize(mesh_.quads.size(), block);
  }

  void add_cut(LeafId leaf, std::size_t entry) {
    const CutForest::Offsets &begin = cut_.entries[entry].begin, &end = cut_.entries[entry].end;
    found_.assign(end.nodes - begin.nodes, NodeId{});
    const auto node = [&](std::int32_t n) {
      NodeId& found = found_[n];
      if (!found.valid()) found = numbers_.of_cut(leaf, begin.nodes + n);
      return found;
    };
    for (std::int32_t i = begin.triangles; i < end.triangles; ++i) {
      const LocalTriangle& t = cut_.triangles[i];
      mesh_.triangles.push_back({node(t[0]), node(t[1]), node(t[2])});
      if (geometry_.has_blocks()) put_in_block(cut_.triangle_blocks[i]);
    }
    for (std::int32_t i = begin.quads; i < end.quads; ++i) {
      const LocalQuad& q = cut_.quads[i];
      add_quad(leaf, {node(q[0]), node(q[1]), node(q[2]), node(q[3])});
      if (geometry_.has_blocks()) put_in_block(cut_.quad_blocks[i]);
    }
    for (const auto& e : CutForest::part(cut_.outline, begin.outline, end.outline)) {
      const BoundaryId boundary = geometry_.boundary_of(e.segment);
      if (geometry_.is_second(e.segment) && !geometry_.boundary(boundary).baffle) continue;
      mesh_.boundaries[boundary.value()].edges.push_back({node(e.from), node(e.to)});
      edge_leaves_[boundary.value()].push_back(graph_.local_index(leaf));
    }
  }

  /// The corner of a square with the most trailing zeros in its coordinates is the one shared with the
  /// parent.
  void add_quad(LeafId leaf, const std::array<NodeId, 4>& nodes) {
    const auto& [a, b, c, d] = nodes;
    const Quadrant& q = graph_.leaf(leaf);
    const bool rising = ((q.x & q.size()) != 0) == ((q.y & q.size()) != 0);
    if (!triangles_alone_) {
      mesh_.quads.push_back(nodes);
    } else if (rising) {
      mesh_.triangles.push_back({a, b, c});
      mesh_.triangles.push_back({a, c, d});
    } else {
      mesh_.triangles.push_back({a, b, d});
      mesh_.triangles.push_back({b, c, d});
    }
  }

  const Geometry& geometry_;
  const LeafGraph& graph_;
  const CutForest& cut_;
  const NodeNumbering& numbers_;
  bool triangles_alone_;
  Mesh& mesh_;
  std::vector<std::vector<std::int32_t>>& edge_leaves_;
  std::vector<NodeId> found_;  ///< requested nodes of a cut leaf
};

LeafRecord record_of(const Quadrant& q, std::int8_t wanted) {
  constexpr std::int64_t within = (std::int64_t{1} << Quadrant::unit_level) - 1;
  LeafRecord record;
  record.tree_x = static_cast<std::int32_t>(q.x >> Quadrant::unit_level);
  record.tree_y = static_cast<std::int32_t>(q.y >> Quadrant::unit_level);
  record.x = static_cast<std::int32_t>(q.x & within);
  record.y = static_cast<std::int32_t>(q.y & within);
  record.level = static_cast<std::int8_t>(q.level);
  record.wanted = wanted;
  return record;
}

/// Reserved memory that is not filled costs nothing, but may need a new allocation where a smaller request
/// would fit into freed memory.
void reserve_cells(const CutForest& cut, std::size_t nodes, bool triangles_alone, Mesh& mesh) {
  if (triangles_alone) {
    mesh.triangles.reserve(2 * nodes);  // upper bound by Euler's formula
    return;
  }
  const auto inside = std::count(cut.states.begin(), cut.states.end(), CutForest::State::inside);
  mesh.quads.reserve(inside + cut.quads.size());
  mesh.triangles.reserve(inside / 2 + cut.triangles.size());
}

}  // namespace

void assemble_mesh(const Communicator& comm, const Geometry& geometry, const SizeTree& sizes,
                   const LeafGraph& graph, const CutForest& cut, bool triangles_alone, MeshResult& result) {
  NodeNumbering numbers(comm, sizes.grid(), graph, cut);
  Mesh& mesh = result.mesh;
  reserve_cells(cut, numbers.size(), triangles_alone, mesh);
  Assembler assembler(geometry, graph, cut, numbers, triangles_alone, result);
  DemandPath demands(sizes.demanded());
  auto& leaves = result.tree.leaves;
  leaves.reserve(cut.states.size());
  std::int32_t triangles = 0, quads = 0;  // so far
  progress::SharedStage stage(comm, "cells", graph.local_size(), "leaves");
  for (const LeafId leaf : graph.local()) {
    stage.advance(graph.local_index(leaf));
    assembler.add(leaf);
    LeafRecord record = record_of(graph.leaf(leaf), cut.target_levels[graph.local_index(leaf)]);
    record.block = assembler.block_of_leaf(triangles, quads);
    record.triangles = size32(mesh.triangles) - triangles;
    record.quads = size32(mesh.quads) - quads;
    triangles += record.triangles;
    quads += record.quads;
    record.adapted = demands.levels_above(graph.leaf(leaf));
    leaves.push_back(record);
  }
  std::move(numbers).fill(mesh);
}

}  // namespace quadloop
