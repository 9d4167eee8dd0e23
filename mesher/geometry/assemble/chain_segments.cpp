#include "mesher/geometry/assemble/chain_segments.hpp"

#include <algorithm>
#include <map>
#include <ranges>
#include <utility>

namespace quadloop {

namespace {

bool is_same(const CurvedSegment& a, const CurvedSegment& b) {
  return a.from == b.from && a.to == b.to && a.curve == b.curve;
}

void find_equals(std::vector<ChainSegment>& segments) {
  std::map<std::pair<Point, Point>, std::vector<std::int32_t>> firsts;
  for (std::int32_t i = 0; i < size32(segments); ++i) {
    ChainSegment& s = segments[i];
    s.first_equal = i;
    if (s.segment.curve.straight()) continue;
    std::vector<std::int32_t>& known = firsts[std::minmax(s.segment.from, s.segment.to)];
    for (const std::int32_t k : known) {
      const CurvedSegment& first = segments[k].segment;
      s.is_reverse = is_same(first, reversed(s.segment));
      if (!s.is_reverse && !is_same(first, s.segment)) continue;
      s.first_equal = k;
      break;
    }
    if (s.first_equal == i) known.push_back(i);
  }
}

}  // namespace

std::vector<ChainSegment> segments_of(const std::vector<Chain>& chains) {
  std::vector<ChainSegment> segments;
  for (std::size_t c = 0; c < chains.size(); ++c) {
    const Chain& chain = chains[c];
    const std::size_t count = chain.points.size() - (chain.open ? 1 : 0);
    for (std::size_t s = 0; s < count; ++s) {
      const Curve curve = chain.curves.empty() ? Curve{} : chain.curves[s];
      segments.push_back({c, s, {chain.points[s], curve, chain.points[(s + 1) % chain.points.size()]}});
    }
  }
  find_equals(segments);
  return segments;
}

void replace_segments(std::vector<Chain>& chains, std::span<const ChainSegment> segments,
                      std::span<const std::vector<CurvedSegment>> pieces) {
  for (Chain& chain : chains) {
    if (chain.open && chain.points.size() < 2) continue;
    chain.points.clear();
    chain.curves.clear();
  }
  const auto append = [](const CurvedSegment& piece, Chain& chain) {
    if (chain.curves.empty()) chain.points.push_back(piece.from);
    chain.points.push_back(piece.to);
    chain.curves.push_back(piece.curve);
  };
  for (const ChainSegment& s : segments) {
    Chain& chain = chains[s.chain];
    const std::vector<CurvedSegment>& of_first = pieces[s.first_equal];
    if (s.is_reverse) {
      for (const CurvedSegment& piece : std::views::reverse(of_first)) append(reversed(piece), chain);
    } else {
      for (const CurvedSegment& piece : of_first) append(piece, chain);
    }
  }
  for (Chain& chain : chains) {
    if (!chain.open) chain.points.pop_back();
    if (std::ranges::all_of(chain.curves, &Curve::straight)) chain.curves.clear();
  }
}

}  // namespace quadloop
