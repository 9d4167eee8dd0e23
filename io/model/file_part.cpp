#include "io/model/file_part.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "io/model/line_text.hpp"
#include "io/model/node_text.hpp"
#include "io/model/pair_text.hpp"
#include "io/model/strip_text.hpp"
#include "mesher/base/parallel/even_shares.hpp"

namespace quadloop::io {

namespace {

std::vector<std::int32_t> blocks_of_share(const Communicator& comm, std::span<const std::int64_t> counts) {
  std::vector<std::int32_t> blocks;
  for_share_of_lists(comm, counts, [&](std::size_t block, std::int64_t, std::int64_t rows) {
    blocks.insert(blocks.end(), rows, static_cast<std::int32_t>(block));
  });
  return blocks;
}

/// Appends cells or edges, given by their nodes one after another.
template <std::size_t width>
void append_rows(std::span<const GlobalNodeId> nodes, PartBuilder& builder,
                 std::vector<std::array<NodeId, width>>& to) {
  for (std::size_t i = 0; i + width <= nodes.size(); i += width) {
    std::array<GlobalNodeId, width> row;
    std::copy_n(nodes.begin() + i, width, row.begin());
    to.push_back(builder.local(row));
  }
}

}  // namespace

void FilePart::set_blocks(std::vector<std::string> names, std::span<const std::int64_t> triangles,
                          std::span<const std::int64_t> quads) {
  loaded_.blocks = static_cast<std::int32_t>(names.size());
  loaded_.block_names = std::move(names);
  loaded_.triangle_to_block = blocks_of_share(comm_, triangles);
  loaded_.quad_to_block = blocks_of_share(comm_, quads);
  builder_.part().triangles.reserve(loaded_.triangle_to_block.size());
  builder_.part().quads.reserve(loaded_.quad_to_block.size());
}

void FilePart::add_triangles(std::span<const GlobalNodeId> nodes) {
  append_rows(nodes, builder_, builder_.part().triangles);
}

void FilePart::add_quads(std::span<const GlobalNodeId> nodes) {
  append_rows(nodes, builder_, builder_.part().quads);
}

void FilePart::add_boundary(const std::string& name, BoundaryCondition condition, const WallLayers& layers) {
  builder_.part().boundaries.push_back({name, condition, {}, layers});
}

/// Entries of inner lines are below 0.
std::int32_t FilePart::add_inner_line(const std::string& name) {
  loaded_.inner_curves.push_back({.name = name, .condition = {}, .edges = {}});
  return -static_cast<std::int32_t>(loaded_.inner_curves.size());
}

BoundaryEdges& FilePart::boundary_or_line(std::int32_t entry) {
  return entry < 0 ? loaded_.inner_curves[-entry - 1] : builder_.part().boundaries[entry];
}

void FilePart::set_edges(std::span<const GlobalNodeId> nodes, std::span<const std::int32_t> entries,
                         std::span<const std::int64_t> counts) {
  for_share_of_lists(comm_, counts, [&](std::size_t list, std::int64_t, std::int64_t count) {
    append_rows(nodes.first(2 * count), builder_, boundary_or_line(entries[list]).edges);
    nodes = nodes.subspan(2 * count);
  });
}

void FilePart::add_comments(std::string_view comments, std::int64_t nodes) {
  const auto most =
      static_cast<std::int32_t>(std::min<std::int64_t>(nodes, std::numeric_limits<std::int32_t>::max()));
  std::vector<BoundaryEdges> lines = lines_in_comments(comments, most);
  std::vector<GlobalNodeId> nodes_of_edges;
  std::vector<std::int64_t> counts;
  std::vector<std::int32_t> entries;
  for (const BoundaryEdges& line : lines) {
    counts.push_back(std::ssize(line.edges));
    entries.push_back(add_inner_line(line.name));
    for (const auto& edge : line.edges) {
      for (const NodeId node : edge) nodes_of_edges.emplace_back(node.value());
    }
  }
  const EvenShare share(comm_, std::ssize(nodes_of_edges) / 2);
  set_edges(std::span(nodes_of_edges).subspan(2 * share.begin, 2 * share.size()), entries, counts);
  Mesh& mesh = builder_.part();
  const StripsInText found = strips_in_comments(comments, most);
  mesh.strips = found.strips;
  mesh.pairs = pairs_in_comments(comments);
  mesh.named_nodes = nodes_in_comments(comments, most);
  for (const std::string& name : found.damaged)
    loaded_.warnings.push_back(
        path_ + ": the comment '# strip " + name +
        "' does not list the nodes of a strip; its cells are treated as ordinary cells");
}

LoadedMesh FilePart::finish(std::optional<Field> solution) {
  loaded_.mesh = builder_.finish(comm_);
  loaded_.solution = std::move(solution);
  return std::move(loaded_);
}

}  // namespace quadloop::io
