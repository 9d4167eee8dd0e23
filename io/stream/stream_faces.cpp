#include "io/stream/stream_faces.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>

#include "io/stream/stream_blocks.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/cells/cell_owners.hpp"

namespace quadloop::io {

StreamFaces::StreamFaces(const MeshStream& stream, CellNumbers numbers, const std::string& path)
    : stream_{stream} {
  if (stream.held() != nullptr) {
    held_.emplace(*stream.held(), path);
    internal_ = std::ssize(held_->internal());
  } else {
    find_plane_faces(path);
  }
  if (numbers == CellNumbers::by_block && StreamBlocks(stream).several()) number_by_block();
}

std::int64_t StreamFaces::all() const {
  std::int64_t sum = internal_;
  for (const StreamedPatch& patch : stream_.patches()) sum += patch.faces();
  return sum;
}

bool StreamFaces::is_interface(std::size_t patch) const {
  if (interfaces_.empty()) return false;
  return interfaces_.contains(stream_.boundaries()->present()[patch] -
                              stream_.extruded()->plane.boundaries.data());
}

void StreamFaces::find_plane_faces(const std::string& path) {
  const Communicator& comm = stream_.communicator();
  const ExtrudedMesh& mesh = *stream_.extruded();
  const std::int64_t cells = comm.sum(std::ssize(mesh.plane.triangles) + std::ssize(mesh.plane.quads));
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  if (comm.sum(mesh.plane.owned_nodes) >= most || cells >= most)
    throw OutputError(path +
                      ": the mesh has more nodes or cells than this format can count (32-bit numbers)");
  cells_ = edge_cells(comm, mesh.plane);
  if (stream_.is_plane() && mesh.blocks != nullptr) find_interfaces();
  require_conforming(path);
  const std::int64_t inner = comm.sum(std::ranges::count_if(cells_.across, [](std::int64_t cell) {
    return cell != EdgeCells::none;
  })) / 2;
  internal_ = inner * rows_on_cell() + cells * (rows_on_cell() - 1) - comm.sum(own_between_);
}

/// The ranks of both cells learn of an edge between two.
void StreamFaces::find_interfaces() {
  const Communicator& comm = stream_.communicator();
  const Mesh& mesh = stream_.extruded()->plane;
  right_of_boundary_ = cells_right_of_boundaries(comm, mesh);
  const CellOwners owners(comm, mesh);
  Outbox<EdgeKey> to_cells;
  std::vector<std::int64_t> interfaces;
  std::size_t at = 0;
  for (std::int64_t b = 0; b < std::ssize(mesh.boundaries); ++b) {
    const std::int64_t before = own_between_;
    for (const auto& [from, to] : mesh.boundaries[b].edges) {
      const std::int64_t left = cells_.of_boundary[at], right = right_of_boundary_[at];
      ++at;
      if (left == EdgeCells::none || right == EdgeCells::none) continue;
      ++own_between_;
      for (const std::int64_t cell : {left, right}) to_cells.add(owners.rank_of(cell), key_of(from, to));
    }
    if (own_between_ > before) interfaces.push_back(b);
  }
  for (const EdgeKey& edge : to_cells.deliver(comm)) between_.insert(edge);
  for (const std::int64_t b : comm.all_gather_values(std::span<const std::int64_t>(interfaces)))
    interfaces_.insert(b);
}

void StreamFaces::require_conforming(const std::string& path) const {
  const Communicator& comm = stream_.communicator();
  std::int64_t on_boundaries = -own_between_;
  for (const BoundaryEdges& boundary : stream_.extruded()->plane.boundaries)
    on_boundaries += std::ssize(boundary.edges);
  const std::int64_t outer = std::ranges::count(cells_.across, EdgeCells::none);
  const std::int64_t without_cell = std::ranges::count(cells_.of_boundary, EdgeCells::none);
  if (comm.sum(outer) == comm.sum(on_boundaries) && comm.sum(without_cell) == 0) return;
  throw OutputError(
      path +
      ": this format needs each edge between two cells, or of one cell and on one boundary; this "
      "mesh has others (`quadloop check` says where)");
}

/// Numbers cells block by block, in each kind after kind.
void StreamFaces::number_by_block() {
  if (!held_) {
    numbers_ = numbers_by_block(stream_.communicator(), *stream_.extruded()->blocks);
    renumber_across();
    return;
  }
  const std::vector<std::int32_t> block_of = blocks_of_cells(*stream_.held());
  std::vector<std::int64_t> next(stream_.held()->block_names.size() + 1);
  for (const std::int32_t block : block_of) ++next[block + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (const std::int32_t block : block_of) numbers_.push_back(next[block]++);
}

/// Also renumbers the cells adjacent to boundaries.
void StreamFaces::renumber_across() {
  const Communicator& comm = stream_.communicator();
  const auto has_cell = [](std::int64_t cell) { return cell != EdgeCells::none; };
  std::vector<std::int64_t> wanted;
  for (const auto* cells : {&cells_.across, &cells_.of_boundary, &right_of_boundary_})
    std::ranges::copy_if(*cells, std::back_inserter(wanted), has_cell);
  const std::vector<std::int64_t> found = rows_of_cells(comm, CellOwners(comm, stream_.extruded()->plane),
                                                        std::span<const std::int64_t>(wanted), numbers_);
  auto next = found.begin();
  across_numbers_ = cells_.across;
  for (auto* cells : {&across_numbers_, &cells_.of_boundary, &right_of_boundary_}) {
    for (std::int64_t& cell : *cells) {
      if (has_cell(cell)) cell = *next++;
    }
  }
}

/// The boundary edges of the plane; instead of two node numbers each has both nodes packed in one number, and
/// the cells on its left and right (the latter from 1) in the other.
BoundaryStream StreamFaces::sides() const {
  const Mesh& plane = stream_.extruded()->plane;
  std::vector<BoundaryStream::Edge> edges;
  std::size_t at = 0;
  for (const BoundaryEdges& boundary : plane.boundaries) {
    for (const auto& [from, to] : boundary.edges) {
      const std::int64_t right = right_of_boundary_.empty() ? no_cell : right_of_boundary_[at];
      edges.push_back({packed(plane.global(from).value(), plane.global(to).value()),
                       packed(cells_.of_boundary[at++], right + 1)});
    }
  }
  return {stream_.communicator(), plane, std::move(edges)};
}

}  // namespace quadloop::io
