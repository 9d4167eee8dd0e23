#include "io/files/boundary_stream.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/base/parallel/exchange.hpp"

namespace quadloop::io {

namespace {

/// Edges of one boundary on one rank.
struct Share {
  std::int64_t boundary, rank, edges;
};

}  // namespace

BoundaryStream::BoundaryStream(const Communicator& comm, const Mesh& mesh, EdgeChoice choice)
    : mesh_{mesh}, choice_{choice} {
  std::vector<Share> own;
  own_before_.push_back(0);
  for (std::int64_t b = 0; b < std::ssize(mesh.boundaries); ++b) {
    const BoundaryEdges& boundary = mesh.boundaries[b];
    const std::int64_t count = is_chosen(boundary, choice) ? std::ssize(boundary.edges) : 0;
    own_before_.push_back(own_before_.back() + count);
    if (count > 0) own.push_back({b, comm.rank(), count});
  }
  std::vector<Share> all = comm.all_gather_values(std::span<const Share>(own));
  std::stable_sort(all.begin(), all.end(),
                   [](const Share& a, const Share& b) { return a.boundary < b.boundary; });
  std::int64_t boundary = -1;
  for (const Share& share : all) {
    if (share.boundary != boundary) {
      present_.push_back(&mesh.boundaries[share.boundary]);
      edges_.push_back(0);
      before_own_.push_back(all_edges_);
    }
    boundary = share.boundary;
    if (share.rank == comm.rank()) before_own_.back() = all_edges_;
    edges_.back() += share.edges;
    all_edges_ += share.edges;
  }
}

BoundaryStream::BoundaryStream(const Communicator& comm, const Mesh& mesh, std::vector<Edge> instead,
                               EdgeChoice choice)
    : BoundaryStream(comm, mesh, choice) {
  auto at = instead.begin();
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    const auto end = at + std::min(std::ssize(boundary.edges), instead.end() - at);
    if (is_chosen(boundary, choice)) instead_.insert(instead_.end(), at, end);
    at = end;
  }
  QUADLOOP_REQUIRE(at == instead.end() && std::ssize(instead_) == own_before_.back(),
                   "numbers for each boundary edge", instead.size(), own_before_.back());
}

std::vector<std::int64_t> BoundaryStream::own_rows(std::int64_t on_each) const {
  std::vector<std::int64_t> rows;
  for (const BoundaryEdges* boundary : present_) {
    const std::ptrdiff_t b = boundary - mesh_.boundaries.data();
    rows.push_back((own_before_[b + 1] - own_before_[b]) * on_each);
  }
  return rows;
}

BoundaryStream::Edge BoundaryStream::own_edge(std::size_t index, std::int64_t i) const {
  const BoundaryEdges& boundary = *present_[index];
  if (!instead_.empty()) return instead_[own_before_[&boundary - mesh_.boundaries.data()] + i];
  const auto& [from, to] = boundary.edges[i];
  return {mesh_.global(from).value(), mesh_.global(to).value()};
}

std::vector<std::vector<BoundaryStream::Edge>> BoundaryStream::gather(const Communicator& comm) const {
  struct Item {
    std::int64_t index;
    Edge edge;
  };
  std::vector<Item> own;
  const std::vector<std::int64_t> rows = own_rows();
  for (std::size_t n = 0; n < rows.size(); ++n) {
    for (std::int64_t i = 0; i < rows[n]; ++i) own.push_back({static_cast<std::int64_t>(n), own_edge(n, i)});
  }
  std::vector<std::vector<Edge>> all(present_.size());
  for (const auto& [index, edge] : gather_at_root(comm, own)) all[index].push_back(edge);
  return all;
}

}  // namespace quadloop::io
