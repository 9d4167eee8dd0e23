#include <algorithm>
#include <array>
#include <bit>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/cgns/cgns_elements.hpp"
#include "io/cgns/cgns_file.hpp"
#include "io/cgns/cgns_layout.hpp"
#include "io/cgns/cgns_names.hpp"
#include "io/cgns/cgns_patches.hpp"
#include "io/files/row_output.hpp"
#include "io/model/pair_text.hpp"
#include "io/stream/block_meshes.hpp"
#include "io/stream/mesh_stream.hpp"
#include "io/stream/stream_blocks.hpp"
#include "io/stream/stream_cell_values.hpp"
#include "mesher/base/parallel/exchange.hpp"

namespace quadloop::io {

namespace {

/// Names of patches in the file, the same in all zones.
class CgnsPatchNames {
 public:
  /// Names are assigned to all boundaries of a plane mesh, including those without edges, and to the patches
  /// of a 3D mesh, then to the triangles of those that are not sides.
  explicit CgnsPatchNames(const MeshStream& stream) {
    std::vector<std::string> wanted;
    if (stream.is_plane()) {
      for (const BoundaryEdges& boundary : stream.extruded()->plane.boundaries)
        wanted.push_back(boundary.name);
    } else {
      wanted = stream.patch_names();
      sides_ = stream.side_patches();
      patches_ = wanted.size();
      for (std::size_t n = sides_; n < patches_; ++n) wanted.push_back(wanted[n] + "_triangles");
    }
    names_ = cgns_boundary_names(wanted);
  }

  const std::string& of(std::size_t boundary) const { return names_[boundary]; }
  const std::string& of_triangles(std::size_t patch) const { return names_[patch - sides_ + patches_]; }
  const std::vector<std::string>& all() const { return names_; }

 private:
  std::vector<std::string> names_;
  std::size_t sides_ = 0, patches_ = 0;
};

/// Offsets of the arrays in the file, by their paths, on every rank.
class CgnsPlaces {
 public:
  /// `at_root` is used on rank 0. *Collective.*
  CgnsPlaces(const Communicator& comm, const std::map<std::string, std::int64_t>& at_root) {
    std::vector<std::string> paths;
    std::vector<std::int64_t> places;
    for (const auto& [path, place] : at_root) {
      paths.push_back(path);
      places.push_back(place);
    }
    paths = broadcast_words(comm, paths);
    comm.broadcast(places);
    for (std::size_t i = 0; i < paths.size(); ++i) places_[paths[i]] = places[i];
  }

  std::int64_t of(const std::string& path) const { return places_.at(path); }

 private:
  std::map<std::string, std::int64_t> places_;
};

/// Writes one zone.
class CgnsZoneWriter {
 public:
  CgnsZoneWriter(const MeshStream& stream, std::string zone)
      : stream_{stream}, zone_{std::move(zone)}, cells_{stream}, names_{stream} {}

  const MeshStream& stream() const { return stream_; }
  const std::string& zone() const { return zone_; }

  /// Adds the nodes of the zone, on rank 0.
  void lay_out(CgnsLayout& layout) const {
    layout.begin_zone(zone_, stream_.counts().nodes, stream_.counts().cells());
    layout.add_coordinates();
    for_each_kind([&]<CellKind kind>() {
      if (stream_.counts().of(kind) > 0)
        layout.add_section(section_name<kind>(), cgns_type_of<kind>, stream_.counts().of(kind));
    });
    if (!stream_.variables().empty()) layout.add_solution(Vertex, stream_.variables());
    if (!cells_.names().empty()) layout.add_solution(CellCenter, cells_.names());
    layout.end_zone();
  }

  /// Adds the nodes of its boundaries, on rank 0.
  void lay_out_boundaries(CgnsPatches& patches) const {
    patches.begin_zone(zone_, stream_.counts().cells() + 1);
    for (std::size_t n = 0; n < stream_.patches().size(); ++n)
      stream_.is_plane() ? lay_out_line(patches, n) : lay_out_patch(patches, n);
    if (stream_.is_plane()) patches.put_comments(comments_of(stream_.extruded()->plane));
    patches.end_zone();
  }

  /// Adds the pairs of a plane mesh. *Collective.*
  void lay_out_pairs(CgnsPatches* patches) const {
    if (!stream_.is_plane()) return;
    const Mesh& mesh = stream_.extruded()->plane;
    for (const PeriodicPair& pair : mesh.pairs) {
      const PairedNodes nodes = paired_nodes(stream_.communicator(), mesh, pair);
      const std::ptrdiff_t number = &pair - mesh.pairs.data() + 1;
      stream_.on_root([&] { patches->put_pair(zone_, "pair_" + std::to_string(number), pair, nodes); });
    }
  }

  /// Writes the arrays; `Size` is the type of numbers of nodes. *Collective.*
  template <class Size>
  void write(RowOutput& file, const CgnsPlaces& places) const {
    for (int k = 0; k < dimension(); ++k) {
      file.move_to(places.of(CgnsLayout::path_of_coordinate(zone_, k)));
      write_reals(file, stream_.point_rows(), [&](std::int64_t i) {
        const Point3 p = stream_.point(i);
        return k == 0 ? p.x : k == 1 ? p.y : p.z;
      });
    }
    for_each_kind([&]<CellKind kind>() {
      if (stream_.counts().of(kind) == 0) return;
      file.move_to(places.of(CgnsLayout::path_of_elements(zone_, section_name<kind>())));
      write_elements<Size>(file, stream_.cell_rows<kind>(),
                           [&](std::int64_t i) { return stream_.cell<kind>(i); });
    });
    write_solutions(file, places);
    write_sides<Size>(file, places);
    for (std::size_t n = stream_.side_patches(); n < stream_.patches().size(); ++n)
      write_patch<Size>(file, places, n);
  }

 private:
  int dimension() const { return stream_.is_plane() ? 2 : 3; }
  template <CellKind kind>
  static std::string section_name() {
    return cg_ElementTypeName(cgns_type_of<kind>);
  }

  void lay_out_line(CgnsPatches& patches, std::size_t n) const {
    const BoundaryEdges& boundary = *stream_.boundaries()->present()[n];
    const std::string name = section_of_side(n);
    patches.begin_patch();
    const CgnsNodes::Node section = patches.add_section(name, BAR_2, stream_.patches()[n].edges);
    if (boundary.inner_line)
      patches.put_full_name(section, name, boundary.name);
    else
      patches.put_condition(name, boundary, EdgeCenter);
  }

  /// A section of quads, then one of triangles.
  void lay_out_patch(CgnsPatches& patches, std::size_t n) const {
    const StreamedPatch& about = stream_.patches()[n];
    if (about.faces() == 0) return;
    patches.begin_patch();
    if (about.quads > 0) patches.add_section(names_.of(n), QUAD_4, about.quads);
    if (about.triangles > 0) patches.add_section(section_of_triangles(n), TRI_3, about.triangles);
    patches.put_condition(names_.of(n), {about.name, about.condition, {}}, FaceCenter);
  }

  /// Name of the section of a boundary of a plane or extruded mesh.
  std::string section_of_side(std::size_t n) const {
    if (!stream_.is_plane()) return names_.of(n);
    return names_.of(stream_.boundaries()->present()[n] - stream_.extruded()->plane.boundaries.data());
  }
  std::string section_of_triangles(std::size_t patch) const {
    return stream_.patches()[patch].quads > 0 ? names_.of_triangles(patch) : names_.of(patch);
  }

  template <class Value>
  static void write_reals(RowOutput& file, std::int64_t rows, const Value& value) {
    file.write_rows(rows,
                    [&](std::int64_t i) { return std::array{in_order<std::endian::little>(value(i))}; });
  }
  /// `nodes(i)`: numbers from 0.
  template <class Size, class Nodes>
  static void write_elements(RowOutput& file, std::int64_t rows, const Nodes& nodes) {
    file.write_rows(rows, [&](std::int64_t i) { return in_file<Size>(nodes(i)); });
  }
  template <class Size, std::size_t width>
  static std::array<Size, width> in_file(const std::array<NodeNumber, width>& nodes) {
    return in_order<std::endian::little>(as<Size>(nodes, 1));
  }

  void write_solutions(RowOutput& file, const CgnsPlaces& places) const {
    const auto begin = [&](GridLocation_t location, const std::vector<std::string>& names, std::size_t k) {
      file.move_to(places.of(CgnsLayout::path_of_variable(zone_, location, cgns_variable_names(names)[k])));
    };
    for (std::size_t k = 0; k < stream_.variables().size(); ++k) {
      begin(Vertex, stream_.variables(), k);
      write_reals(file, stream_.point_rows(), [&](std::int64_t i) { return stream_.value(i, k); });
    }
    for (std::size_t k = 0; k < cells_.names().size(); ++k) {  // in the order of the elements
      begin(CellCenter, cells_.names(), k);
      for_each_kind([&]<CellKind kind>() {
        write_reals(file, stream_.cell_rows<kind>(),
                    [&](std::int64_t i) { return cells_.of_cell<kind>(i, k); });
      });
    }
  }

  template <class Size>
  void write_sides(RowOutput& file, const CgnsPlaces& places) const {
    if (stream_.boundaries() == nullptr) return;
    std::vector<std::int64_t> begin;
    for (std::size_t n = 0; n < stream_.boundaries()->present().size(); ++n)
      begin.push_back(places.of(CgnsLayout::path_of_elements(zone_, section_of_side(n))));
    if (stream_.is_plane())
      file.write_edges(
          *stream_.boundaries(), 1,
          [](const BoundaryStream::Edge& edge, std::int64_t) { return in_file<Size>(edge); },
          std::move(begin));
    else
      file.write_edges(
          *stream_.boundaries(), stream_.layers(),
          [&](const BoundaryStream::Edge& edge, std::int64_t layer) {
            return in_file<Size>(stream_.side(edge, layer));
          },
          std::move(begin));
  }

  /// Writes a patch that is not a side.
  template <class Size>
  void write_patch(RowOutput& file, const CgnsPlaces& places, std::size_t n) const {
    const StreamedPatch& about = stream_.patches()[n];
    const auto write_section = [&]<std::size_t width>(const std::string& name) {
      file.move_to(places.of(CgnsLayout::path_of_elements(zone_, name)));
      write_elements<Size>(file, stream_.face_rows<width>(n),
                           [&](std::int64_t i) { return stream_.face<width>(n, i); });
    };
    if (about.quads > 0) write_section.template operator()<4>(names_.of(n));
    if (about.triangles > 0) write_section.template operator()<3>(section_of_triangles(n));
  }

  const MeshStream& stream_;
  std::string zone_;
  const StreamCellValues cells_;
  const CgnsPatchNames names_;
};

/// Writes a zone for each block; a mesh of one block is the zone "domain".
class CgnsWriter {
 public:
  CgnsWriter(const MeshStream& stream, OutputSet& outputs, const std::string& path, CgnsSizes sizes)
      : stream_{stream},
        outputs_{outputs},
        is_wide_{sizes == CgnsSizes::always_64_bits || needs_64_bits(stream)} {
    const StreamBlocks blocks(stream);
    if (blocks.several()) blocks_ = block_meshes(stream, path);
    const std::vector<std::string> names =
        cgns_zone_names(blocks.names(), blocks.several() ? CgnsPatchNames(blocks_[0]->stream()).all()
                                                         : std::vector<std::string>());
    for (std::size_t b = 0; b < blocks_.size(); ++b) zones_.emplace_back(blocks_[b]->stream(), names[b]);
    if (blocks_.empty()) zones_.emplace_back(stream, CgnsLayout::only_zone);
    staged_ = outputs.stage(path);
  }

  void write() {
    const CgnsPlaces places(stream_.communicator(), lay_out());
    RowOutput file(outputs_, staged_);
    for (const CgnsZoneWriter& zone : zones_)
      is_wide_ ? zone.write<std::int64_t>(file, places) : zone.write<std::int32_t>(file, places);
    file.close();
  }

 private:
  static bool needs_64_bits(const MeshStream& stream) {
    const StreamCounts& counts = stream.counts();
    std::int64_t elements = counts.cells();
    for (const StreamedPatch& patch : stream.patches()) elements += patch.faces();
    return std::max(elements, counts.largest_array()) > std::numeric_limits<std::int32_t>::max();
  }

  /// Creates the file, except for the contents of its arrays; returns their places on rank 0. *Collective.*
  std::map<std::string, std::int64_t> lay_out() {
    std::unique_ptr<CgnsNodes> nodes;  // on rank 0 only, like the next one
    std::unique_ptr<CgnsPatches> patches;
    stream_.on_root([&] {
      nodes = std::make_unique<CgnsNodes>(staged_, CgnsNodes::State::created, is_wide_ ? 8 : 4);
      CgnsLayout layout(*nodes, stream_.is_plane() ? 2 : 3);
      for (const CgnsZoneWriter& zone : zones_) zone.lay_out(layout);
      patches = std::make_unique<CgnsPatches>(*nodes);
      for (const CgnsZoneWriter& zone : zones_) zone.lay_out_boundaries(*patches);
    });
    for (const CgnsZoneWriter& zone : zones_) zone.lay_out_pairs(patches.get());
    connect_zones(patches.get());
    std::map<std::string, std::int64_t> places;
    stream_.on_root([&] {
      patches.reset();
      nodes->close();
      places = nodes->places();
    });
    return places;
  }

  /// Lists the nodes that two zones have in common, in both.
  void connect_zones(CgnsPatches* patches) const {
    for (std::size_t first = 0; first < blocks_.size(); ++first) {
      for (std::size_t second = first + 1; second < blocks_.size(); ++second) connect(patches, first, second);
    }
    stream_.on_root([&] {
      for (std::size_t b = 0; b < blocks_.size(); ++b)
        patches->put_block(zones_[b].zone(), static_cast<std::int32_t>(b + 1), blocks_[b]->name());
    });
  }

  void connect(CgnsPatches* patches, std::size_t first, std::size_t second) const {
    std::vector<std::array<std::int64_t, 2>> common;
    for (std::int64_t row = 0; row < stream_.point_rows(); ++row) {
      const NodeNumber here = blocks_[first]->node_of_row(row), there = blocks_[second]->node_of_row(row);
      if (here >= 0 && there >= 0) common.push_back({here + 1, there + 1});
    }
    std::vector<std::int64_t> of_first, of_second;
    for (const auto& [here, there] : gather_at_root(stream_.communicator(), common)) {
      of_first.push_back(here);
      of_second.push_back(there);
    }
    stream_.on_root([&] {
      if (of_first.empty()) return;
      const std::string &zone = zones_[first].zone(), &other = zones_[second].zone();
      patches->put_connection(zone, other, other, of_first, of_second);
      patches->put_connection(other, zone, zone, of_second, of_first);
    });
  }

  const MeshStream& stream_;
  OutputSet& outputs_;
  bool is_wide_;  ///< whether numbers of nodes and elements have 64 bits
  StagedFile staged_;
  std::vector<std::unique_ptr<BlockMesh>> blocks_;
  std::deque<CgnsZoneWriter> zones_;
};

}  // namespace

void write_cgns(OutputSet& outputs, const MeshStream& mesh, const std::string& path, CgnsSizes sizes) {
  CgnsWriter(mesh, outputs, path, sizes).write();
}

}  // namespace quadloop::io
