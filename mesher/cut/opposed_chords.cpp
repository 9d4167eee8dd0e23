#include "mesher/cut/opposed_chords.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "mesher/base/mixed_bits.hpp"
#include "mesher/base/parallel/exchange.hpp"
#include "mesher/forest/leaf_finder.hpp"

namespace quadloop {

namespace {

struct SideChord {
  Point low, high;     ///< its ends, in ascending order
  bool rising = true;  ///< whether it is directed from low to high
  bool between_blocks = false;
  friend auto operator<=>(const SideChord&, const SideChord&) = default;
};

/// Equal for chords with the same ends.
std::uint64_t hash_of(const SideChord& chord) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };  // -0.0 becomes 0.0
  return mixed_bits(bits(chord.low.x) ^ std::rotl(bits(chord.low.y), 16) ^ std::rotl(bits(chord.high.x), 32) ^
                    std::rotl(bits(chord.high.y), 48));
}

/// Removes most chords of the outer boundary without an opposite one, which is faster than sorting all.
void drop_single(std::vector<SideChord>& chords) {
  constexpr std::size_t slots_of_chord = 4;
  const std::size_t mask = std::bit_ceil(slots_of_chord * chords.size() + 1) - 1;
  std::vector<std::uint8_t> seen(mask + 1, 0);  // by hash, one bit per direction
  for (const SideChord& c : chords) seen[hash_of(c) & mask] |= c.rising ? 1 : 2;
  std::erase_if(chords,
                [&](const SideChord& c) { return !c.between_blocks && seen[hash_of(c) & mask] != 3; });
}

/// Returns the leaves across a side.
std::array<LeafId, 2> across(LeafFinder& finder, LeafId leaf, Side side) {
  const Quadrant& q = finder.graph().leaf(leaf);
  const std::int64_t last = q.size() - 1;
  const std::int64_t beyond = q.line(side) - (side == Side::left || side == Side::bottom ? 1 : 0);
  if (is_vertical(side)) return {finder.leaf_at(beyond, q.y), finder.leaf_at(beyond, q.y + last)};
  return {finder.leaf_at(q.x, beyond), finder.leaf_at(q.x + last, beyond)};
}

/// Flags the local leaves with a ghost leaf across a side: few, found from the ghosts.
std::vector<char> leaves_beside_ghosts(LeafFinder& finder) {
  const LeafGraph& graph = finder.graph();
  std::vector<char> flags(graph.local_size(), 0);
  const auto flag_beside = [&](LeafId ghost) {
    for (const Side side : all_sides) {
      for (const LeafId other : across(finder, ghost, side)) {
        if (other != LeafGraph::none && graph.is_local(other)) flags[graph.local_index(other)] = 1;
      }
    }
  };
  std::ranges::for_each(ids_below(graph.from_local(0)), flag_beside);
  std::ranges::for_each(ids_between(graph.from_local(graph.local_size()), LeafId{graph.size()}), flag_beside);
  return flags;
}

}  // namespace

OpposedChords::OpposedChords(const Communicator& comm, const Geometry& geometry, const LeafGraph& graph,
                             const CutForest& cut) {
  std::vector<SideChord> chords, own;
  Outbox<SideChord> out;
  LeafFinder finder(graph);
  const std::vector<char> beside_ghosts = leaves_beside_ghosts(finder);
  for (const LeafId leaf : graph.local()) {
    const std::int32_t e = cut.entry_of[graph.local_index(leaf)];
    if (e < 0) continue;
    const CutForest::Entry& entry = cut.entries[e];
    for (const CutLeaf::Edge& edge : CutForest::part(cut.outline, entry.begin.outline, entry.end.outline)) {
      const auto& from = cut.nodes[entry.begin.nodes + edge.from];
      const auto& to = cut.nodes[entry.begin.nodes + edge.to];
      const SideSet common = sides_of(from.site) & sides_of(to.site);
      if (common.empty()) continue;
      const bool rising = from.position < to.position;
      const SideChord chord{rising ? from.position : to.position, rising ? to.position : from.position,
                            rising, geometry.twin(edge.segment) >= 0};
      chords.push_back(chord);
      if (chord.between_blocks) own.push_back(chord);
      if (beside_ghosts[graph.local_index(leaf)] == 0) continue;
      for (const Side side : all_sides) {
        if (!common.contains(side)) continue;
        for (const LeafId other : across(finder, leaf, side)) {
          if (other != LeafGraph::none && !graph.is_local(other)) out.add(graph.owner_of(other).rank, chord);
        }
      }
    }
  }
  const auto received = out.deliver(comm);
  chords.insert(chords.end(), received.begin(), received.end());
  drop_single(chords);
  std::sort(chords.begin(), chords.end());
  for (std::size_t i = 0; i + 1 < chords.size(); ++i) {
    const SideChord &a = chords[i], &b = chords[i + 1];
    if (a.low != b.low || a.high != b.high || a.rising == b.rising || a.between_blocks) continue;
    ends_.push_back(a.low);
    ends_.push_back(a.high);
  }
  for (const SideChord& chord : own) {
    SideChord opposite = chord;
    opposite.rising = !chord.rising;
    if (std::ranges::binary_search(chords, opposite)) continue;
    sides_differ_ = true;
    ends_.push_back(chord.low);
    ends_.push_back(chord.high);
  }
  std::sort(ends_.begin(), ends_.end());
  ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
}

}  // namespace quadloop
