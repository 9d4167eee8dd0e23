#include "mesher/build/mesh_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesher/build/islands.hpp"
#include "mesher/sizes/size_cursor.hpp"

namespace quadloop {

namespace {

// Means over the cases and over difficult geometries, each within 20 %.
constexpr double hybrid_cells_of_leaf = 1.12, triangles_of_leaf = 2.05;

// Peak memory of meshing, smoothing and writing, in bytes; that of a cut leaf refers to the estimated number.
constexpr double of_leaf = 80, of_cut_leaf = 450, of_hybrid_cell = 45, of_delaunay_triangle = 35;
// On every rank, including the program itself.
constexpr double of_segment = 110, of_program = 28 * 0x1p20;
constexpr double of_station = 300;  // additional memory of a segment of the outer edge of layers

/// Returns the number of points that the mesh must keep: each but the first in a leaf adds a triangle.
double kept_points(const Geometry& geometry) {
  double kept = 0;
  for (std::int32_t v = 0; v < geometry.size(); ++v) kept += geometry.kept(v) ? 1 : 0;
  return kept;
}

/// Returns the number of segments of the outer edge of layers, each of which may have a column.
double stations_of(const Geometry& geometry) {
  double stations = 0;
  for (std::int32_t s = 0; s < geometry.size(); ++s)
    stations += geometry.boundary(geometry.boundary_of(s)).layers ? 1 : 0;
  return stations;
}

/// Returns the number of cells in layers: a column on each edge of the outer edge, of the length of the
/// leaves there.
double cells_of_layers(const Geometry& geometry, SizedDomain& domain) {
  const TreeGrid& grid = domain.grid;
  SizeCursor leaves(domain.sizes);
  double cells = 0;
  for (std::int32_t s = 0; s < geometry.size(); ++s) {
    const auto& layers = geometry.boundary(geometry.boundary_of(s)).layers;
    if (!layers) continue;
    const Point from = geometry.point(s), to = geometry.point(geometry.next(s)), middle = 0.5 * (from + to);
    const Quadrant place{grid.column_at(middle.x), grid.row_at(middle.y), Quadrant::unit_level};
    cells += layers->count * length(to - from) / grid.edge(leaves.target_level(place));
  }
  return cells;
}

}  // namespace

MeshEstimate estimate_mesh(const Geometry& geometry, MeshType type, SizedDomain& domain,
                           const LeafEstimate& leaves) {
  const bool delaunay = has_triangles_alone(type);
  MeshEstimate estimate;
  estimate.leaves = leaves.all();
  estimate.cells = (leaves.inside + leaves.cut) * (delaunay ? triangles_of_leaf : hybrid_cells_of_leaf);
  estimate.cells += std::max(0.0, kept_points(geometry) - leaves.cut);
  estimate.layer_cells = cells_of_layers(geometry, domain) * (divides_layers(type) ? 2 : 1);
  estimate.cells += estimate.layer_cells;
  estimate.bytes = of_leaf * leaves.all() + of_cut_leaf * leaves.cut +
                   (delaunay ? of_delaunay_triangle : of_hybrid_cell) * estimate.cells;
  estimate.bytes_of_rank = of_program + of_segment * geometry.size() + of_station * stations_of(geometry);
  return estimate;
}

MeshEstimate estimate_mesh(const Geometry& given, const MeshOptions& options,
                           const DemandedSplits& demanded) {
  MeshReport dropped;
  const std::optional<Geometry> fewer = small_islands_dropped(given, options.size.min, dropped);
  const Geometry& geometry = fewer ? *fewer : given;
  SizedDomain domain(geometry, options.size, demanded);
  return estimate_mesh(geometry, options.type, domain, estimate_leaves(domain.sizes));
}

double share_of(const MeshLimit& limit, const MeshEstimate& estimate) {
  return std::max(estimate.cells / limit.cells, total_bytes(estimate, limit.ranks) / limit.bytes);
}

double total_bytes(const MeshEstimate& estimate, int ranks) {
  return estimate.bytes + ranks * estimate.bytes_of_rank;
}

std::string text_of_bytes(double bytes) {
  constexpr double mib = 0x1p20, step = 1024;
  if (bytes < step * mib) return fmt::format("{:.0f} MiB", bytes / mib);
  return bytes < step * step * mib ? fmt::format("{:.1f} GiB", bytes / (step * mib))
                                   : fmt::format("{:.0f} TiB", bytes / (step * step * mib));
}

std::string text_of_cells(double cells) {
  return cells < 1e6 ? fmt::format("{:.0f}", std::round(cells / 10) * 10) : fmt::format("{:.2g}", cells);
}

}  // namespace quadloop
