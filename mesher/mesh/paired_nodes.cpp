#include "mesher/mesh/paired_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

struct GatheredEdge {
  GlobalNodeId from, to;
  Point a, b;
};

std::vector<GatheredEdge> gather_edges(const Communicator& comm, const Mesh& mesh,
                                       const std::string& boundary) {
  std::vector<GatheredEdge> own;
  for (const BoundaryEdges& of_name : mesh.boundaries) {
    if (of_name.name != boundary) continue;
    for (const auto& [from, to] : of_name.edges)
      own.push_back({mesh.global(from), mesh.global(to), mesh.point(from), mesh.point(to)});
  }
  return comm.all_gather_values(std::span<const GatheredEdge>(own));
}

void turn_round(BoundaryLine& line) {
  std::ranges::reverse(line.nodes);
  std::ranges::reverse(line.points);
  std::ranges::reverse(line.edges);
}

PairFault fault_between(const PeriodicPair& pair, Point place, const std::string& what) {
  return {fmt::format("boundaries '{}' and '{}' are no periodic pair: {}", pair.from, pair.to, what), place};
}

double largest_coordinate(const std::vector<Point>& points) {
  double largest = 0;
  for (const Point p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  return largest;
}

}  // namespace

std::optional<BoundaryLine> line_of_boundary(const Communicator& comm, const Mesh& mesh,
                                             const std::string& boundary) {
  const std::vector<GatheredEdge> edges = gather_edges(comm, mesh, boundary);
  std::map<GlobalNodeId, std::int32_t> starting, ending;
  for (std::int32_t e = 0; e < size32(edges); ++e) {
    starting.emplace(edges[e].from, e);
    ending.emplace(edges[e].to, e);
  }
  const auto first =
      std::ranges::find_if(edges, [&](const GatheredEdge& e) { return !ending.contains(e.from); });
  if (first == edges.end()) return {};
  BoundaryLine line{{first->from}, {first->a}, {}};
  for (auto at = starting.find(first->from); at != starting.end() && line.edges.size() < edges.size();
       at = starting.find(line.nodes.back())) {
    line.edges.push_back(at->second);
    line.nodes.push_back(edges[at->second].to);
    line.points.push_back(edges[at->second].b);
  }
  if (line.edges.size() != edges.size()) return {};
  return line;
}

namespace {

struct Partners {
  PairedNodes nodes;
  std::optional<PairFault> fault;
};

Partners partners_of(const Communicator& comm, const Mesh& mesh, const PeriodicPair& pair) {
  constexpr double tolerance = 1e-11;
  Partners found;
  for (const auto& [name, side] :
       {std::pair(&pair.from, &found.nodes.from), std::pair(&pair.to, &found.nodes.to)}) {
    std::optional<BoundaryLine> line = line_of_boundary(comm, mesh, *name);
    if (!line) {
      found.fault = fault_between(pair, {}, fmt::format("'{}' is not one open line", *name));
      return found;
    }
    *side = std::move(*line);
  }
  turn_round(found.nodes.to);
  const std::vector<Point>&from = found.nodes.from.points, &to = found.nodes.to.points;
  const double allowed = tolerance * std::max(largest_coordinate(from), largest_coordinate(to));
  for (std::size_t i = 0; i < std::min(from.size(), to.size()); ++i) {
    const double distance = length(pair.image(from[i]) - to[i]);
    if (distance <= allowed) continue;
    found.fault =
        fault_between(pair, from[i],
                      fmt::format("the image of the node at ({:.6g}, {:.6g}) is {:.3g} from the node "
                                  "at ({:.6g}, {:.6g})",
                                  from[i].x, from[i].y, distance, to[i].x, to[i].y));
    return found;
  }
  if (from.size() != to.size())
    found.fault = fault_between(pair, from.back(),
                                fmt::format("one has {} nodes, the other {}", from.size(), to.size()));
  return found;
}

}  // namespace

std::optional<PairFault> fault_of_pair(const Communicator& comm, const Mesh& mesh, const PeriodicPair& pair) {
  return partners_of(comm, mesh, pair).fault;
}

PairedNodes paired_nodes(const Communicator& comm, const Mesh& mesh, const PeriodicPair& pair) {
  Partners found = partners_of(comm, mesh, pair);
  if (found.fault) throw InputError(found.fault->what + "; make the mesh again");
  return std::move(found.nodes);
}

std::vector<NodeId> nodes_on_sides(const Mesh& mesh) {
  std::vector<NodeId> nodes;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    const bool is_of_pair = std::ranges::any_of(mesh.pairs, [&](const PeriodicPair& pair) {
      return boundary.name == pair.from || boundary.name == pair.to;
    });
    if (!is_of_pair) continue;
    for (const auto& edge : boundary.edges) nodes.insert(nodes.end(), edge.begin(), edge.end());
  }
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace quadloop
