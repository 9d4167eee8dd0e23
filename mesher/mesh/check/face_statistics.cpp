#include "mesher/mesh/check/face_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "mesher/mesh/check/cell_pairs.hpp"
#include "mesher/mesh/periodic_mesh.hpp"

namespace quadloop {

namespace {

struct FacedCell {
  Point centre;
  bool in_layers = false;
};

Point centroid(Point a, Point b, Point c) { return a + 1.0 / 3 * ((b - a) + (c - a)); }

template <class Nodes>
Point centroid_of(const HaloMesh& mesh, const Nodes& nodes) {
  const Point a = mesh.point(nodes[0]), b = mesh.point(nodes[1]), c = mesh.point(nodes[2]);
  if constexpr (std::tuple_size_v<Nodes> == 3) return centroid(a, b, c);
  const Point d = mesh.point(nodes.back());
  const double first = cross(b - a, c - a), second = cross(c - a, d - a);
  const Point of_first = centroid(a, b, c);
  return of_first + second / (first + second) * (centroid(a, c, d) - of_first);
}

template <class Nodes>
double aspect_ratio_of(const Mesh& mesh, const Nodes& nodes) {
  constexpr std::size_t width = std::tuple_size_v<Nodes>;
  double longest = 0;
  for (std::size_t k = 0; k < width; ++k) {
    const Point edge = mesh.point(nodes[(k + 1) % width]) - mesh.point(nodes[k]);
    longest = std::max(longest, dot(edge, edge));
  }
  const Point a = mesh.point(nodes[0]), c = mesh.point(nodes[2]);
  const double parallelogram = width == 3 ? cross(mesh.point(nodes[1]) - a, c - a)
                                          : cross(c - a, mesh.point(nodes.back()) - mesh.point(nodes[1])) / 2;
  return longest / parallelogram;
}

template <class Nodes>
bool is_flat(const Mesh& mesh, const Nodes& nodes) {
  Box box;
  for (const NodeId node : nodes) box.include(mesh.point(node));
  const auto [shorter, longer] = std::minmax({box.width(), box.height()});
  return longer > FaceStatistics::severe_aspect_ratio * shorter;
}

double degrees_between(Point a, Point b) {
  return std::atan2(std::abs(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
}

/// `towards`: from a cell's centre to that of the neighbour, or to the boundary; `to_middle`: from the centre
/// to the midpoint of the edge.
double skewness_of(Point edge, Point to_middle, Point towards, double least_share) {
  const double along = cross(edge, towards);
  if (along == 0) return 0;  // degenerate: the line never meets the edge's line
  const double off = length(to_middle - cross(edge, to_middle) / along * towards);
  return off / std::max(0.5 * length(edge), least_share * length(towards));
}

void include(FaceStatistics& statistics, double non_orthogonality, double skewness, bool counts) {
  statistics.non_orthogonality = std::max(statistics.non_orthogonality, non_orthogonality);
  statistics.skewness = std::max(statistics.skewness, skewness);
  statistics.non_orthogonal += counts && non_orthogonality > FaceStatistics::severe_degrees;
  statistics.skew += counts && skewness > FaceStatistics::severe_skewness;
}

FaceStatistics over_ranks(const Communicator& comm, const FaceStatistics& of_rank) {
  return {comm.maximum(of_rank.non_orthogonality),
          comm.maximum(of_rank.skewness),
          comm.maximum(of_rank.aspect_ratio),
          comm.sum(of_rank.non_orthogonal),
          comm.sum(of_rank.skew),
          comm.sum(of_rank.flat)};
}

/// Returns a flag for each of this rank's cells, triangles first.
std::vector<char> cells_in_layers(const Mesh& mesh, const LayerPlaces& places) {
  std::vector<char> flags;
  const auto add = [&](const auto& cells) {
    for (const auto& nodes : cells) flags.push_back(!places.empty() && is_layer_cell(places, nodes) ? 1 : 0);
  };
  add(mesh.triangles);
  add(mesh.quads);
  return flags;
}

void include_aspect_ratios(const Mesh& mesh, const std::vector<char>& in_layers,
                           FaceStatisticsByLayers& statistics) {
  std::size_t cell = 0;
  const auto add = [&](const auto& cells) {
    for (const auto& nodes : cells) {
      FaceStatistics& group = in_layers[cell++] != 0 ? statistics.layers : statistics.others;
      group.aspect_ratio = std::max(group.aspect_ratio, aspect_ratio_of(mesh, nodes));
      group.flat += is_flat(mesh, nodes);
    }
  };
  add(mesh.triangles);
  add(mesh.quads);
}

}  // namespace

FaceStatisticsByLayers face_statistics(const Communicator& comm, const Mesh& mesh,
                                       const LayerPlaces& places) {
  FaceStatisticsByLayers statistics;
  const std::vector<char> own_in_layers = cells_in_layers(mesh, places);
  include_aspect_ratios(mesh, own_in_layers, statistics);
  const std::optional<PeriodicMesh> joined = join_pairs_if_possible(comm, mesh);
  const HaloMesh halo = joined ? HaloMesh(comm, *joined) : HaloMesh(comm, mesh);
  const std::vector<char> in_layers = halo.spread(comm, own_in_layers);
  const auto group = [&](bool of_layers) -> FaceStatistics& {
    return of_layers ? statistics.layers : statistics.others;
  };
  const auto is_counted = [&](NodeId from, NodeId to) {
    const GlobalNodeId a = halo.global(from), b = halo.global(to);
    if (a == b) return shift_of(halo.image(to)) > 0;  // from a node to its own image, seen from both
    return halo.owns(a < b ? from : to);
  };
  CellPairs<FacedCell> pairs(halo, [](NodeId) { return true; });
  pairs.for_each(
      [&](const auto& nodes, std::int32_t number) {
        return FacedCell{centroid_of(halo, nodes), in_layers[number] != 0};
      },
      [&](NodeId from, NodeId to, const FacedCell& cell, const FacedCell& other) {
        const Point edge = halo.point(to) - halo.point(from), line = other.centre - cell.centre;
        const Point normal = cross(edge, line) < 0 ? Point{edge.y, -edge.x} : Point{-edge.y, edge.x};
        const Point to_middle = halo.point(from) + 0.5 * edge - cell.centre;
        include(group(cell.in_layers || other.in_layers), degrees_between(normal, line),
                skewness_of(edge, to_middle, line, 0.2), is_counted(from, to));
      });
  pairs.for_each_single([&](NodeId from, NodeId to, const FacedCell& cell) {
    const Point edge = halo.point(to) - halo.point(from);
    const Point to_middle = halo.point(from) + 0.5 * edge - cell.centre;
    const Point normal{edge.y, -edge.x};
    const Point to_boundary = dot(normal, to_middle) / dot(normal, normal) * normal;
    include(group(cell.in_layers), 0, skewness_of(edge, to_middle, to_boundary, 0.4), is_counted(from, to));
  });
  return {over_ranks(comm, statistics.layers), over_ranks(comm, statistics.others)};
}

}  // namespace quadloop
