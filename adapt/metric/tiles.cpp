#include "adapt/metric/tiles.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <unordered_map>

#include "adapt/transfer/locate/curve_grid.hpp"
#include "mesher/base/parallel/exchange.hpp"
#include "mesher/mesh/box_over_ranks.hpp"

namespace quadloop::adapt {

namespace {

struct KeyedTriangle {
  std::uint64_t key = 0;
  LooseTriangle triangle;

  auto order() const {
    const auto& n = triangle.nodes;
    return std::tuple{key, n[0].id, n[1].id, n[2].id};
  }
};

/// Offset of the curve in each round, so that tile borders change.
class RoundCurve {
 public:
  RoundCurve(const Communicator& comm, const std::vector<LooseTriangle>& triangles, int round) {
    std::vector<Point> points;
    for (const LooseTriangle& t : triangles) {
      for (const TileNode& node : t.nodes) points.push_back(node.point);
    }
    const Box box = box_over_ranks(comm, points);
    const auto share = [&](double step) { return round * step - std::floor(round * step); };
    shift_ = {share(0.6180339887498949) * box.width(), share(0.4142135623730951) * box.height()};
    const Point extent{box.width(), box.height()};
    grid_ = CurveGrid(comm, std::vector{box.low, box.low + 2 * extent});
  }
  std::uint64_t key_of(const LooseTriangle& t) const { return grid_.key_of(t.centroid() + shift_); }

 private:
  CurveGrid grid_;
  Point shift_;
};

/// Rotates the smallest id to the front, so that a triangle does not depend on its origin.
void turn(LooseTriangle& t) {
  const auto id = [](const TileNode& node) { return node.id; };
  const auto first = std::ranges::min_element(t.nodes, {}, id) - t.nodes.begin();
  std::rotate(t.nodes.begin(), t.nodes.begin() + first, t.nodes.end());
  std::rotate(t.boundaries.begin(), t.boundaries.begin() + first, t.boundaries.end());
}

/// Sorted over all ranks, in approximately equal parts. *Collective.*
std::vector<KeyedTriangle> sorted_over_ranks(const Communicator& comm, std::vector<KeyedTriangle> rows) {
  constexpr std::size_t samples = 64;
  const auto by_order = [](const KeyedTriangle& a, const KeyedTriangle& b) { return a.order() < b.order(); };
  std::ranges::sort(rows, by_order);
  std::vector<std::uint64_t> keys;
  for (std::size_t i = 0; i < samples && !rows.empty(); ++i)
    keys.push_back(rows[i * rows.size() / samples].key);
  keys = comm.all_gather_values(std::span<const std::uint64_t>(keys));
  std::ranges::sort(keys);
  std::vector<std::uint64_t> splits;
  for (int rank = 1; rank < comm.size() && !keys.empty(); ++rank)
    splits.push_back(
        keys[static_cast<std::size_t>(rank) * keys.size() / static_cast<std::size_t>(comm.size())]);
  std::vector<int> ranks;
  for (const KeyedTriangle& row : rows)
    ranks.push_back(static_cast<int>(std::ranges::upper_bound(splits, row.key) - splits.begin()));
  rows = Exchange(comm, ranks).deliver(rows);
  std::ranges::sort(rows, by_order);
  return rows;
}

/// Approximate number of triangles that one becomes in a round.
std::int64_t weight_of(const LooseTriangle& t) {
  constexpr double per_unit = 2.3, most = 16;
  const auto& n = t.nodes;
  const LogMetric mean{1.0 / 3 * (n[0].metric + n[1].metric + n[2].metric)};
  const double area = 0.5 * cross(n[1].point - n[0].point, n[2].point - n[0].point);
  return 1 + static_cast<std::int64_t>(std::min(most, per_unit * area * density_of(exp_of(mean))));
}

struct Tiled {
  std::vector<LooseTriangle> triangles;
  std::vector<std::int64_t> tiles;  ///< tile of each triangle; ascending
};

/// *Collective.*
Tiled cut_in_tiles(const Communicator& comm, const TileCut& cut,
                   const std::vector<LooseTriangle>& triangles) {
  const RoundCurve curve(comm, triangles, cut.round);
  std::vector<KeyedTriangle> rows;
  rows.reserve(triangles.size());
  for (const LooseTriangle& t : triangles) {
    rows.push_back({curve.key_of(t), t});
    turn(rows.back().triangle);
  }
  rows = sorted_over_ranks(comm, std::move(rows));
  Tiled tiled;
  std::int64_t own = 0;
  for (const KeyedTriangle& row : rows) own += weight_of(row.triangle);
  std::int64_t before = comm.exclusive_sum(own);
  const std::int64_t tiles = comm.sum(own) / cut.size + 1;
  std::vector<int> ranks;
  for (const KeyedTriangle& row : rows) {
    tiled.triangles.push_back(row.triangle);
    tiled.tiles.push_back(std::min(before / cut.size, tiles - 1));
    before += weight_of(row.triangle);
    ranks.push_back(static_cast<int>(tiled.tiles.back() * comm.size() / tiles));
  }
  const Exchange exchange(comm, ranks);
  return {exchange.deliver(tiled.triangles), exchange.deliver(tiled.tiles)};
}

/// Adapts one tile after another; new nodes have negative ids until those of all ranks are counted.
class TileWorker {
 public:
  explicit TileWorker(const Walls& walls) : walls_{walls} {}

  void adapt(std::span<const LooseTriangle> triangles) {
    std::vector<TileNode> nodes;
    std::vector<TileTriangle> local;
    std::unordered_map<std::int64_t, std::int32_t> index;
    for (const LooseTriangle& t : triangles) {
      TileTriangle& made = local.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [entry, fresh] = index.emplace(t.nodes[k].id, size32(nodes));
        if (fresh) nodes.push_back(t.nodes[k]);
        made.nodes[k] = entry->second;
        made.sides[k].boundary = t.boundaries[k];
      }
    }
    TileMesh mesh(nodes, std::move(local), walls_);
    changes_ += adapt_tile(mesh);
    take(mesh);
  }

  const TileChanges& changes() const { return changes_; }
  /// *Collective.*
  std::vector<LooseTriangle> numbered(const Communicator& comm, std::int64_t first_new) {
    const std::int64_t first = first_new + comm.exclusive_sum(made_);
    for (LooseTriangle& t : triangles_) {
      for (TileNode& node : t.nodes) {
        if (node.id < 0) node.id = first - 1 - node.id;
      }
    }
    return std::move(triangles_);
  }

 private:
  void take(const TileMesh& mesh) {
    std::vector<std::int64_t> ids(static_cast<std::size_t>(mesh.nodes()));
    for (std::int32_t n = 0; n < mesh.nodes(); ++n) {
      const bool is_new = mesh.node(n).id < 0 && !mesh.star(n).empty();
      ids[n] = is_new ? -1 - made_++ : mesh.node(n).id;
    }
    for (std::int32_t t = 0; t < mesh.triangles(); ++t) {
      if (!mesh.stands(t)) continue;
      LooseTriangle& loose = triangles_.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t n = mesh.triangle(t).nodes[k];
        loose.nodes[k] = mesh.node(n);
        loose.nodes[k].id = ids[n];
        loose.boundaries[k] = mesh.triangle(t).sides[k].boundary;
      }
    }
  }

  const Walls& walls_;
  TileChanges changes_;
  std::int64_t made_ = 0;
  std::vector<LooseTriangle> triangles_;
};

}  // namespace

TileChanges adapt_in_tiles(const Communicator& comm, const TileCut& cut, const Walls& walls,
                           std::int64_t first_new, std::vector<LooseTriangle>& triangles) {
  const Tiled tiled = cut_in_tiles(comm, cut, triangles);
  TileWorker worker(walls);
  for (std::size_t begin = 0, end = 0; begin < tiled.tiles.size(); begin = end) {
    while (end < tiled.tiles.size() && tiled.tiles[end] == tiled.tiles[begin]) ++end;
    worker.adapt(std::span(tiled.triangles).subspan(begin, end - begin));
  }
  triangles = worker.numbered(comm, first_new);
  TileChanges all = worker.changes();
  all.splits = comm.sum(all.splits);
  all.collapses = comm.sum(all.collapses);
  all.flips = comm.sum(all.flips);
  all.moves = comm.sum(all.moves);
  return all;
}

}  // namespace quadloop::adapt
