#include "io/stream/stream_faces.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>

#include "io/stream/stream_blocks.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/exchange.hpp"
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
  if (stream_.is_plane() && (mesh.blocks != nullptr || streams_lines())) find_interfaces();
  require_conforming(path);
  const std::int64_t inner = comm.sum(std::ranges::count_if(cells_.across, [](std::int64_t cell) {
    return cell != EdgeCells::none;
  })) / 2;
  internal_ = inner * rows_on_cell() + cells * (rows_on_cell() - 1) - comm.sum(own_between_);
}

bool StreamFaces::is_streamed(const BoundaryEdges& boundary) const {
  return is_chosen(boundary, stream_.boundaries()->choice());
}

bool StreamFaces::streams_lines() const {
  return std::ranges::any_of(stream_.boundaries()->present(), &BoundaryEdges::inner_line);
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
      if (left == EdgeCells::none || right == EdgeCells::none || !is_streamed(mesh.boundaries[b])) continue;
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
    on_boundaries += is_streamed(boundary) ? std::ssize(boundary.edges) : 0;
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
  return {stream_.communicator(), plane, std::move(edges), stream_.boundaries()->choice()};
}

/// Returns the number of the first inner face of each of this rank's cells of one kind, of which the first
/// on all ranks is `first`, then the number after their last one. `before`: this rank's cells of earlier
/// kinds.
template <std::size_t corners>
std::vector<std::int64_t> StreamFaces::first_faces(const std::vector<std::array<NodeId, corners>>& cells,
                                                   std::int64_t before, std::int64_t first) const {
  std::vector<std::int64_t> sums{0};
  const std::int64_t rows = rows_on_cell();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::int64_t own = before + static_cast<std::int64_t>(i);
    const std::size_t sides = neighbours(cells[i], 3 * before + i * corners, own_number(own)).count;
    sums.push_back(sums.back() + rows * static_cast<std::int64_t>(sides + 1) - 1);
  }
  const std::int64_t on_earlier_ranks = stream_.communicator().exclusive_sum(sums.back());
  for (std::int64_t& sum : sums) sum += first + on_earlier_ranks;
  return sums;
}

/// Appends the faces of one edge of an inner line, whose first cell, of index `i`, is this rank's.
template <std::size_t corners>
void StreamFaces::append_line_faces(const LineEdge& edge, const std::array<NodeId, corners>& nodes,
                                    std::size_t first_edge, std::int64_t first_face,
                                    std::vector<LineFace>& faces) const {
  const HigherNeighbours found = neighbours(nodes, first_edge, edge.cell);
  const std::int64_t rows = rows_on_cell(), sides = static_cast<std::int64_t>(found.count);
  const auto at =
      std::ranges::find_if(found, [&](const auto& entry) { return entry.edge == side_of(edge, nodes); });
  for (std::int64_t layer = 0; layer < rows; ++layer) {
    const std::int64_t between = layer + 1 < rows ? 1 : 0;
    faces.push_back(
        {edge.line, first_face + layer * (sides + 1) + between + (at - found.begin()), edge.turned});
  }
}

std::vector<StreamFaces::LineFace> StreamFaces::inner_line_faces() const {
  const Communicator& comm = stream_.communicator();
  const Mesh& mesh = stream_.extruded()->plane;
  const std::int64_t own_triangles = std::ssize(mesh.triangles);
  const std::vector<std::int64_t> of_triangles = first_faces(mesh.triangles, 0, 0),
                                  of_quads =
                                      first_faces(mesh.quads, own_triangles,
                                                  comm.sum(of_triangles.back() - of_triangles.front()));
  const CellOwners owners(comm, mesh);
  std::vector<LineFace> faces;
  for (const LineEdge& edge : line_edges(owners)) {
    const std::int64_t cell = owners.local(edge.cell), quad = cell - own_triangles;
    if (quad < 0)
      append_line_faces(edge, mesh.triangles[cell], 3 * cell, of_triangles[cell], faces);
    else
      append_line_faces(edge, mesh.quads[quad], 3 * own_triangles + 4 * quad, of_quads[quad], faces);
  }
  std::vector<LineFace> all = gather_at_root(comm, faces);
  std::ranges::sort(all, {}, [](const LineFace& face) { return std::pair(face.line, face.face); });
  return all;
}

/// The edges of inner lines whose first cell, the one of lower number, is this rank's.
std::vector<StreamFaces::LineEdge> StreamFaces::line_edges(const CellOwners& owners) const {
  const Mesh& mesh = stream_.extruded()->plane;
  const std::vector<std::int64_t> right_of = cells_right_of_boundaries(stream_.communicator(), mesh);
  Outbox<LineEdge> to_owners;
  std::size_t at = 0;
  for (std::int64_t b = 0; b < std::ssize(mesh.boundaries); ++b) {
    for (const auto& [from, to] : mesh.boundaries[b].edges) {
      const std::int64_t left = cells_.of_boundary[at], right = right_of[at];
      ++at;
      if (mesh.boundaries[b].inner_line)
        to_owners.add(owners.rank_of(std::min(left, right)),
                      {key_of(from, to), b, std::min(left, right), right < left});
    }
  }
  return to_owners.deliver(stream_.communicator());
}

}  // namespace quadloop::io
