#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "io/cgns/cgns_file.hpp"
#include "io/cgns/cgns_handle.hpp"
#include "io/cgns/cgns_names.hpp"
#include "io/cgns/cgns_patches.hpp"
#include "io/cgns/cgns_sink.hpp"
#include "io/files/boundary_stream.hpp"
#include "io/files/row_stream.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

constexpr std::int64_t rows_per_piece = std::int64_t{1} << 18;  // at most 4 MB of nodes or of quads

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
      sink_ = std::make_unique<CgnsSink>(staged_, 2);
      sink_->begin_zone(counts_.nodes, counts_.triangles + counts_.quads);
    });
  }

  void write_mesh() {
    const RowStream nodes{comm_, mesh_.owned_nodes, rows_per_piece};
    on_root([&] { sink_->begin_rows(); });
    nodes.run<double>(
        [&](std::int64_t begin, std::int64_t end) {
          std::vector<double> coordinates;
          coordinates.reserve(2 * (end - begin));
          for (std::int64_t i = begin; i < end; ++i)
            coordinates.insert(coordinates.end(), {mesh_.points[i].x, mesh_.points[i].y});
          return coordinates;
        },
        [&](std::span<const double> coordinates) { sink_->put_coordinates(coordinates); });
    write_section("TRI_3", TRI_3, std::span(mesh_.triangles), counts_.triangles);
    write_section("QUAD_4", QUAD_4, std::span(mesh_.quads), counts_.quads);
  }

  void write_solution(const Field& solution) {
    write_fields(Vertex, solution.names, {{mesh_.owned_nodes, solution.values.data()}});
    const double* const of_cells = solution.cells.values.data();
    write_fields(CellCenter, solution.cells.names,
                 {{size_of(mesh_.triangles), of_cells},
                  {size_of(mesh_.quads), of_cells + mesh_.triangles.size() * solution.cells.width()}});
  }

  /// Last of all: libcgns is done with the file.
  void write_boundaries() {
    std::unique_ptr<CgnsPatches> sink;
    std::vector<std::string> names;
    on_root([&] {
      sink_->close();
      if (boundaries_.all_edges() == 0) return;
      sink = std::make_unique<CgnsPatches>(staged_, counts_.triangles + counts_.quads + 1);
      names = cgns_boundary_names(names_of(mesh_.boundaries));
    });
    if (boundaries_.all_edges() == 0) return;
    boundaries_.run(
        [&](std::size_t n) {
          const BoundaryEdges* const boundary = boundaries_.present()[n];
          const std::string& name = names[boundary - mesh_.boundaries.data()];
          sink->begin_patch();
          sink->begin_section(name, BAR_2, boundaries_.edges_of(n));
          sink->put_condition(name, *boundary, EdgeCenter);
        },
        [&](std::span<const BoundaryStream::Edge> edges) { sink->put(edges); });
    on_root([&] {
      sink->put_strips(mesh_.strips);
      sink->close();
    });
  }

 private:
  /// This rank's rows of one kind.
  struct Rows {
    std::int64_t count;
    const double* values;
  };

  /// All ranks' rows of a kind, then those of the next.
  void write_fields(GridLocation_t location, const std::vector<std::string>& variables,
                    std::initializer_list<Rows> kinds) {
    const std::size_t width = variables.size();
    if (width == 0) return;
    on_root([&] {
      sink_->begin_solution(location);
      sink_->begin_rows();
    });
    for (const Rows& rows : kinds) {
      RowStream{comm_, rows.count, rows_per_piece}.run<double>(
          [&](std::int64_t begin, std::int64_t end) {
            return std::vector<double>(rows.values + begin * width, rows.values + end * width);
          },
          [&](std::span<const double> values) { sink_->put_solution(values, variables); });
    }
  }

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
    if (counts_.nodes <= largest_cgns_size && elements <= largest_cgns_size &&
        3 * counts_.triangles <= largest_cgns_size && 4 * counts_.quads <= largest_cgns_size) {
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
