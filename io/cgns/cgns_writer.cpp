#include <algorithm>
#include <array>
#include <deque>
#include <limits>
#include <memory>

#include "io/cgns/cgns_elements.hpp"
#include "io/cgns/cgns_file.hpp"
#include "io/cgns/cgns_names.hpp"
#include "io/cgns/cgns_patches.hpp"
#include "io/cgns/cgns_sink.hpp"
#include "io/model/pair_text.hpp"
#include "io/stream/block_meshes.hpp"
#include "io/stream/mesh_stream.hpp"
#include "io/stream/stream_blocks.hpp"
#include "io/stream/stream_cell_values.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

/// Returns rows of an array type as one list of numbers.
template <class Number, std::size_t width>
std::span<const Number> flat(std::span<const std::array<Number, width>> rows) {
  return {rows.empty() ? nullptr : rows.front().data(), rows.size() * width};
}

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

/// Writes one zone.
class CgnsZoneWriter {
 public:
  /// `sink` and `patches` exist on rank 0 only.
  CgnsZoneWriter(const MeshStream& stream, std::string zone, std::unique_ptr<CgnsSink>& sink,
                 std::unique_ptr<CgnsPatches>& patches)
      : stream_{stream},
        zone_{std::move(zone)},
        cells_{stream},
        names_{stream},
        sink_{sink},
        patches_{patches} {}

  const MeshStream& stream() const { return stream_; }
  const std::string& zone() const { return zone_; }

  void write_contents() {
    stream_.on_root([&] {
      sink_->begin_zone(zone_, stream_.counts().nodes, stream_.counts().cells());
      sink_->begin_rows();
    });
    stream_.is_plane() ? write_points<2>() : write_points<3>();
    for_each_kind([&]<CellKind kind>() { write_cells<kind>(); });
    if (!stream_.variables().empty()) write_solution();
    if (!cells_.names().empty()) write_solution_of_cells();
  }

  /// libcgns must have closed the file.
  void write_boundaries() {
    stream_.on_root([&] { patches_->begin_zone(zone_, stream_.counts().cells() + 1); });
    if (!stream_.patches().empty()) stream_.is_plane() ? write_edges() : write_patches();
    stream_.on_root([&] { patches_->end_zone(); });
  }

 private:
  template <std::size_t dimension>
  void write_points() {
    stream_.rows(
        stream_.point_rows(),
        [&](std::int64_t i) {
          const Point3 p = stream_.point(i);
          if constexpr (dimension == 2) return std::array{p.x, p.y};
          if constexpr (dimension == 3) return std::array{p.x, p.y, p.z};
        },
        [&](auto rows) { sink_->put_coordinates(flat<double>(rows)); });
  }

  auto put() {
    return [this](auto faces) { patches_->put(flat<cgsize_t>(faces)); };
  }

  template <CellKind kind>
  void write_cells() {
    const std::int64_t all = stream_.counts().of(kind);
    if (all == 0) return;
    const ElementType_t type = cgns_type_of<kind>;
    stream_.on_root([&] { sink_->begin_section(cg_ElementTypeName(type), type, all); });
    stream_.rows(
        stream_.cell_rows<kind>(), [&](std::int64_t i) { return as<cgsize_t>(stream_.cell<kind>(i), 1); },
        [&](auto some) { sink_->put_elements(flat<cgsize_t>(some), cell_width<kind>); });
  }

  void write_solution() {
    const std::vector<std::string> names = stream_.variables();
    begin_solution(Vertex);
    write_values(names, stream_.point_rows(),
                 [&](std::int64_t row, std::size_t variable) { return stream_.value(row, variable); });
  }

  /// In the order of the elements.
  void write_solution_of_cells() {
    const std::vector<std::string> names = cells_.names();
    begin_solution(CellCenter);
    for_each_kind([&]<CellKind kind>() {
      write_values(names, stream_.cell_rows<kind>(), [&](std::int64_t row, std::size_t variable) {
        return cells_.of_cell<kind>(row, variable);
      });
    });
  }

  void begin_solution(GridLocation_t location) {
    stream_.on_root([&] {
      sink_->begin_solution(location);
      sink_->begin_rows();
    });
  }

  /// Writes the next rows of all ranks in the current solution.
  template <class Value>
  void write_values(const std::vector<std::string>& names, std::int64_t count, const Value& value) {
    const std::size_t wide = names.size();
    const RowStream rows{stream_.communicator(), count,
                         std::max<std::int64_t>(1, numbers_per_piece / static_cast<std::int64_t>(wide))};
    rows.run<double>(
        [&](std::int64_t begin, std::int64_t end) {
          std::vector<double> values;
          values.reserve((end - begin) * wide);
          for (std::int64_t i = begin; i < end; ++i) {
            for (std::size_t k = 0; k < wide; ++k) values.push_back(value(i, k));
          }
          return values;
        },
        [&](std::span<const double> values) { sink_->put_solution(values, names); });
  }

  void write_edges() {
    const std::vector<BoundaryEdges>& boundaries = stream_.extruded()->plane.boundaries;
    stream_.boundaries()->run(
        [&](std::size_t n) {
          const BoundaryEdges* const boundary = stream_.boundaries()->present()[n];
          const std::string& name = names_.of(boundary - boundaries.data());
          patches_->begin_patch();
          const CgnsNodes::Node section = patches_->begin_section(name, BAR_2, stream_.patches()[n].edges);
          if (boundary->inner_line)
            patches_->put_full_name(section, name, boundary->name);
          else
            patches_->put_condition(name, *boundary, EdgeCenter);
        },
        [&](std::span<const BoundaryStream::Edge> edges) { patches_->put(edges); });
    const Mesh& mesh = stream_.extruded()->plane;
    stream_.on_root([&] { patches_->put_comments(comments_of(mesh)); });
    for (const PeriodicPair& pair : mesh.pairs) {
      const PairedNodes nodes = paired_nodes(stream_.communicator(), mesh, pair);
      const std::ptrdiff_t number = &pair - mesh.pairs.data() + 1;
      stream_.on_root([&] { patches_->put_pair(zone_, "pair_" + std::to_string(number), pair, nodes); });
    }
  }

  void write_patches() {
    stream_.sides([&](std::size_t n) { begin(n, 0, stream_.patches()[n].quads); }, number_nodes, put());
    for (std::size_t n = stream_.side_patches(); n < stream_.patches().size(); ++n) write_patch(n);
  }

  /// Begins a patch, on rank 0: its section of quads, then one of triangles.
  void begin(std::size_t patch, std::int64_t triangles, std::int64_t quads) {
    const StreamedPatch& about = stream_.patches()[patch];
    patches_->begin_patch();
    if (quads > 0) patches_->begin_section(names_.of(patch), QUAD_4, quads);
    if (triangles == 0)
      patches_->put_condition(names_.of(patch), {about.name, about.condition, {}}, FaceCenter);
  }

  /// Writes a patch that is not a side.
  void write_patch(std::size_t patch) {
    const StreamedPatch& about = stream_.patches()[patch];
    if (about.faces() == 0) return;
    stream_.on_root([&] { begin(patch, about.triangles, about.quads); });
    if (about.quads > 0) stream_.faces<4>(patch, number_nodes, put());
    if (about.triangles == 0) return;
    stream_.on_root([&] {
      patches_->begin_section(about.quads > 0 ? names_.of_triangles(patch) : names_.of(patch), TRI_3,
                              about.triangles);
      patches_->put_condition(names_.of(patch), {about.name, about.condition, {}}, FaceCenter);
    });
    stream_.faces<3>(patch, number_nodes, put());
  }

  static constexpr auto number_nodes = [](const auto& nodes) { return as<cgsize_t>(nodes, 1); };
  static constexpr std::int64_t numbers_per_piece = std::int64_t{1} << 17;

  const MeshStream& stream_;
  std::string zone_;
  const StreamCellValues cells_;
  const CgnsPatchNames names_;
  std::unique_ptr<CgnsSink>& sink_;
  std::unique_ptr<CgnsPatches>& patches_;
};

/// Writes a zone for each block; a mesh of one block is the zone "domain".
class CgnsWriter {
 public:
  CgnsWriter(const MeshStream& stream, OutputSet& outputs, const std::string& path) : stream_{stream} {
    refuse_too_large(path);
    const StreamBlocks blocks(stream);
    if (blocks.several()) blocks_ = block_meshes(stream, path);
    const std::vector<std::string> names =
        cgns_zone_names(blocks.names(), blocks.several() ? CgnsPatchNames(blocks_[0]->stream()).all()
                                                         : std::vector<std::string>());
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      zones_.emplace_back(blocks_[b]->stream(), names[b], sink_, patches_);
    if (blocks_.empty()) zones_.emplace_back(stream, CgnsSink::only_zone, sink_, patches_);
    staged_ = outputs.stage(path);
    stream_.on_root([&] {
      sink_ = std::make_unique<CgnsSink>(staged_, stream_.is_plane() ? 2 : 3);
      sink_->begin_base();
    });
  }

  void write() {
    for (CgnsZoneWriter& zone : zones_) zone.write_contents();
    stream_.on_root([&] {
      sink_->close();
      patches_ = std::make_unique<CgnsPatches>(staged_);
    });
    for (CgnsZoneWriter& zone : zones_) zone.write_boundaries();
    connect_zones();
    stream_.on_root([&] { patches_->close(); });
  }

 private:
  void refuse_too_large(const std::string& path) const {
    const StreamCounts& counts = stream_.counts();
    std::int64_t elements = counts.cells();
    for (const StreamedPatch& patch : stream_.patches()) elements += patch.faces();
    if (elements <= largest_cgns_size && counts.largest_array() <= largest_cgns_size) return;
    throw OutputError(path + ": " + std::to_string(counts.nodes) + " nodes and " + std::to_string(elements) +
                      " elements are more than this CGNS library can count (32-bit sizes); write a " +
                      (stream_.is_plane() ? ".mesh" : ".vtu") + " file instead");
  }

  /// Lists the nodes that two zones have in common, in both.
  void connect_zones() {
    for (std::size_t first = 0; first < blocks_.size(); ++first) {
      for (std::size_t second = first + 1; second < blocks_.size(); ++second) connect(first, second);
    }
    stream_.on_root([&] {
      for (std::size_t b = 0; b < blocks_.size(); ++b)
        patches_->put_block(zones_[b].zone(), static_cast<std::int32_t>(b + 1), blocks_[b]->name());
    });
  }

  void connect(std::size_t first, std::size_t second) {
    std::vector<std::array<cgsize_t, 2>> common;
    for (std::int64_t row = 0; row < stream_.point_rows(); ++row) {
      const NodeNumber here = blocks_[first]->node_of_row(row), there = blocks_[second]->node_of_row(row);
      if (here >= 0 && there >= 0)
        common.push_back({static_cast<cgsize_t>(here + 1), static_cast<cgsize_t>(there + 1)});
    }
    std::vector<cgsize_t> of_first, of_second;
    stream_.rows(
        std::ssize(common), [&](std::int64_t i) { return common[i]; },
        [&](auto rows) {
          for (const auto& [here, there] : rows) {
            of_first.push_back(here);
            of_second.push_back(there);
          }
        });
    stream_.on_root([&] {
      if (of_first.empty()) return;
      patches_->put_connection(zones_[first].zone(), zones_[second].zone(), zones_[second].zone(), of_first,
                               of_second);
      patches_->put_connection(zones_[second].zone(), zones_[first].zone(), zones_[first].zone(), of_second,
                               of_first);
    });
  }

  const MeshStream& stream_;
  StagedFile staged_;
  std::vector<std::unique_ptr<BlockMesh>> blocks_;
  std::unique_ptr<CgnsSink> sink_;  ///< on rank 0 only, like the next one
  std::unique_ptr<CgnsPatches> patches_;
  std::deque<CgnsZoneWriter> zones_;
};

}  // namespace

void write_cgns(OutputSet& outputs, const MeshStream& mesh, const std::string& path) {
  CgnsWriter(mesh, outputs, path).write();
}

}  // namespace quadloop::io
