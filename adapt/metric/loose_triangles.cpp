#include "adapt/metric/loose_triangles.hpp"

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "mesher/base/mixed_bits.hpp"
#include "mesher/base/parallel/exchange.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"

namespace quadloop::adapt {

Point LooseTriangle::centroid() const {
  std::array<Point, 3> p{nodes[0].point, nodes[1].point, nodes[2].point};
  std::ranges::sort(p);
  return {(p[0].x + p[1].x + p[2].x) / 3, (p[0].y + p[1].y + p[2].y) / 3};
}

namespace {

/// A boundary edge, sent to the rank of its triangle.
struct TravellingSide {
  std::int64_t triangle, from;
  std::int32_t boundary;
};

std::vector<TravellingSide> sides_of_own(const Communicator& comm, const Mesh& mesh) {
  const EdgeCells cells = edge_cells(comm, mesh);
  const RankRanges triangles(comm, cells.first_triangle);
  Outbox<TravellingSide> sides;
  auto cell = cells.of_boundary.begin();
  for (std::int32_t b = 0; b < std::ssize(mesh.boundaries); ++b) {
    for (const auto& edge : mesh.boundaries[b].edges) {
      const int rank = triangles.rank_of(*cell);
      sides.add(rank, {*cell - triangles.begin(rank), mesh.global(edge[0]).value(), b});
      ++cell;
    }
  }
  return sides.deliver(comm);
}

}  // namespace

std::vector<LooseTriangle> loosened(const Communicator& comm, const Mesh& mesh,
                                    const std::vector<LogMetric>& metrics) {
  QUADLOOP_REQUIRE(mesh.quads.empty() && metrics.size() == mesh.points.size(),
                   "triangles, and metrics for all");
  std::vector<LooseTriangle> loose(mesh.triangles.size());
  for (std::size_t t = 0; t < loose.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeId node = mesh.triangles[t][k];
      loose[t].nodes[k] = {mesh.global(node).value(), mesh.point(node), metrics[node.value()]};
    }
  }
  for (const TravellingSide& side : sides_of_own(comm, mesh)) {
    LooseTriangle& t = loose[side.triangle];
    for (std::size_t k = 0; k < 3; ++k) {
      if (t.nodes[k].id == side.from) t.boundaries[k] = side.boundary;
    }
  }
  return loose;
}

namespace {

constexpr std::int64_t nobody = std::numeric_limits<std::int64_t>::max();

/// The nodes of a rank's triangles in order of occurrence, and their global numbers.
class Numbering {
 public:
  Numbering(const Communicator& comm, const std::vector<LooseTriangle>& triangles) {
    for (const LooseTriangle& t : triangles) {
      for (const TileNode& node : t.nodes) {
        if (slot_.emplace(node.id, size32(nodes_)).second) nodes_.push_back(node);
      }
    }
    find_owners(comm);
    number(comm);
  }

  /// Stores owned nodes first, as required by the mesh.
  void put_into(Mesh& mesh) {
    mesh.first_node = first_;
    for (const bool owned : {true, false}) {
      for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if ((owners_[i] == rank_) != owned) continue;
        local_[i] = NodeId{size32(mesh.points)};
        mesh.points.push_back(nodes_[i].point);
        if (!owned) mesh.ghosts.push_back(GlobalNodeId{numbers_[i]});
      }
      if (owned) mesh.owned_nodes = size32(mesh.points);
    }
  }
  NodeId local(std::int64_t id) const { return local_[slot_.at(id)]; }

 private:
  /// A node is owned by the lowest rank that has it; ranks exchange this on a rank determined by the node's
  /// id.
  void find_owners(const Communicator& comm) {
    rank_ = comm.rank();
    std::vector<int> meeting;
    std::vector<std::int64_t> ids;
    for (const TileNode& node : nodes_) {
      meeting.push_back(static_cast<int>(mixed_bits(static_cast<std::uint64_t>(node.id) + golden_step) %
                                         static_cast<std::uint64_t>(comm.size())));
      ids.push_back(node.id);
    }
    exchange_.emplace(comm, meeting);
    met_ = exchange_->deliver(ids);
    std::unordered_map<std::int64_t, int> lowest;
    for (const Exchange::Source& from : exchange_->sources()) {  // in ascending rank order
      for (std::size_t i = from.begin; i < from.end; ++i) lowest.emplace(met_[i], from.rank);
    }
    std::vector<int> answers;
    for (const std::int64_t id : met_) answers.push_back(lowest.at(id));
    owners_ = exchange_->answer(answers);
  }

  void number(const Communicator& comm) {
    const auto owned = std::ranges::count(owners_, rank_);
    first_ = comm.exclusive_sum(owned);
    std::int64_t next = first_;
    for (const int owner : owners_) numbers_.push_back(owner == rank_ ? next++ : nobody);
    std::vector<std::int64_t> answers = exchange_->deliver(numbers_);
    std::unordered_map<std::int64_t, std::int64_t> number_of;
    for (std::size_t i = 0; i < met_.size(); ++i) {
      auto& number = number_of.emplace(met_[i], nobody).first->second;
      number = std::min(number, answers[i]);
    }
    for (std::size_t i = 0; i < met_.size(); ++i) answers[i] = number_of.at(met_[i]);
    numbers_ = exchange_->answer(answers);
    local_.resize(nodes_.size());
  }

  int rank_ = 0;
  std::unordered_map<std::int64_t, std::int32_t> slot_;
  std::vector<TileNode> nodes_;
  std::optional<Exchange> exchange_;
  std::vector<std::int64_t> met_;
  std::vector<int> owners_;
  std::int64_t first_ = 0;
  std::vector<std::int64_t> numbers_;
  std::vector<NodeId> local_;
};

}  // namespace

Mesh joined(const Communicator& comm, const std::vector<LooseTriangle>& triangles,
            const std::vector<BoundaryEdges>& boundaries) {
  Mesh mesh;
  for (const BoundaryEdges& b : boundaries) mesh.boundaries.push_back({b.name, b.condition, {}, b.layers});
  Numbering numbering(comm, triangles);
  numbering.put_into(mesh);
  for (const LooseTriangle& t : triangles) {
    auto& nodes = mesh.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) nodes[k] = numbering.local(t.nodes[k].id);
    for (std::size_t k = 0; k < 3; ++k) {
      if (t.boundaries[k] >= 0)
        mesh.boundaries[t.boundaries[k]].edges.push_back({nodes[k], nodes[(k + 1) % 3]});
    }
  }
  return mesh;
}

}  // namespace quadloop::adapt
