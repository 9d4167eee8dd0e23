#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "io/cgns/cgns_file.hpp"
#include "io/cgns/cgns_handle.hpp"
#include "io/cgns/cgns_names.hpp"
#include "io/cgns/cgns_nodes.hpp"
#include "io/files/boundary_stream.hpp"
#include "io/files/row_stream.hpp"
#include "io/loaded/layers_text.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

constexpr const char *base_name = "Base", *zone_name = "domain", *base_path = "/Base",
                     *zone_path = "/Base/domain";
constexpr std::int64_t rows_per_piece = std::int64_t{1} << 18;  // at most 4 MB of nodes or of quads
constexpr std::int64_t largest_size = std::numeric_limits<cgsize_t>::max();

/// What stands on rank 0: the file, its one base and zone, and where the next piece of the array under way
/// goes.
class CgnsSink {
 public:
  CgnsSink(const StagedFile& staged) : file_{open(staged)} {}

  void begin_zone(std::int64_t nodes, std::int64_t cells) {
    const std::array<cgsize_t, 3> size{static_cast<cgsize_t>(nodes), static_cast<cgsize_t>(cells), 0};
    file_->check(cg_base_write(id(), base_name, 2, 2, &base_));
    file_->check(cg_goto(id(), base_, "end"));
    file_->check(cg_dataclass_write(NormalizedByUnknownDimensional));  // the unit of length is the user's own
    file_->check(cg_zone_write(id(), base_, zone_name, size.data(), Unstructured, &zone_));
  }

  void begin_rows() { next_row_ = 1; }

  void put_coordinates(std::span<const Point> points) {
    const cgsize_t first = next_row_, last = advance(points.size());
    put_coordinate("CoordinateX", points, &Point::x, first, last);
    put_coordinate("CoordinateY", points, &Point::y, first, last);
  }

  void begin_solution() {
    file_->check(cg_sol_write(id(), base_, zone_, "FlowSolution", Vertex, &solution_));
    file_->check(cg_goto(id(), base_, "Zone_t", zone_, "FlowSolution_t", solution_, "end"));
    file_->check(cg_dataclass_write(NondimensionalParameter));
  }

  void put_solution(std::span<const double> rows, const std::vector<std::string>& names) {
    const std::size_t width = names.size(), count = rows.size() / width;
    const cgsize_t first = next_row_, last = advance(count);
    column_.resize(count);
    for (std::size_t k = 0; k < width; ++k) {
      for (std::size_t i = 0; i < count; ++i) column_[i] = rows[i * width + k];
      int field = 0;
      file_->check(cg_field_partial_write(id(), base_, zone_, solution_, RealDouble, names[k].c_str(), &first,
                                          &last, column_.data(), &field));
    }
  }

  void begin_section(const std::string& name, ElementType_t type, std::int64_t elements) {
    const auto last = static_cast<cgsize_t>(next_element_ + elements - 1);
    file_->check(
        cg_section_partial_write(id(), base_, zone_, name.c_str(), type, next_element_, last, 0, &section_));
  }

  void put_elements(std::span<const cgsize_t> nodes, std::size_t width) {
    const cgsize_t first = next_element_;
    next_element_ += static_cast<cgsize_t>(nodes.size() / width);
    file_->check(
        cg_elements_partial_write(id(), base_, zone_, section_, first, next_element_ - 1, nodes.data()));
  }

  void close() { file_->close(); }

 private:
  using File = CgnsFile<OutputError>;

  static std::unique_ptr<File> open(const StagedFile& staged) {
    cg_set_file_type(CG_FILE_HDF5);
    try {
      return std::make_unique<File>(staged.temporary, staged.path, CG_MODE_WRITE);
    } catch (const OutputError&) {  // without the reason; a byte of our own may tell it
      OutputFile probe(staged);
      probe.write("?");
      probe.close();
      throw;
    }
  }
  int id() const { return file_->id(); }

  cgsize_t advance(std::size_t rows) {
    next_row_ += static_cast<cgsize_t>(rows);
    return next_row_ - 1;
  }

  void put_coordinate(const char* name, std::span<const Point> points, double Point::*member, cgsize_t first,
                      cgsize_t last) {
    column_.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) column_[i] = points[i].*member;
    int coordinate = 0;
    file_->check(cg_coord_partial_write(id(), base_, zone_, RealDouble, name, &first, &last, column_.data(),
                                        &coordinate));
    if (first == 1) put_length_dimension(coordinate);
  }

  /// Mass, length, time, temperature, angle: the coordinates are lengths.
  void put_length_dimension(int coordinate) {
    const std::array<float, 5> exponents{0, 1, 0, 0, 0};
    file_->check(
        cg_goto(id(), base_, "Zone_t", zone_, "GridCoordinates_t", 1, "DataArray_t", coordinate, "end"));
    file_->check(cg_exponents_write(RealSingle, exponents.data()));
  }

  std::unique_ptr<File> file_;
  int base_ = 0, zone_ = 0, section_ = 0, solution_ = 0;
  cgsize_t next_row_ = 1, next_element_ = 1;
  std::vector<double> column_;
};

/// The boundaries, on rank 0, once the rest of the file is written: for each a section of bars, a family that
/// says what it is, and a BC over the bars that points to the family: VTK and ParaView show a boundary only
/// where its BC is given so, walls excepted.
class BoundarySink {
 public:
  /// `first_element` is the number of the first bar.
  BoundarySink(const StagedFile& staged, std::int64_t first_element)
      : nodes_{staged},
        base_{nodes_.at(base_path)},
        zone_{nodes_.at(zone_path)},
        next_{static_cast<cgsize_t>(first_element)} {}

  void begin(const std::string& name, const BoundaryEdges& boundary, std::int64_t edges) {
    const std::array<cgsize_t, 2> range{next_, next_ + static_cast<cgsize_t>(edges) - 1};
    next_ = range[1] + 1;
    const std::array<std::int32_t, 2> type_and_parents{BAR_2, 0};
    const CgnsNodes::Node section = nodes_.add_integers(zone_, name, "Elements_t", type_and_parents);
    nodes_.add_integers(section, "ElementRange", "IndexRange_t", range);
    bars_.emplace(nodes_.add_array(section, "ElementConnectivity", "DataArray_t", 2 * edges));
    put_condition(name, boundary, range);
  }

  /// Of the boundary that was begun last.
  void put(std::span<const BoundaryStream::Edge> edges) {
    std::vector<cgsize_t> ends;
    ends.reserve(2 * edges.size());
    for (const auto& [from, to] : edges) {
      ends.push_back(static_cast<cgsize_t>(from + 1));
      ends.push_back(static_cast<cgsize_t>(to + 1));
    }
    bars_->put(ends);
  }

  void close() {
    bars_.reset();
    for (CgnsNodes::Node* node : {&base_, &zone_, &conditions_})
      *node = {};  // HDF5 keeps a file open as long as anything in it is
    nodes_.close();
  }

 private:
  void put_condition(const std::string& name, const BoundaryEdges& boundary,
                     std::span<const cgsize_t, 2> range) {
    const std::string type = cg_BCTypeName(static_cast<BCType_t>(cgns_condition(boundary.condition)));
    const CgnsNodes::Node family = nodes_.add(base_, name, "Family_t");
    nodes_.add_text(family, "FamBC", "FamilyBC_t", type);
    if (!conditions_.valid()) conditions_ = nodes_.add(zone_, "ZoneBC", "ZoneBC_t");
    const CgnsNodes::Node condition =
        nodes_.add_text(conditions_, name, "BC_t", cg_BCTypeName(FamilySpecified));
    nodes_.add_integers(condition, "PointRange", "IndexRange_t", range, 1);
    nodes_.add_text(condition, "GridLocation", "GridLocation_t", cg_GridLocationName(EdgeCenter));
    nodes_.add_text(condition, "FamilyName", "FamilyName_t", name);
    if (name != boundary.name)
      nodes_.add_text(condition, full_name_descriptor, "Descriptor_t", boundary.name);
    if (boundary.layers.count > 0)
      nodes_.add_text(condition, layers_descriptor, "Descriptor_t", text_of_layers(boundary.layers));
  }

  CgnsNodes nodes_;
  CgnsNodes::Node base_, zone_, conditions_;
  std::optional<CgnsNodes::Array> bars_;
  cgsize_t next_;
};

/// The collective side: every rank hands its rows over, rank 0 alone has a sink.
class CgnsWriter {
 public:
  CgnsWriter(OutputSet& outputs, const Mesh& mesh, const std::string& path)
      : comm_{outputs.communicator()}, mesh_{mesh}, boundaries_{comm_, mesh} {
    counts_ = {comm_.sum(mesh.owned_nodes), comm_.sum(size_of(mesh.triangles)),
               comm_.sum(size_of(mesh.quads)), 0};
    refuse_too_large(path);
    staged_ = outputs.stage(path);
    on_root([&] {
      sink_ = std::make_unique<CgnsSink>(staged_);
      sink_->begin_zone(counts_.nodes, counts_.triangles + counts_.quads);
    });
  }

  void write_mesh() {
    const RowStream nodes{comm_, mesh_.owned_nodes, rows_per_piece};
    on_root([&] { sink_->begin_rows(); });
    nodes.run<Point>(
        [&](std::int64_t begin, std::int64_t end) {
          return std::vector<Point>(mesh_.points.begin() + begin, mesh_.points.begin() + end);
        },
        [&](std::span<const Point> points) { sink_->put_coordinates(points); });
    write_section("TRI_3", TRI_3, std::span(mesh_.triangles), counts_.triangles);
    write_section("QUAD_4", QUAD_4, std::span(mesh_.quads), counts_.quads);
  }

  void write_solution(const Field& solution) {
    const std::size_t width = solution.names.size();
    if (width == 0) return;
    const std::vector<std::string> names = cgns_variable_names(solution.names);
    on_root([&] {
      sink_->begin_solution();
      sink_->begin_rows();
    });
    const RowStream rows{comm_, mesh_.owned_nodes, rows_per_piece};
    rows.run<double>(
        [&](std::int64_t begin, std::int64_t end) {
          const auto values = solution.values.begin();
          return std::vector<double>(values + begin * width, values + end * width);
        },
        [&](std::span<const double> values) { sink_->put_solution(values, names); });
  }

  /// Last of all: libcgns is done with the file.
  void write_boundaries() {
    std::unique_ptr<BoundarySink> sink;
    std::vector<std::string> names;
    on_root([&] {
      sink_->close();
      if (boundaries_.all_edges() == 0) return;
      sink = std::make_unique<BoundarySink>(staged_, counts_.triangles + counts_.quads + 1);
      names = cgns_boundary_names(names_of(mesh_.boundaries));
    });
    if (boundaries_.all_edges() == 0) return;
    boundaries_.run(
        [&](std::size_t n) {
          const BoundaryEdges* const boundary = boundaries_.present()[n];
          sink->begin(names[boundary - mesh_.boundaries.data()], *boundary, boundaries_.edges_of(n));
        },
        [&](std::span<const BoundaryStream::Edge> edges) { sink->put(edges); });
    on_root([&] { sink->close(); });
  }

 private:
  template <class Rows>
  static std::int64_t size_of(const Rows& rows) {
    return std::ssize(rows);
  }

  template <class Action>
  void on_root(const Action& action) {
    comm_.together([&] {
      if (comm_.is_root()) action();
    });
  }

  void refuse_too_large(const std::string& path) const {
    const std::int64_t elements = counts_.triangles + counts_.quads + boundaries_.all_edges();
    if (counts_.nodes <= largest_size && elements <= largest_size && 3 * counts_.triangles <= largest_size &&
        4 * counts_.quads <= largest_size) {
      return;
    }
    throw OutputError(
        path + ": " + std::to_string(counts_.nodes) + " nodes and " + std::to_string(elements) +
        " elements are more than this CGNS library can count (32-bit sizes); write a .mesh file instead");
  }

  template <std::size_t width>
  void write_section(const std::string& name, ElementType_t type,
                     std::span<const std::array<NodeId, width>> rows, std::int64_t all_rows) {
    if (all_rows == 0) return;
    on_root([&] { sink_->begin_section(name, type, all_rows); });
    const RowStream stream{comm_, std::ssize(rows), rows_per_piece};
    stream.run<cgsize_t>(
        [&](std::int64_t begin, std::int64_t end) {
          std::vector<cgsize_t> nodes((end - begin) * width);
          auto out = nodes.begin();
          for (const auto& row : rows.subspan(begin, end - begin)) {
            for (const NodeId node : row) *out++ = static_cast<cgsize_t>(mesh_.global(node).value() + 1);
          }
          return nodes;
        },
        [&](std::span<const cgsize_t> nodes) { sink_->put_elements(nodes, width); });
  }

  static std::vector<std::string> names_of(const std::vector<BoundaryEdges>& boundaries) {
    std::vector<std::string> names;
    for (const BoundaryEdges& boundary : boundaries) names.push_back(boundary.name);
    return names;
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  MeshCounts counts_;
  BoundaryStream boundaries_;
  StagedFile staged_;
  std::unique_ptr<CgnsSink> sink_;  ///< on rank 0 only
};

}  // namespace

void write_cgns(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Field* solution) {
  CgnsWriter writer(outputs, mesh, path);
  writer.write_mesh();
  if (solution != nullptr) writer.write_solution(*solution);
  writer.write_boundaries();
}

void write_cgns(const Communicator& comm, const Mesh& mesh, const std::string& path, const Field* solution) {
  OutputSet outputs(comm);
  write_cgns(outputs, mesh, path, solution);
  outputs.commit();
}

}  // namespace quadloop
