#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "io/msh/msh_file.hpp"
#include "io/msh/msh_output.hpp"
#include "io/msh/msh_text.hpp"
#include "io/stream/stream_blocks.hpp"
#include "mesher/mesh/paired_nodes.hpp"

namespace quadloop::io {

namespace {

template <CellKind kind>
constexpr MshType msh_type_of = kind == CellKind::triangle      ? msh_triangle
                                : kind == CellKind::quad        ? msh_quad
                                : kind == CellKind::tetrahedron ? msh_tetrahedron
                                : kind == CellKind::pyramid     ? msh_pyramid
                                : kind == CellKind::prism       ? msh_prism
                                                                : msh_hexahedron;

/// The map from `from` to `to`, as a matrix of 4 x 4.
std::string affine_of(const PeriodicPair& pair) {
  const Point origin = pair.image({}), x = pair.image({1, 0}) - origin;
  return fmt::format("{} {} 0 {} {} {} 0 {} 0 0 1 0 0 0 0 1", x.x, -x.y, origin.x, x.y, x.x, origin.y);
}

/// The places of the named nodes of a plane mesh, on all ranks. *Collective.*
std::vector<Point> places_of_named(const Communicator& comm, const Mesh& mesh) {
  struct Place {
    std::int64_t index;
    Point point;
  };
  std::vector<Place> own;
  for (std::size_t i = 0; i < mesh.named_nodes.size(); ++i) {
    const NodeId node{static_cast<std::int32_t>(mesh.named_nodes[i].node.value() - mesh.first_node)};
    if (node.valid() && mesh.owns(node)) own.push_back({static_cast<std::int64_t>(i), mesh.point(node)});
  }
  std::vector<Point> places(mesh.named_nodes.size());
  for (const Place& place : comm.all_gather_values(std::span<const Place>(own)))
    places[place.index] = place.point;
  return places;
}

/// The boundaries, then the blocks, then the named nodes of a plane mesh. *Collective.*
std::vector<MshOutputGroup> groups_of(const MeshStream& stream) {
  const int dimension = stream.is_plane() ? 2 : 3;
  std::vector<MshOutputGroup> groups;
  for (const std::string& name : stream.patch_names()) groups.push_back({dimension - 1, name});
  const StreamBlocks blocks(stream);
  for (const std::string& name : blocks.names()) groups.push_back({dimension, name});
  if (!stream.is_plane()) return groups;
  const Mesh& mesh = stream.extruded()->plane;
  const std::vector<Point> places = places_of_named(stream.communicator(), mesh);
  for (std::size_t i = 0; i < places.size(); ++i)
    groups.push_back({0, mesh.named_nodes[i].name, {places[i].x, places[i].y, 0}});
  return groups;
}

class MshWriter {
 public:
  MshWriter(const MeshStream& stream, OutputSet& outputs, const std::string& path, MshVersion version)
      : stream_{stream}, blocks_{stream}, output_{outputs, path, version, groups_of(stream)} {}

  void write() {
    output_.write_nodes(stream_.point_rows(), [&](std::int64_t i) { return stream_.point(i); });
    std::int64_t elements = stream_.counts().cells();
    for (const StreamedPatch& patch : stream_.patches()) elements += patch.faces();
    elements += std::ssize(named_nodes());
    output_.begin_elements(runs(), elements);
    write_sides();
    for (std::size_t n = stream_.side_patches(); n < stream_.patches().size(); ++n) {
      write_faces<3>(n);
      write_faces<4>(n);
    }
    for (std::int32_t block = 0; block < blocks_.count(); ++block)
      for_each_kind([&]<CellKind kind>() { write_cells<kind>(block); });
    write_named_nodes();
    output_.end_elements();
    output_.write_periodic(links());
    output_.close();
  }

 private:
  std::span<const NamedNode> named_nodes() const {
    return stream_.is_plane() ? stream_.extruded()->plane.named_nodes : std::span<const NamedNode>();
  }

  /// Number of runs of elements of one type in one group.
  std::int64_t runs() const {
    std::int64_t count = std::ssize(named_nodes());
    for (const StreamedPatch& patch : stream_.patches())
      count += (patch.edges > 0 ? 1 : 0) + (patch.triangles > 0 ? 1 : 0) + (patch.quads > 0 ? 1 : 0);
    for (std::int32_t block = 0; block < blocks_.count(); ++block)
      for_each_kind([&]<CellKind kind>() {
        count += stream_.communicator().any(blocks_.rows<kind>(block).size() > 0) ? 1 : 0;
      });
    return count;
  }

  /// The pairs of a plane mesh, each `to` with its partner `from`. *Collective.*
  std::vector<MshOutput::Link> links() const {
    std::vector<MshOutput::Link> links;
    if (!stream_.is_plane()) return links;
    const Mesh& mesh = stream_.extruded()->plane;
    const std::vector<std::string> names = stream_.patch_names();
    const auto group = [&](const std::string& name) {
      return std::ranges::find(names, name) - names.begin() + 1;
    };
    for (const PeriodicPair& pair : mesh.pairs) {
      const PairedNodes nodes = paired_nodes(stream_.communicator(), mesh, pair);
      MshOutput::Link link{group(pair.to), group(pair.from), affine_of(pair), {}};
      for (std::size_t i = 0; i < nodes.from.nodes.size(); ++i)
        link.nodes.push_back({nodes.to.nodes[i].value(), nodes.from.nodes[i].value()});
      links.push_back(std::move(link));
    }
    return links;
  }

  void write_sides() {
    if (stream_.is_plane()) {
      output_.write_on_boundaries<2>(*stream_.boundaries(), msh_line, 1,
                                     [](const BoundaryStream::Edge& edge, std::int64_t) { return edge; });
    } else if (stream_.boundaries() != nullptr) {
      output_.write_on_boundaries<4>(
          *stream_.boundaries(), msh_quad, stream_.layers(),
          [&](const BoundaryStream::Edge& edge, std::int64_t layer) { return stream_.side(edge, layer); });
    }
  }

  /// Writes each as an element of one node.
  void write_named_nodes() {
    const std::int64_t first = std::ssize(stream_.patches()) + blocks_.count() + 1;
    for (std::int64_t i = 0; i < std::ssize(named_nodes()); ++i)
      output_.write_elements<1>(msh_point, first + i, stream_.communicator().is_root() ? 1 : 0,
                                [&](std::int64_t) { return std::array{named_nodes()[i].node.value()}; });
  }

  template <std::size_t width>
  void write_faces(std::size_t patch) {
    output_.write_elements<width>(width == 3 ? msh_triangle : msh_quad, static_cast<std::int64_t>(patch) + 1,
                                  stream_.face_rows<width>(patch),
                                  [&](std::int64_t i) { return stream_.face<width>(patch, i); });
  }

  template <CellKind kind>
  void write_cells(std::int32_t block) {
    const BlockRows rows = blocks_.rows<kind>(block);
    output_.write_elements<cell_width<kind>>(msh_type_of<kind>, std::ssize(stream_.patches()) + 1 + block,
                                             rows.size(),
                                             [&](std::int64_t i) { return stream_.cell<kind>(rows[i]); });
  }

  const MeshStream& stream_;
  const StreamBlocks blocks_;
  MshOutput output_;
};

}  // namespace

std::string msh_group_name(std::string boundary) {
  for (char& c : boundary) {
    if (c == '"') c = '\'';
    if (c == '\n' || c == '\r') c = ' ';
  }
  return boundary;
}

void write_msh(OutputSet& outputs, const MeshStream& mesh, const std::string& path, MshVersion version) {
  MshWriter(mesh, outputs, path, version).write();
}

}  // namespace quadloop::io
