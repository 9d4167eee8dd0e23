#include "adapt/metric/tile/tile_passes.hpp"

#include <algorithm>

#include "adapt/metric/tile/operations.hpp"

namespace quadloop::adapt {

namespace {

constexpr double longest = 1.4142135623730951, shortest = 0.7071067811865476;
constexpr int passes = 2, flip_sweeps = 12, relax_sweeps = 3;

struct MeasuredEdge {
  double length;
  std::array<std::int32_t, 2> nodes;
  friend auto operator<=>(const MeasuredEdge&, const MeasuredEdge&) = default;
};

/// Edges for which `holds(length)`, the shortest first.
template <class Holds>
std::vector<MeasuredEdge> measured(const TileMesh& mesh, const Holds& holds) {
  std::vector<MeasuredEdge> found;
  for (const auto& [a, b] : mesh.edges()) {
    const double length = mesh.edge_length(a, b);
    if (holds(length)) found.push_back({length, {a, b}});
  }
  std::ranges::sort(found);
  return found;
}

std::int64_t split_long(TileMesh& mesh) {
  auto edges = measured(mesh, [](double length) { return length > longest; });
  std::ranges::reverse(edges);
  return std::ranges::count_if(
      edges, [&](const MeasuredEdge& e) { return split_edge(mesh, e.nodes[0], e.nodes[1]); });
}

std::int64_t collapse_short(TileMesh& mesh) {
  const auto edges = measured(mesh, [](double length) { return length < shortest; });
  return std::ranges::count_if(
      edges, [&](const MeasuredEdge& e) { return collapse_edge(mesh, e.nodes[0], e.nodes[1], longest); });
}

std::int64_t flip_all(TileMesh& mesh) {
  std::int64_t flips = 0;
  for (int sweep = 0; sweep < flip_sweeps; ++sweep) {
    const std::int64_t before = flips;
    for (const auto& [a, b] : mesh.edges()) flips += flip_edge(mesh, a, b) ? 1 : 0;
    if (flips == before) break;
  }
  return flips;
}

std::int64_t relax_all(TileMesh& mesh) {
  std::int64_t moves = 0;
  for (std::int32_t n = 0; n < mesh.nodes(); ++n) moves += relax_node(mesh, n) ? 1 : 0;
  return moves;
}

}  // namespace

TileChanges adapt_tile(TileMesh& mesh) {
  TileChanges changes;
  for (int pass = 0; pass < passes; ++pass) {
    changes.splits += split_long(mesh);
    changes.flips += flip_all(mesh);
    changes.collapses += collapse_short(mesh);
    changes.flips += flip_all(mesh);
    for (int sweep = 0; sweep < relax_sweeps; ++sweep) {
      changes.moves += relax_all(mesh);
      changes.flips += flip_all(mesh);
    }
  }
  return changes;
}

}  // namespace quadloop::adapt
