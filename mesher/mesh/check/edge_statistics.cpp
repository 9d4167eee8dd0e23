#include "mesher/mesh/check/edge_statistics.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "mesher/base/parallel/exchange.hpp"
#include "mesher/base/parallel/kth_smallest.hpp"
#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/check/cell_pairs.hpp"
#include "mesher/mesh/check/quality.hpp"

namespace quadloop {

namespace {

/// One of the two cells at an edge.
struct CellAtEdge {
  const NodeId* nodes;
  double area;
  std::int32_t number;  ///< as HaloMesh::for_each_cell() visits the cells
  std::int32_t width;

  /// Returns which node of the cell the directed edge begins at; -1 if the cell is not to its left.
  std::int32_t side(NodeId from, NodeId to) const {
    for (std::int32_t k = 0; k < width; ++k) {
      if (nodes[k] == from && nodes[(k + 1) % width] == to) return k;
    }
    return -1;
  }
};

double area_of_cell(const std::array<Point, 3>& p) { return cross(p[1] - p[0], p[2] - p[0]) / 2; }
double area_of_cell(const std::array<Point, 4>& p) { return cross(p[2] - p[0], p[3] - p[1]) / 2; }

/// The first edge, in the order of the cells, with the largest ratio.
struct LargestRatio {
  double ratio = 0;
  std::int64_t cell = std::numeric_limits<std::int64_t>::max();
  std::int32_t side = 0;
  Point place;

  bool is_before(const LargestRatio& other) const {
    return std::tuple(-ratio, cell, side) < std::tuple(-other.ratio, other.cell, other.side);
  }
};

/// Sets of connected cells, each named by its first cell.
class CellSets {
 public:
  explicit CellSets(std::size_t cells) : first_(cells) { std::iota(first_.begin(), first_.end(), 0); }

  std::int32_t first_of(std::int32_t cell) {
    while (first_[cell] != cell) cell = first_[cell] = first_[first_[cell]];
    return cell;
  }
  void join(std::int32_t a, std::int32_t b) {
    const auto [first, second] = std::minmax({first_of(a), first_of(b)});
    first_[second] = first;
  }

 private:
  std::vector<std::int32_t> first_;
};

/// The cells of one region on one rank, or a whole region.
struct RegionPart {
  std::int64_t name;                    ///< parts with the same name are connected
  std::int64_t cells = 0, regions = 1;  ///< regions: number of closed ones, of which this is the smallest
  std::int64_t first = std::numeric_limits<std::int64_t>::max();  ///< its first cell
  Point place = {};

  bool is_smaller(const RegionPart& other) const {
    return std::pair(cells, first) < std::pair(other.cells, other.first);
  }
};

using Link = std::array<std::int64_t, 2>;  ///< names of connected parts

/// Joins the parts of all ranks; the result has all closed regions.
MeshRegions join_parts(const std::vector<RegionPart>& parts, const std::vector<RegionPart>& closed,
                       const std::vector<Link>& links) {
  std::map<std::int64_t, std::int32_t> numbers;
  const auto number_of = [&](std::int64_t name) {
    return numbers.emplace(name, static_cast<std::int32_t>(numbers.size())).first->second;
  };
  for (const RegionPart& part : parts) number_of(part.name);
  for (const auto& [a, b] : links) std::ignore = std::pair(number_of(a), number_of(b));
  CellSets sets(numbers.size());
  for (const auto& [a, b] : links) sets.join(number_of(a), number_of(b));
  std::map<std::int32_t, RegionPart> regions;
  for (const RegionPart& part : parts) {
    const auto [region, is_new] = regions.emplace(sets.first_of(number_of(part.name)), part);
    if (is_new) continue;
    RegionPart& whole = region->second;
    whole.cells += part.cells;
    if (part.first < whole.first) std::tie(whole.first, whole.place) = std::tuple(part.first, part.place);
  }
  std::vector<RegionPart> all = closed;
  for (const auto& [number, region] : regions) all.push_back(region);
  if (all.empty()) return {};
  const RegionPart& smallest = *std::min_element(
      all.begin(), all.end(), [](const RegionPart& a, const RegionPart& b) { return a.is_smaller(b); });
  MeshRegions result{0, smallest.cells, smallest.place};
  for (const RegionPart& region : all) result.count += region.regions;
  return result;
}

/// The regions of a distributed mesh, from the sets of cells that each rank sees connected.
class RegionSearch {
 public:
  /// `numbers` are the global numbers of the cells of the HaloMesh. *Collective.*
  RegionSearch(const Communicator& comm, const Mesh& mesh, const HaloMesh& halo,
               const std::vector<std::int64_t>& numbers, CellSets& sets)
      : comm_{comm}, mesh_{mesh}, halo_{halo}, numbers_{numbers}, sets_{sets}, owners_(comm, mesh) {}

  /// *Collective.*
  MeshRegions find() {
    flag_open_sets();
    count_own_cells();
    std::vector<RegionPart> parts, closed;
    for (const auto& [set, part] : parts_) {
      if (is_open_[set] != 0)
        parts.push_back(part);
      else if (closed.empty())
        closed.push_back(part);
      else
        add_closed(part, closed.front());
    }
    parts = gather_at_root(comm_, parts);
    closed = gather_at_root(comm_, closed);
    const std::vector<Link> links = gather_at_root(comm_, links_to_others());
    std::vector<MeshRegions> regions;
    if (comm_.is_root()) regions = {join_parts(parts, closed, links)};
    comm_.broadcast(regions);
    return regions.front();
  }

 private:
  bool is_own(std::size_t cell) const { return owners_.rank_of(numbers_[cell]) == comm_.rank(); }

  static void add_closed(const RegionPart& part, RegionPart& closed) {
    const std::int64_t regions = closed.regions + 1;
    if (part.is_smaller(closed)) closed = part;
    closed.regions = regions;
  }

  /// A set is open if other ranks see some of its cells.
  void flag_open_sets() {
    is_open_.assign(numbers_.size(), 0);
    std::int32_t cell = 0;
    halo_.for_each_cell([&](const auto& nodes) {
      if (!std::ranges::all_of(nodes, [&](NodeId node) { return halo_.owns(node); }))
        is_open_[sets_.first_of(cell)] = 1;
      ++cell;
    });
  }

  void count_own_cells() {
    std::int32_t cell = 0, last = -1;
    RegionPart* part = nullptr;  // neighbours in the order of the cells are mostly of one region
    halo_.for_each_cell([&](const auto& nodes) {
      const std::int32_t number = cell++;
      if (!is_own(number)) return;
      const std::int32_t set = sets_.first_of(number);
      if (part == nullptr || set != last)
        part = &parts_.emplace(set, RegionPart{numbers_[set]}).first->second;
      last = set;
      if (part->cells++ > 0) return;
      part->first = numbers_[number];
      part->place = halo_.point(nodes[0]);
    });
  }

  /// *Collective.*
  std::vector<Link> links_to_others() {
    std::vector<std::int64_t> names(mesh_.cell_count());
    for (std::size_t cell = 0; cell < numbers_.size(); ++cell) {
      if (is_own(cell))
        names[owners_.local(numbers_[cell])] = numbers_[sets_.first_of(static_cast<std::int32_t>(cell))];
    }
    const std::vector<std::int64_t> theirs = halo_.spread(comm_, names);
    std::vector<Link> links;
    for (std::size_t cell = 0; cell < theirs.size(); ++cell) {
      const std::int64_t name = numbers_[sets_.first_of(static_cast<std::int32_t>(cell))];
      if (name != theirs[cell] && (links.empty() || links.back() != Link{name, theirs[cell]}))
        links.push_back({name, theirs[cell]});
    }
    std::ranges::sort(links);
    links.erase(std::unique(links.begin(), links.end()), links.end());
    return links;
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  const HaloMesh& halo_;
  const std::vector<std::int64_t>& numbers_;
  CellSets& sets_;
  CellOwners owners_;
  std::vector<char> is_open_;
  std::map<std::int32_t, RegionPart> parts_;  ///< by the first cell of the set
};

/// *Collective.*
std::vector<std::int64_t> cell_numbers(const Communicator& comm, const Mesh& mesh, const HaloMesh& halo) {
  const CellOwners owners(comm, mesh);
  std::vector<std::int64_t> own(mesh.cell_count());
  for (std::size_t cell = 0; cell < own.size(); ++cell)
    own[cell] = owners.number(static_cast<std::int64_t>(cell));
  return halo.spread(comm, own);
}

/// Returns the block of each cell of the HaloMesh; empty if there is one block. *Collective.*
std::vector<std::int32_t> spread_blocks(const Communicator& comm, const Mesh& mesh, const HaloMesh& halo,
                                        const CellBlocks& blocks) {
  if (blocks.count == 1) return {};
  std::vector<std::int32_t> own(mesh.cell_count());
  for (std::size_t cell = 0; cell < own.size(); ++cell) own[cell] = blocks.of(cell);
  return halo.spread(comm, own);
}

/// Nodes of this rank from which more than one edge of the boundary starts.
std::int64_t count_pinched(const HaloMesh& halo, const std::vector<OneSidedEdge>& edges) {
  std::vector<NodeId> starts;
  for (const OneSidedEdge& edge : edges) {
    if (halo.owns(edge.from)) starts.push_back(edge.from);
  }
  std::ranges::sort(starts);
  std::int64_t count = 0;
  for (auto node = starts.begin(); node != starts.end();) {
    const auto end = std::upper_bound(node, starts.end(), *node);
    count += end - node > 1 ? 1 : 0;
    node = end;
  }
  return count;
}

/// One visit of all edges.
class EdgeSurvey {
 public:
  /// *Collective.*
  EdgeSurvey(const Communicator& comm, const Mesh& mesh, const HaloMesh& halo, const CellBlocks& blocks)
      : comm_{comm},
        mesh_{mesh},
        halo_{halo},
        numbers_{cell_numbers(comm, mesh, halo)},
        blocks_{spread_blocks(comm, mesh, halo, blocks)},
        sets_{numbers_.size()} {
    CellPairs<CellAtEdge> pairs(halo, [](NodeId) { return true; });
    pairs.for_each(
        [&](const auto& nodes, std::int32_t number) {
          return CellAtEdge{nodes.data(), area_of_cell(corners_of(halo, nodes)), number, size32(nodes)};
        },
        [&](NodeId from, NodeId to, const CellAtEdge& cell, const CellAtEdge& other) {
          sets_.join(cell.number, other.number);
          if (!halo.owns(to) && halo.global(to) < halo.global(from)) return;  // counted by the other rank
          add_pair(from, to, cell, other);
        });
    pairs.for_each_single([&](NodeId a, NodeId b, const CellAtEdge& cell) { add_single(a, b, cell); });
  }

  /// *Collective.*
  EdgeStatistics statistics() {
    EdgeStatistics statistics;
    statistics.ratios = ratios();
    ratios_ = {};
    statistics.between_blocks = comm_.sum(between_blocks_);
    statistics.pinched_nodes = comm_.sum(count_pinched(halo_, one_sided_));
    statistics.regions = RegionSearch(comm_, mesh_, halo_, numbers_, sets_).find();
    statistics.one_sided = std::move(one_sided_);
    return statistics;
  }

  /// *Collective.*
  AreaRatios ratios() {
    const std::int64_t equal = comm_.sum(equal_), count = equal + comm_.sum(std::ssize(ratios_));
    if (count == 0) return {};
    LargestRatio largest;
    for (const LargestRatio& found : comm_.all_gather(largest_)) {
      if (found.is_before(largest)) largest = found;
    }
    const std::int64_t rank = (count * 99 + 99) / 100;  // of the smallest value that 99 % do not exceed
    return {largest.ratio, rank <= equal ? 1 : kth_smallest(comm_, ratios_, rank - equal), largest.place};
  }

 private:
  /// `from` has the lower global number.
  void add_pair(NodeId from, NodeId to, const CellAtEdge& cell, const CellAtEdge& other) {
    const double ratio = area_ratio(cell.area, other.area);
    if (ratio == 1)
      ++equal_;
    else
      ratios_.push_back(ratio);
    if (!blocks_.empty() && blocks_[cell.number] != blocks_[other.number]) ++between_blocks_;
    if (ratio < largest_.ratio) return;
    const std::int32_t side = cell.side(from, to);
    const CellAtEdge& left = side >= 0 ? cell : other;
    const LargestRatio here{ratio, numbers_[left.number], side >= 0 ? side : other.side(from, to),
                            0.5 * (halo_.point(from) + halo_.point(to))};
    if (here.is_before(largest_)) largest_ = here;
  }

  void add_single(NodeId a, NodeId b, const CellAtEdge& cell) {
    const std::int32_t side = cell.side(a, b);
    const std::int64_t number = numbers_[cell.number];
    one_sided_.push_back(side >= 0 ? OneSidedEdge{a, b, number, side}
                                   : OneSidedEdge{b, a, number, cell.side(b, a)});
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  const HaloMesh& halo_;
  std::vector<std::int64_t> numbers_;
  std::vector<std::int32_t> blocks_;
  CellSets sets_;
  std::int64_t equal_ = 0;      ///< edges between cells of one area
  std::vector<double> ratios_;  ///< at the other edges
  LargestRatio largest_;
  std::int64_t between_blocks_ = 0;
  std::vector<OneSidedEdge> one_sided_;
};

}  // namespace

EdgeStatistics edge_statistics(const Communicator& comm, const Mesh& mesh, const HaloMesh& halo,
                               const CellBlocks& blocks) {
  return EdgeSurvey(comm, mesh, halo, blocks).statistics();
}

AreaRatios area_ratios(const Communicator& comm, const Mesh& mesh) {
  const HaloMesh halo(comm, mesh);
  return EdgeSurvey(comm, mesh, halo, {}).ratios();
}

}  // namespace quadloop
