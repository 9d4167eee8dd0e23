#include <array>
#include <limits>
#include <memory>
#include <span>

#include "io/cgns_file.hpp"
#include "io/cgns_handle.hpp"
#include "io/cgns_names.hpp"
#include "io/row_stream.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

constexpr std::int64_t rows_per_piece = std::int64_t{1} << 18;  // at most 4 MB of nodes or of quads
constexpr std::int64_t largest_size = std::numeric_limits<cgsize_t>::max();

/// What stands on rank 0: the file, its one base and zone, and where the next piece of the array under way goes.
class CgnsSink {
 public:
  CgnsSink(const StagedFile& staged) : file_{open(staged)} {}

  void begin_zone(std::int64_t nodes, std::int64_t cells) {
    const std::array<cgsize_t, 3> size{static_cast<cgsize_t>(nodes), static_cast<cgsize_t>(cells), 0};
    file_->check(cg_base_write(id(), "Base", 2, 2, &base_));
    file_->check(cg_goto(id(), base_, "end"));
    file_->check(cg_dataclass_write(NormalizedByUnknownDimensional));  // the unit of length is the user's own
    file_->check(cg_zone_write(id(), base_, "domain", size.data(), Unstructured, &zone_));
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
      file_->check(cg_field_partial_write(id(), base_, zone_, solution_, RealDouble, names[k].c_str(), &first, &last, column_.data(), &field));
    }
  }

  void begin_section(const std::string& name, ElementType_t type, std::int64_t elements) {
    const auto last = static_cast<cgsize_t>(next_element_ + elements - 1);
    file_->check(cg_section_partial_write(id(), base_, zone_, name.c_str(), type, next_element_, last, 0, &section_));
  }

  void put_elements(std::span<const cgsize_t> nodes, std::size_t width) {
    const cgsize_t first = next_element_;
    next_element_ += static_cast<cgsize_t>(nodes.size() / width);
    file_->check(cg_elements_partial_write(id(), base_, zone_, section_, first, next_element_ - 1, nodes.data()));
  }

  /// The boundary whose `edges` bars were put last: a family that says what it is, and a BC over them that points to the family. VTK and ParaView
  /// show a boundary only where its BC is given so, walls excepted.
  void put_condition(const std::string& name, const std::string& full_name, const std::string& condition, std::int64_t edges) {
    const auto type = static_cast<BCType_t>(cgns_condition(condition));
    const std::array<cgsize_t, 2> range{static_cast<cgsize_t>(next_element_ - edges), next_element_ - 1};
    int family = 0, family_condition = 0, boundary = 0;
    file_->check(cg_family_write(id(), base_, name.c_str(), &family));
    file_->check(cg_fambc_write(id(), base_, family, "FamBC", type, &family_condition));
    file_->check(cg_boco_write(id(), base_, zone_, name.c_str(), FamilySpecified, PointRange, 2, range.data(), &boundary));
    file_->check(cg_boco_gridlocation_write(id(), base_, zone_, boundary, EdgeCenter));
    file_->check(cg_goto(id(), base_, "Zone_t", zone_, "ZoneBC_t", 1, "BC_t", boundary, "end"));
    file_->check(cg_famname_write(name.c_str()));
    if (name != full_name) file_->check(cg_descriptor_write(full_name_descriptor, full_name.c_str()));
  }

  void close() { file_->close(); }

 private:
  using File = CgnsFile<OutputError>;

  static std::unique_ptr<File> open(const StagedFile& staged) {
    cg_set_file_type(CG_FILE_HDF5);
    return std::make_unique<File>(staged.temporary, staged.path, CG_MODE_WRITE);
  }
  int id() const { return file_->id(); }

  cgsize_t advance(std::size_t rows) {
    next_row_ += static_cast<cgsize_t>(rows);
    return next_row_ - 1;
  }

  void put_coordinate(const char* name, std::span<const Point> points, double Point::*member, cgsize_t first, cgsize_t last) {
    column_.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) column_[i] = points[i].*member;
    int coordinate = 0;
    file_->check(cg_coord_partial_write(id(), base_, zone_, RealDouble, name, &first, &last, column_.data(), &coordinate));
    if (first == 1) put_length_dimension(coordinate);
  }

  /// Mass, length, time, temperature, angle: the coordinates are lengths.
  void put_length_dimension(int coordinate) {
    const std::array<float, 5> exponents{0, 1, 0, 0, 0};
    file_->check(cg_goto(id(), base_, "Zone_t", zone_, "GridCoordinates_t", 1, "DataArray_t", coordinate, "end"));
    file_->check(cg_exponents_write(RealSingle, exponents.data()));
  }

  std::unique_ptr<File> file_;
  int base_ = 0, zone_ = 0, section_ = 0, solution_ = 0;
  cgsize_t next_row_ = 1, next_element_ = 1;
  std::vector<double> column_;
};

/// The collective side: every rank hands its rows over, rank 0 alone has a sink.
class CgnsWriter {
 public:
  CgnsWriter(OutputSet& outputs, const Mesh& mesh, const std::string& path) : comm_{outputs.communicator()}, mesh_{mesh} {
    counts_ = {comm_.sum(mesh.owned_nodes), comm_.sum(size_of(mesh.triangles)), comm_.sum(size_of(mesh.quads)), 0};
    for (const BoundaryEdges& boundary : mesh.boundaries) edges_.push_back(comm_.sum(size_of(boundary.edges)));
    refuse_too_large(path);
    const StagedFile staged = outputs.stage(path);
    on_root([&] {
      sink_ = std::make_unique<CgnsSink>(staged);
      sink_->begin_zone(counts_.nodes, counts_.triangles + counts_.quads);
    });
  }

  void write_mesh() {
    const RowStream nodes{comm_, mesh_.owned_nodes, rows_per_piece};
    on_root([&] { sink_->begin_rows(); });
    nodes.run<Point>(
        [&](std::int64_t begin, std::int64_t end) { return std::vector<Point>(mesh_.points.begin() + begin, mesh_.points.begin() + end); },
        [&](std::span<const Point> points) { sink_->put_coordinates(points); });
    write_section("TRI_3", TRI_3, std::span(mesh_.triangles), counts_.triangles);
    write_section("QUAD_4", QUAD_4, std::span(mesh_.quads), counts_.quads);
    write_boundaries();
  }

  void write_solution(const Solution& solution) {
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
          const auto step = static_cast<std::int64_t>(width);
          return std::vector<double>(values + begin * step, values + end * step);
        },
        [&](std::span<const double> values) { sink_->put_solution(values, names); });
  }

  void close() {
    on_root([&] { sink_->close(); });
  }

 private:
  template <class Rows>
  static std::int64_t size_of(const Rows& rows) {
    return static_cast<std::int64_t>(rows.size());
  }

  template <class Action>
  void on_root(const Action& action) {
    comm_.together([&] {
      if (comm_.is_root()) action();
    });
  }

  void refuse_too_large(const std::string& path) const {
    std::int64_t elements = counts_.triangles + counts_.quads;
    for (const std::int64_t edges : edges_) elements += edges;
    if (counts_.nodes <= largest_size && elements <= largest_size && 3 * counts_.triangles <= largest_size && 4 * counts_.quads <= largest_size) {
      return;
    }
    throw OutputError(path + ": " + std::to_string(counts_.nodes) + " nodes and " + std::to_string(elements) +
                      " elements are more than this CGNS library can count (32-bit sizes); write a .mesh file instead");
  }

  template <std::size_t width>
  void write_section(const std::string& name, ElementType_t type, std::span<const std::array<NodeId, width>> rows, std::int64_t all_rows) {
    if (all_rows == 0) return;
    on_root([&] { sink_->begin_section(name, type, all_rows); });
    const RowStream stream{comm_, static_cast<std::int64_t>(rows.size()), rows_per_piece};
    stream.run<cgsize_t>(
        [&](std::int64_t begin, std::int64_t end) {
          std::vector<cgsize_t> nodes(static_cast<std::size_t>(end - begin) * width);
          auto out = nodes.begin();
          for (const auto& row : rows.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin))) {
            for (const NodeId node : row) *out++ = static_cast<cgsize_t>(mesh_.global(node).value() + 1);
          }
          return nodes;
        },
        [&](std::span<const cgsize_t> nodes) { sink_->put_elements(nodes, width); });
  }

  void write_boundaries() {
    std::vector<std::string> full_names;
    for (const BoundaryEdges& boundary : mesh_.boundaries) full_names.push_back(boundary.name);
    const std::vector<std::string> names = cgns_boundary_names(full_names);
    for (std::size_t b = 0; b < names.size(); ++b) {
      if (edges_[b] == 0) continue;
      const BoundaryEdges& boundary = mesh_.boundaries[b];
      write_section(names[b], BAR_2, std::span(boundary.edges), edges_[b]);
      on_root([&] { sink_->put_condition(names[b], boundary.name, boundary.condition, edges_[b]); });
    }
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  MeshCounts counts_;
  std::vector<std::int64_t> edges_;  ///< of each boundary, over all ranks
  std::unique_ptr<CgnsSink> sink_;   ///< on rank 0 only
};

}  // namespace

void write_cgns(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Solution* solution) {
  CgnsWriter writer(outputs, mesh, path);
  writer.write_mesh();
  if (solution != nullptr) writer.write_solution(*solution);
  writer.close();
}

void write_cgns(const Communicator& comm, const Mesh& mesh, const std::string& path, const Solution* solution) {
  OutputSet outputs(comm);
  write_cgns(outputs, mesh, path, solution);
  outputs.commit();
}

}  // namespace quadloop
