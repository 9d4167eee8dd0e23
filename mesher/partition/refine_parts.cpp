#include "mesher/partition/refine_parts.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "mesher/base/parallel/exchange.hpp"
#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"
#include "mesher/partition/part_sides.hpp"
#include "mesher/partition/refine_sides.hpp"

namespace quadloop {

namespace {

constexpr int most_rounds = 8;
/// Maximum distance, in cells, of a movable cell from the interface of two parts.
constexpr std::int32_t band = 32;
/// The last round is that which lowers the cut by less than 1 / least_share.
constexpr std::int64_t least_share = 100;

/// Two parts with common edges, the lower one first.
struct Pair {
  std::int32_t first = 0, second = 0;
  friend auto operator<=>(const Pair&, const Pair&) = default;
};

/// A cell near the interface of two parts, sent to the rank that works on them.
struct BandCell {
  Pair pair;
  std::int64_t number = 0;
  std::int32_t weight = 0, part = 0;
  std::array<std::int64_t, 4> across = {EdgeCells::none, EdgeCells::none, EdgeCells::none, EdgeCells::none};
  std::array<std::int32_t, 4> parts_across = {-1, -1, -1, -1};
};

struct Move {
  std::int64_t number = 0;
  std::int32_t part = 0;
};

struct NewWeight {
  std::int32_t part = 0;
  std::int64_t weight = 0;
};

/// Neighbour graph of this rank's cells, followed by adjacent cells of other ranks; updates values of the
/// latter.
class CellGraph {
 public:
  CellGraph(const Communicator& comm, const Mesh& mesh)
      : owners_(comm, mesh),
        triangles_{std::ssize(mesh.triangles)},
        own_{triangles_ + std::ssize(mesh.quads)} {
    const std::vector<std::int64_t> across = edge_cells(comm, mesh).across;
    std::vector<std::int64_t> foreign;
    for (const std::int64_t cell : across) {
      if (cell != EdgeCells::none && owners_.rank_of(cell) != comm.rank()) foreign.push_back(cell);
    }
    std::ranges::sort(foreign);
    foreign.erase(std::ranges::unique(foreign).begin(), foreign.end());
    for (const std::int64_t cell : across) beside_.push_back(local(comm, cell, foreign));
    std::vector<int> ranks;
    for (const std::int64_t cell : foreign) ranks.push_back(owners_.rank_of(cell));
    exchange_.emplace(comm, ranks);
    for (const std::int64_t cell : exchange_->deliver(foreign)) asked_.push_back(owners_.local(cell));
    foreign_ = std::move(foreign);
    for (std::int64_t cell = 0; cell < own_; ++cell) {
      for (const std::int64_t other : beside(cell)) {
        if (other >= own_) own_beside_.emplace_back(other, cell);
      }
    }
    std::ranges::sort(own_beside_);
  }

  std::int64_t own() const { return own_; }
  std::int64_t all() const { return own_ + std::ssize(foreign_); }
  std::int64_t triangles() const { return triangles_; }
  const CellOwners& owners() const { return owners_; }
  std::int64_t number(std::int64_t cell) const {
    return cell < own_ ? owners_.number(cell) : foreign_[cell - own_];
  }
  /// Neighbours of one of this rank's cells across each of its edges; -1: none.
  std::span<const std::int64_t> beside(std::int64_t cell) const {
    const bool is_triangle = cell < triangles_;
    const std::int64_t begin = is_triangle ? 3 * cell : 3 * triangles_ + 4 * (cell - triangles_);
    return std::span(beside_).subspan(begin, is_triangle ? 3 : 4);
  }
  /// Pairs of another rank's cell and an adjacent cell of this rank.
  std::span<const std::pair<std::int64_t, std::int64_t>> own_beside() const { return own_beside_; }

  /// Fetches the values of other ranks' cells. *Collective.*
  void update(std::vector<std::int32_t>& values) const {
    std::vector<std::int32_t> answers;
    answers.reserve(asked_.size());
    for (const std::int64_t cell : asked_) answers.push_back(values[cell]);
    std::ranges::copy(exchange_->answer(answers), values.begin() + own_);
  }

 private:
  std::int64_t local(const Communicator& comm, std::int64_t number,
                     const std::vector<std::int64_t>& foreign) const {
    if (number == EdgeCells::none) return -1;
    if (owners_.rank_of(number) == comm.rank()) return owners_.local(number);
    return own_ + (std::ranges::lower_bound(foreign, number) - foreign.begin());
  }

  CellOwners owners_;
  std::int64_t triangles_, own_;
  std::vector<std::int64_t> beside_, foreign_, asked_;
  std::vector<std::pair<std::int64_t, std::int64_t>> own_beside_;
  std::optional<Exchange> exchange_;
};

/// Returns the cells near the interface of two parts that change sides. `cells` are in the order of their
/// numbers.
std::vector<Move> refined_pair(std::span<const BandCell> cells, SideWeights& weights) {
  WeightedGraph graph;
  const Pair pair = cells.front().pair;
  for (const BandCell& cell : cells) {
    graph.weights.push_back(cell.weight);
    graph.sides.push_back(cell.part == pair.second ? 1 : 0);
    auto& fixed = graph.fixed.emplace_back();
    graph.starts.push_back(std::ssize(graph.neighbours));
    for (std::size_t k = 0; k < cell.across.size(); ++k) {
      const auto found = std::ranges::lower_bound(cells, cell.across[k], {}, &BandCell::number);
      if (found != cells.end() && found->number == cell.across[k]) {
        graph.neighbours.push_back({static_cast<std::int32_t>(found - cells.begin()), 1});
      } else if (cell.parts_across[k] == pair.first || cell.parts_across[k] == pair.second) {
        ++fixed[cell.parts_across[k] == pair.second ? 1 : 0];
      }
    }
  }
  graph.starts.push_back(std::ssize(graph.neighbours));
  refine_sides(graph, weights);
  std::vector<Move> moves;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::int32_t part = graph.sides[i] == 1 ? pair.second : pair.first;
    if (part != cells[i].part) moves.push_back({cells[i].number, part});
  }
  return moves;
}

class PartRefiner {
 public:
  PartRefiner(const Communicator& comm, const Mesh& mesh, const PartWeights& weights, const CellParts& cells)
      : comm_{comm}, weights_{weights}, parts_{cells.parts}, graph_(comm, mesh) {
    part_of_ = cells.triangles;
    part_of_.insert(part_of_.end(), cells.quads.begin(), cells.quads.end());
    part_of_.resize(graph_.all());
    graph_.update(part_of_);
    sum_up();
  }

  void run() {
    for (int round = 0; round < most_rounds; ++round) {
      const std::int64_t before = cut();
      for (const std::vector<Pair>& pairs : colours()) refine(pairs);
      if ((before - cut()) * least_share < before) break;
    }
  }

  const std::vector<std::int32_t>& parts() const { return part_of_; }

 private:
  std::int64_t weight_of(std::int64_t cell) const {
    return cell < graph_.triangles() ? weights_.of_triangle : weights_.of_quad;
  }

  void sum_up() {
    std::vector<std::int64_t> own(parts_, 0);
    for (std::int64_t cell = 0; cell < graph_.own(); ++cell) own[part_of_[cell]] += weight_of(cell);
    std::vector<NewWeight> sums;
    for (std::int32_t part = 0; part < parts_; ++part) {
      if (own[part] > 0) sums.push_back({part, own[part]});
    }
    weight_of_part_.assign(parts_, 0);
    for (const auto& [part, weight] : comm_.all_gather_values(std::span<const NewWeight>(sums)))
      weight_of_part_[part] += weight;
  }

  /// Returns the number of edges between two parts, over all ranks.
  std::int64_t cut() const {
    std::int64_t sides = 0;
    for (std::int64_t cell = 0; cell < graph_.own(); ++cell) {
      for (const std::int64_t other : graph_.beside(cell))
        sides += other >= 0 && part_of_[other] != part_of_[cell] ? 1 : 0;
    }
    return comm_.sum(sides) / 2;
  }

  /// Groups all pairs of neighbouring parts such that no part occurs twice in a group; the same on all ranks.
  std::vector<std::vector<Pair>> colours() const {
    std::vector<Pair> pairs;
    for (std::int64_t cell = 0; cell < graph_.own(); ++cell) {
      for (const std::int64_t other : graph_.beside(cell)) {
        if (other < 0 || part_of_[other] == part_of_[cell]) continue;
        const auto [first, second] = std::minmax(part_of_[cell], part_of_[other]);
        pairs.push_back({first, second});
      }
    }
    const auto tidy = [](std::vector<Pair>& rows) {
      std::ranges::sort(rows);
      rows.erase(std::ranges::unique(rows).begin(), rows.end());
    };
    tidy(pairs);
    pairs = comm_.all_gather_values(std::span<const Pair>(pairs));
    tidy(pairs);
    std::vector<std::vector<Pair>> colours;
    std::vector<std::vector<char>> is_in;  // for each colour: whether a part is in it
    for (const Pair& pair : pairs) {
      std::size_t colour = 0;
      while (colour < colours.size() && (is_in[colour][pair.first] != 0 || is_in[colour][pair.second] != 0))
        ++colour;
      if (colour == colours.size()) {
        colours.emplace_back();
        is_in.emplace_back(parts_, 0);
      }
      colours[colour].push_back(pair);
      is_in[colour][pair.first] = is_in[colour][pair.second] = 1;
    }
    return colours;
  }

  /// Refines pairs that have no part in common.
  void refine(const std::vector<Pair>& pairs) {
    partner_.assign(parts_, -1);
    for (const Pair& pair : pairs) {
      partner_[pair.first] = pair.second;
      partner_[pair.second] = pair.first;
    }
    std::vector<BandCell> cells = deliver_band();
    std::ranges::sort(cells, {}, [](const BandCell& cell) { return std::pair(cell.pair, cell.number); });
    Outbox<Move> moves;
    std::vector<NewWeight> changed;
    for (auto begin = cells.begin(); begin != cells.end();) {
      const Pair pair = begin->pair;
      const auto end = std::find_if(begin, cells.end(), [&](const BandCell& c) { return c.pair != pair; });
      SideWeights weights{
          {weight_of_part_[pair.first], weight_of_part_[pair.second]}, weights_.least, weights_.most};
      for (const Move& move : refined_pair(std::span(begin, end), weights))
        moves.add(graph_.owners().rank_of(move.number), move);
      changed.push_back({pair.first, weights.sides[0]});
      changed.push_back({pair.second, weights.sides[1]});
      begin = end;
    }
    for (const Move& move : moves.deliver(comm_)) part_of_[graph_.owners().local(move.number)] = move.part;
    graph_.update(part_of_);
    for (const auto& [part, weight] : comm_.all_gather_values(std::span<const NewWeight>(changed)))
      weight_of_part_[part] = weight;
  }

  std::vector<BandCell> deliver_band() const {
    Outbox<BandCell> out;
    for (const std::int64_t cell : cells_in_band()) {
      const auto [first, second] = std::minmax(part_of_[cell], partner_[part_of_[cell]]);
      BandCell row{.pair = {first, second},
                   .number = graph_.number(cell),
                   .weight = static_cast<std::int32_t>(weight_of(cell)),
                   .part = part_of_[cell]};
      std::size_t k = 0;
      for (const std::int64_t other : graph_.beside(cell)) {
        if (other < 0) continue;
        row.across[k] = graph_.number(other);
        row.parts_across[k++] = part_of_[other];
      }
      out.add(rank_of_part(comm_, first, parts_), row);
    }
    return out.deliver(comm_);
  }

  /// Returns this rank's cells within `band` cells of the interface between their part and its partner.
  std::vector<std::int64_t> cells_in_band() const {
    std::vector<std::int32_t> distance(graph_.all(), -1);
    std::vector<std::int64_t> found;
    for (std::int64_t cell = 0; cell < graph_.own(); ++cell) {
      const std::int32_t partner = partner_[part_of_[cell]];
      const bool at_line = partner >= 0 && std::ranges::any_of(graph_.beside(cell), [&](std::int64_t other) {
                             return other >= 0 && part_of_[other] == partner;
                           });
      if (!at_line) continue;
      distance[cell] = 0;
      found.push_back(cell);
    }
    std::size_t begin = 0;
    for (std::int32_t d = 1; d <= band; ++d) {
      const std::size_t end = found.size();
      const auto reach = [&](std::int64_t from, std::int64_t cell) {
        if (distance[cell] >= 0 || part_of_[cell] != part_of_[from]) return;
        distance[cell] = d;
        found.push_back(cell);
      };
      for (std::size_t i = begin; i < end; ++i) {
        for (const std::int64_t other : graph_.beside(found[i])) {
          if (other >= 0 && other < graph_.own()) reach(found[i], other);
        }
      }
      graph_.update(distance);
      for (const auto& [other, cell] : graph_.own_beside()) {
        if (distance[other] == d - 1) reach(other, cell);
      }
      begin = end;
    }
    return found;
  }

  const Communicator& comm_;
  const PartWeights& weights_;
  std::int32_t parts_;
  CellGraph graph_;
  std::vector<std::int32_t> part_of_;  ///< of this rank's cells and their neighbours
  std::vector<std::int32_t> partner_;  ///< partner of each part in the current group; -1: none
  std::vector<std::int64_t> weight_of_part_;
};

}  // namespace

void refine_parts(const Communicator& comm, const Mesh& mesh, const PartWeights& weights, CellParts& cells) {
  PartRefiner refiner(comm, mesh, weights, cells);
  refiner.run();
  const auto quads = refiner.parts().begin() + std::ssize(cells.triangles);
  std::copy(refiner.parts().begin(), quads, cells.triangles.begin());
  std::copy_n(quads, cells.quads.size(), cells.quads.begin());
}

}  // namespace quadloop
