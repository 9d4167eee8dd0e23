#include "mesher/partition/partition.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <numeric>
#include <string>

#include "mesher/base/error.hpp"
#include "mesher/base/parallel/exchange.hpp"
#include "mesher/mesh/box_over_ranks.hpp"
#include "mesher/partition/hilbert.hpp"
#include "mesher/partition/refine_parts.hpp"

namespace quadloop {

namespace {

constexpr std::int64_t quad_weight = 4;  // number of edges of a quad

/// Position of a cell on the curve: by key and, for equal keys, by global number, triangles first.
struct Place {
  std::uint64_t key = 0;
  std::int64_t number = 0;
  friend auto operator<=>(const Place&, const Place&) = default;
};

/// Cumulative weight of this rank's cells along the curve.
class WeightsAlongCurve {
 public:
  WeightsAlongCurve(std::vector<Place> places, const std::vector<std::int64_t>& weights)
      : places_(places.size()), sums_(places.size() + 1, 0) {
    std::vector<std::int32_t> order(places.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [&](std::int32_t i) { return places[i]; });
    for (std::size_t i = 0; i < order.size(); ++i) {
      places_[i] = places[order[i]];
      sums_[i + 1] = sums_[i] + weights[order[i]];
    }
  }

  /// Weight of the cells up to and including `last`.
  std::int64_t up_to(const Place& last) const {
    return sums_[std::ranges::upper_bound(places_, last) - places_.begin()];
  }
  std::int64_t all() const { return sums_.back(); }

 private:
  std::vector<Place> places_;
  std::vector<std::int64_t> sums_;
};

/// Sums vectors over ranks. Each entry is summed on one rank, so that the data sent do not grow with the
/// number of ranks times the length of the vector.
class RowSum {
 public:
  RowSum(const Communicator& comm, std::size_t length) : exchange_(comm, ranks_for(comm, length)) {}

  /// *Collective.*
  std::vector<std::int64_t> operator()(const std::vector<std::int64_t>& row) const {
    std::vector<std::int64_t> arrived = exchange_.deliver(row);
    const std::size_t ranks = exchange_.sources().size(), own = ranks == 0 ? 0 : arrived.size() / ranks;
    for (std::size_t i = 0; i < own; ++i) {
      std::int64_t sum = 0;
      for (std::size_t rank = 0; rank < ranks; ++rank) sum += arrived[rank * own + i];
      for (std::size_t rank = 0; rank < ranks; ++rank) arrived[rank * own + i] = sum;
    }
    return exchange_.answer(arrived);
  }

 private:
  static std::vector<int> ranks_for(const Communicator& comm, std::size_t length) {
    std::vector<int> ranks;
    const std::size_t all = comm.size();
    for (std::size_t i = 0; i < length; ++i) ranks.push_back(static_cast<int>(i * all / length));
    return ranks;
  }

  Exchange exchange_;
};

/// The last position of each part but the last: the first at which the cumulative weight reaches the part's
/// share.
class Splits {
 public:
  Splits(const Communicator& comm, const WeightsAlongCurve& weights, std::int32_t parts)
      : weights_{weights}, sum_(comm, parts - 1), splits_(parts - 1) {
    const std::int64_t all = comm.sum(weights.all());
    for (std::int64_t part = 1; part < parts; ++part) shares_.push_back((all * part + parts - 1) / parts);
  }

  /// *Collective.*
  std::vector<Place> find(std::int64_t cells) {
    for (Place& split : splits_) split.number = cells;
    bisect(2 * hilbert_bits, [](Place& place, std::uint64_t key) { place.key = key; });
    bisect(static_cast<int>(std::bit_width(static_cast<std::uint64_t>(cells))),
           [](Place& place, std::uint64_t number) { place.number = static_cast<std::int64_t>(number); });
    return splits_;
  }

 private:
  /// Finds the smallest numbers with this many bits at which the cumulative weights reach the shares.
  template <class Set>
  void bisect(int bits, const Set& set) {
    std::vector<std::uint64_t> low(splits_.size(), 0);
    for (int bit = bits - 1; bit >= 0; --bit) {
      const std::uint64_t half = std::uint64_t{1} << bit;
      std::vector<std::int64_t> sums;
      for (std::size_t i = 0; i < splits_.size(); ++i) {
        Place middle = splits_[i];
        set(middle, low[i] + half - 1);
        sums.push_back(weights_.up_to(middle));
      }
      sums = sum_(sums);
      for (std::size_t i = 0; i < splits_.size(); ++i) {
        if (sums[i] < shares_[i]) low[i] += half;
      }
    }
    for (std::size_t i = 0; i < splits_.size(); ++i) set(splits_[i], low[i]);
  }

  const WeightsAlongCurve& weights_;
  RowSum sum_;
  std::vector<Place> splits_;
  std::vector<std::int64_t> shares_;
};

/// Returns the positions of this rank's cells, triangles, then quads. *Collective.*
std::vector<Place> places_of(const Communicator& comm, const Mesh& mesh) {
  const Box box = box_over_ranks(comm, mesh.points);
  const double side = std::max(box.width(), box.height());
  constexpr double last = (std::uint64_t{1} << hilbert_bits) - 1;
  const auto step = [&](double at, double low) {
    return static_cast<std::uint32_t>(side > 0 ? std::clamp((at - low) / side, 0.0, 1.0) * last : 0);
  };
  std::vector<Place> places;
  places.reserve(mesh.cell_count());
  const auto append = [&](const auto& cells, std::int64_t number) {
    for (const auto& nodes : cells) {
      Point middle{0, 0};
      for (const NodeId node : nodes) middle = middle + mesh.point(node);
      const double share = 1.0 / static_cast<double>(nodes.size());
      places.push_back(
          {hilbert_key(step(share * middle.x, box.low.x), step(share * middle.y, box.low.y)), number++});
    }
  };
  append(mesh.triangles, comm.exclusive_sum(std::ssize(mesh.triangles)));
  append(mesh.quads, comm.sum(std::ssize(mesh.triangles)) + comm.exclusive_sum(std::ssize(mesh.quads)));
  return places;
}

/// Divides the curve into segments of equal weight, up to that of a cell.
CellParts along_curve(const Communicator& comm, const Mesh& mesh, const PartWeights& of_cells,
                      std::int32_t parts) {
  const std::vector<Place> places = places_of(comm, mesh);
  std::vector<std::int64_t> weights(mesh.triangles.size(), of_cells.of_triangle);
  weights.resize(places.size(), of_cells.of_quad);
  const WeightsAlongCurve along(places, weights);
  const std::int64_t cells = comm.sum(std::ssize(places));
  const std::vector<Place> splits = Splits(comm, along, parts).find(cells);
  const auto part_of = [&](const Place& place) {
    return static_cast<std::int32_t>(std::ranges::lower_bound(splits, place) - splits.begin());
  };
  CellParts of{parts, {}, {}};
  const auto quads_begin = places.begin() + std::ssize(mesh.triangles);
  std::transform(places.begin(), quads_begin, std::back_inserter(of.triangles), part_of);
  std::transform(quads_begin, places.end(), std::back_inserter(of.quads), part_of);
  return of;
}

}  // namespace

CellParts partition(const Communicator& comm, const Mesh& mesh, std::int32_t parts) {
  QUADLOOP_REQUIRE(parts > 0, "a mesh is divided into no parts", parts);
  const std::int64_t triangles = comm.sum(std::ssize(mesh.triangles)),
                     quads = comm.sum(std::ssize(mesh.quads)), cells = triangles + quads;
  if (cells < parts)
    throw InputError(std::to_string(parts) + " partitions are requested of a mesh of " +
                     std::to_string(cells) + " cells; request at most one partition for each cell");
  if (parts == 1)
    return {parts, std::vector<std::int32_t>(mesh.triangles.size(), 0),
            std::vector<std::int32_t>(mesh.quads.size(), 0)};
  // If a part were smaller than one cell, some would be empty: then all cells count equally.
  const bool weighed = 3 * triangles + quad_weight * quads >= quad_weight * parts;
  PartWeights weights;
  if (!weighed) weights.of_triangle = weights.of_quad = 1;
  const std::int64_t all = weights.of_triangle * triangles + weights.of_quad * quads;
  weights.most = std::max(103 * all / (100 * parts), all / parts + weights.of_quad);
  weights.least = std::max<std::int64_t>(
      1, std::min((97 * all + 100 * parts - 1) / (100 * parts), all / parts - weights.of_quad));
  CellParts of = along_curve(comm, mesh, weights, parts);
  refine_parts(comm, mesh, weights, of);
  return of;
}

}  // namespace quadloop
