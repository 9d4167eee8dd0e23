#include "adapt/remesh/demands/mirrored_leaves.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "generate/leaf_quadrant.hpp"
#include "mesher/base/parallel/partners.hpp"

namespace quadloop::adapt {

Quadrant image_of(MirrorAxis axis, const TreeAttributes& tree, const Quadrant& quadrant) {
  Quadrant image = quadrant;
  const auto mirrored = [&](std::int64_t low, std::int32_t trees) {
    return (std::int64_t{trees} << Quadrant::unit_level) - low - quadrant.size();
  };
  if (axis == MirrorAxis::x) image.y = mirrored(quadrant.y, tree.trees_y);
  if (axis == MirrorAxis::y) image.x = mirrored(quadrant.x, tree.trees_x);
  return image;
}

void agree_with_images(const Communicator& comm, MirrorAxis axis, const TreeRecord& tree, OfImages of_images,
                       std::vector<double>& values) {
  const auto key_of = [](const Quadrant& q) {
    return std::array{static_cast<std::uint64_t>(q.x), static_cast<std::uint64_t>(q.y),
                      static_cast<std::uint64_t>(q.level)};
  };
  std::vector<PairKey<3>> keys;
  keys.reserve(tree.leaves.size());
  for (const LeafRecord& leaf : tree.leaves) {
    const Quadrant q = quadrant_of(leaf);
    keys.push_back({key_of(q), key_of(image_of(axis, tree.attributes, q))});
  }
  const std::vector<Partner> partners = find_partners<3>(comm, keys);
  std::vector<std::size_t> with_partner;
  std::vector<int> ranks;
  std::vector<std::int64_t> items;
  for (std::size_t i = 0; i < partners.size(); ++i) {
    if (!partners[i].found()) continue;
    with_partner.push_back(i);
    ranks.push_back(partners[i].rank);
    items.push_back(partners[i].item);
  }
  const Exchange exchange(comm, ranks);
  std::vector<double> of_partner;
  for (const std::int64_t item : exchange.deliver(items)) of_partner.push_back(values[item]);
  of_partner = exchange.answer(of_partner);
  for (std::size_t k = 0; k < with_partner.size(); ++k) {
    double& value = values[with_partner[k]];
    value = of_images == OfImages::larger ? std::max(value, of_partner[k]) : std::min(value, of_partner[k]);
  }
}

std::vector<SplitDemand> with_images(MirrorAxis axis, const TreeAttributes& tree,
                                     std::vector<SplitDemand> demands) {
  const std::size_t own = demands.size();
  demands.reserve(2 * own);
  for (std::size_t i = 0; i < own; ++i)
    demands.push_back({image_of(axis, tree, demands[i].leaf), demands[i].levels});
  return demands;
}

namespace {

/// The larger of two images' values at the ends of edges, `from` and `to`.
template <class Edge>
void agree_with_images(MirrorAxis axis, std::vector<Edge>& edges, double Edge::*from, double Edge::*to) {
  std::map<std::pair<Point, Point>, std::size_t> by_ends;
  for (std::size_t i = 0; i < edges.size(); ++i) by_ends.emplace(std::pair{edges[i].from, edges[i].to}, i);
  const std::vector<Edge> before = edges;
  for (Edge& edge : edges) {
    const auto image = by_ends.find({image_of(axis, edge.to), image_of(axis, edge.from)});
    if (image == by_ends.end()) continue;
    const Edge& other = before[image->second];
    edge.*from = std::max(edge.*from, other.*to);
    edge.*to = std::max(edge.*to, other.*from);
  }
}

}  // namespace

void agree_with_images(MirrorAxis axis, MeasuredWall& wall) {
  agree_with_images(axis, wall, &MeasuredEdge::wall_units_from, &MeasuredEdge::wall_units_to);
}

void agree_with_images(MirrorAxis axis, std::vector<MeasuredThickness>& thickness) {
  agree_with_images(axis, thickness, &MeasuredThickness::at_from, &MeasuredThickness::at_to);
}

void agree_with_images(MirrorAxis axis, std::vector<std::vector<Point>>& paths) {
  std::map<Point, std::size_t> by_beginning;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const auto image = by_beginning.find(image_of(axis, paths[i][0]));
    if (image_of(axis, paths[i][0]) == paths[i][0]) {
      for (Point& p : paths[i]) p = foot_on(axis, p);
    } else if (image != by_beginning.end()) {
      paths[i].clear();
      for (const Point p : paths[image->second]) paths[i].push_back(image_of(axis, p));
    }
    by_beginning.emplace(paths[i][0], i);
  }
}

}  // namespace quadloop::adapt
