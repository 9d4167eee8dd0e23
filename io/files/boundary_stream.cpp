#include "io/files/boundary_stream.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

constexpr std::int64_t edges_per_piece = std::int64_t{1}
                                         << 12;  // 64 KB; rank 0 stores at most one piece of each rank

}  // namespace

BoundaryStream::BoundaryStream(const Communicator& comm, const Mesh& mesh, EdgeChoice choice)
    : comm_{comm}, mesh_{mesh}, choice_{choice} {
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
  if (comm.is_root()) shares_ = std::move(all);
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

void BoundaryStream::run(const Begin& begin, const Put& put) const {
  comm_.together([&] {
    if (comm_.is_root()) {
      take_all(begin, put);
    } else {
      send_all();
    }
  });
}

/// After a failure the other ranks' pieces are still received, as those ranks would otherwise wait forever.
void BoundaryStream::take_all(const Begin& begin, const Put& put) const {
  std::vector<Incoming> incoming = all_incoming();
  std::exception_ptr failure;
  try {
    std::int64_t boundary = -1, index = -1;
    for (const Share& share : shares_) {
      if (share.boundary != boundary) begin(++index);
      boundary = share.boundary;
      take_share(share, incoming[share.rank], put);
    }
  } catch (...) {
    failure = std::current_exception();
  }
  for (int rank = 0; rank < comm_.size(); ++rank) receive_rest(rank, incoming[rank]);
  if (failure) std::rethrow_exception(failure);
}

void BoundaryStream::take_share(const Share& share, Incoming& from, const Put& put) const {
  for (std::int64_t left = share.edges; left > 0;) {
    if (from.taken == from.piece.size()) ask_for_next(static_cast<int>(share.rank), from);
    const std::size_t count = std::min<std::size_t>(left, from.piece.size() - from.taken);
    put(std::span<const Edge>(from.piece).subspan(from.taken, count));
    from.taken += count;
    left -= count;
  }
}

std::vector<BoundaryStream::Incoming> BoundaryStream::all_incoming() const {
  std::vector<Incoming> incoming(comm_.size());
  for (const Share& share : shares_) incoming[share.rank].all += share.edges;
  return incoming;
}

void BoundaryStream::ask_for_next(int rank, Incoming& from) const {
  const std::int64_t first = from.asked_for;
  from.asked_for = std::min(from.all, first + edges_per_piece);
  from.piece = rank == 0 ? own_piece(first) : detail::from_bytes<Edge>(comm_.receive_bytes(rank));
  from.taken = 0;
  QUADLOOP_REQUIRE(std::ssize(from.piece) == from.asked_for - first,
                   "a piece of boundary edges is not what was announced");
}

void BoundaryStream::receive_rest(int rank, Incoming& from) const {
  if (rank == 0) return;
  for (; from.asked_for < from.all; from.asked_for += edges_per_piece) comm_.receive_bytes(rank);
}

/// A rank that fails still sends as many pieces as it announced, empty ones.
void BoundaryStream::send_all() const {
  std::exception_ptr failure;
  for (std::int64_t first = 0; first < own_before_.back(); first += edges_per_piece) {
    std::vector<Edge> piece;
    try {
      if (!failure) piece = own_piece(first);
    } catch (...) {
      failure = std::current_exception();
    }
    comm_.send_bytes(std::as_bytes(std::span<const Edge>(piece)), 0);
  }
  if (failure) std::rethrow_exception(failure);
}

std::vector<BoundaryStream::Edge> BoundaryStream::own_piece(std::int64_t first) const {
  const std::int64_t end = std::min(own_before_.back(), first + edges_per_piece);
  if (!instead_.empty()) return {instead_.begin() + first, instead_.begin() + end};
  std::vector<Edge> piece;
  piece.reserve(end - first);
  std::size_t b = std::upper_bound(own_before_.begin(), own_before_.end(), first) - own_before_.begin() - 1;
  for (std::int64_t at = first; at < end; ++b) {
    const std::int64_t stop = std::min(end, own_before_[b + 1]);
    for (; at < stop; ++at) {
      const auto& [from, to] = mesh_.boundaries[b].edges[at - own_before_[b]];
      piece.push_back({mesh_.global(from).value(), mesh_.global(to).value()});
    }
  }
  return piece;
}

}  // namespace quadloop::io
