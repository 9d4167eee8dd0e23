#include "mesher/partition/join_parts.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

/// Checks a global number from a file.
std::size_t checked(std::int64_t place, std::size_t places, const char* of, const std::string& shown) {
  if (place < 0 || place >= static_cast<std::int64_t>(places))
    throw InputError(shown + ": " + of + " " + std::to_string(place + 1) + " is none of the whole mesh's " +
                     std::to_string(places));
  return static_cast<std::size_t>(place);
}

}  // namespace

PartJoiner::PartJoiner(const WholeCounts& counts, std::vector<BoundaryEdges> boundaries,
                       std::vector<std::string> blocks)
    : placed_(counts.nodes, 0), owned_(counts.nodes, 0) {
  Mesh& mesh = whole_.mesh;
  mesh.points.resize(counts.nodes);
  mesh.owned_nodes = counts.nodes;
  mesh.triangles.resize(counts.triangles);
  mesh.quads.resize(counts.quads);
  mesh.boundaries = std::move(boundaries);
  rows_ = std::int64_t{counts.triangles} + counts.quads;
  for (std::size_t b = 0; b < counts.edges.size(); ++b) {
    mesh.boundaries[b].edges.resize(counts.edges[b]);
    rows_ += counts.edges[b];
  }
  if (blocks.empty()) return;
  mesh.blocks = {std::move(blocks), std::vector<std::int32_t>(counts.triangles, 0),
                 std::vector<std::int32_t>(counts.quads, 0)};
}

template <std::size_t width>
void PartJoiner::put_rows(const MeshPart& part, const std::vector<std::array<NodeId, width>>& rows,
                          const std::vector<std::int64_t>& places,
                          std::vector<std::array<NodeId, width>>& whole, const std::string& shown) {
  const char* const of = width == 2 ? "boundary edge" : width == 3 ? "triangle" : "quadrilateral";
  if (rows.size() != places.size())
    throw InputError(shown + ": it has " + std::to_string(rows.size()) + " rows of the kind '" + of +
                     "', but " + std::to_string(places.size()) + " numbers for them");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    auto& row = whole[checked(places[i], whole.size(), of, shown)];
    if (row[0].valid())
      throw InputError(shown + ": " + of + " " + std::to_string(places[i] + 1) +
                       " of the whole mesh stands in two parts");
    for (std::size_t k = 0; k < width; ++k)
      row[k] = NodeId{static_cast<std::int32_t>(part.nodes[rows[i][k].value()])};
  }
  rows_put_ += std::ssize(rows);
}

void PartJoiner::put_nodes(const MeshPart& part, const std::string& shown) {
  const Mesh& mesh = part.mesh;
  if (mesh.points.size() != part.nodes.size() || part.owners.size() != part.nodes.size())
    throw InputError(shown + ": it has " + std::to_string(mesh.points.size()) + " nodes, but " +
                     std::to_string(part.nodes.size()) + " numbers for them");
  for (std::size_t i = 0; i < part.nodes.size(); ++i) {
    const std::size_t node = checked(part.nodes[i], placed_.size(), "node", shown);
    Point& point = whole_.mesh.points[node];
    if (placed_[node] != 0 && point != mesh.points[i])
      throw InputError(shown + ": node " + std::to_string(i + 1) + ", the whole mesh's " +
                       std::to_string(node + 1) + ", lies elsewhere in another part");
    point = mesh.points[i];
    placed_[node] = 1;
    if (part.owners[i] == part.number) owned_[node] = 1;
  }
}

void PartJoiner::put_values(const MeshPart& part, const std::string& shown) {
  std::optional<Field>& field = whole_.field;
  if (parts_ == 0 && part.field) {
    field = Field{part.field->names, {}, part.field->constants, {part.field->cells.names, {}}};
    field->values.resize(whole_.mesh.points.size() * field->width());
    field->cells.values.resize((whole_.mesh.cell_count()) * field->cells.width());
  }
  const bool alike =
      field.has_value() == part.field.has_value() &&
      (!field || (field->names == part.field->names && field->constants == part.field->constants &&
                  field->cells.names == part.field->cells.names));
  if (!alike) throw InputError(shown + ": its variables or constants are not those of the first part");
  if (!field) return;
  for (std::int32_t i = 0; i < size32(part.nodes); ++i) {
    if (part.owners[i] != part.number) continue;
    std::ranges::copy(part.field->row(NodeId{i}),
                      field->row(NodeId{static_cast<std::int32_t>(part.nodes[i])}).begin());
  }
  put_cell_values(part, field->cells);
}

void PartJoiner::put_cell_values(const MeshPart& part, CellValues& whole) const {
  const std::size_t width = whole.width();
  auto row = part.field->cells.values.begin();
  const auto put = [&](std::size_t cell) {
    std::copy_n(row, width, whole.values.begin() + static_cast<std::ptrdiff_t>(cell * width));
    row += static_cast<std::ptrdiff_t>(width);
  };
  for (const std::int64_t triangle : part.triangles) put(triangle);
  for (const std::int64_t quad : part.quads) put(whole_.mesh.triangles.size() + quad);
}

void PartJoiner::put_blocks(const MeshPart& part) {
  MeshBlocks& blocks = whole_.mesh.blocks;
  if (blocks.names.empty()) return;
  const MeshBlocks& own = part.mesh.blocks;
  for (std::size_t i = 0; i < own.of_triangles.size(); ++i)
    blocks.of_triangles[part.triangles[i]] = own.of_triangles[i];
  for (std::size_t i = 0; i < own.of_quads.size(); ++i) blocks.of_quads[part.quads[i]] = own.of_quads[i];
}

void PartJoiner::put(const MeshPart& part, const std::string& shown) {
  Mesh& mesh = whole_.mesh;
  put_nodes(part, shown);
  put_rows(part, part.mesh.triangles, part.triangles, mesh.triangles, shown);
  put_rows(part, part.mesh.quads, part.quads, mesh.quads, shown);
  for (std::size_t b = 0; b < mesh.boundaries.size(); ++b)
    put_rows(part, part.mesh.boundaries[b].edges, part.edges[b], mesh.boundaries[b].edges, shown);
  put_blocks(part);
  put_values(part, shown);
  ++parts_;
}

JoinedMesh PartJoiner::finish(const std::string& shown) {
  const auto missing = std::ranges::find(owned_, 0);
  if (missing != owned_.end())
    throw InputError(shown + ": no part owns node " + std::to_string(missing - owned_.begin() + 1) +
                     " of the whole mesh");
  if (rows_put_ != rows_)
    throw InputError(shown + ": the parts have " + std::to_string(rows_put_) + " of the whole mesh's " +
                     std::to_string(rows_) + " cells and boundary edges");
  return std::move(whole_);
}

}  // namespace quadloop
