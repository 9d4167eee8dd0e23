#include "adapt/morph/outline_pieces.hpp"

#include <algorithm>
#include <utility>

#include "mesher/geometry/curve.hpp"

namespace quadloop::adapt {

namespace {

bool correspond(const Chain& a, const Chain& b) {
  return a.name == b.name && a.open == b.open && a.points.size() == b.points.size();
}

void reverse(Chain& chain) {
  std::ranges::reverse(chain.points);
  std::ranges::reverse(chain.curves);
  for (Curve& curve : chain.curves) curve = reversed(curve);
}

/// The boundaries of the chains by name; the first, without a name, is that of closing segments.
std::vector<Boundary> boundaries_of(const std::vector<Chain>& chains) {
  std::vector<Boundary> boundaries(1);
  for (const Chain& chain : chains) {
    if (std::ranges::find(boundaries, chain.name, &Boundary::name) != boundaries.end()) continue;
    boundaries.emplace_back().name = chain.name;
  }
  return boundaries;
}

Geometry as_loops(const std::vector<Chain>& chains) {
  const std::vector<Boundary> boundaries = boundaries_of(chains);
  GeometryBuilder builder;
  for (const Chain& chain : chains) {
    const auto own = std::ranges::find(boundaries, chain.name, &Boundary::name) - boundaries.begin();
    for (std::size_t i = 0; i < chain.points.size(); ++i) {
      const bool closes = chain.open && i + 1 == chain.points.size();
      builder.add(chain.points[i], BoundaryId{closes ? 0 : static_cast<std::int32_t>(own)},
                  closes || chain.curves.empty() ? Curve{} : chain.curves[i]);
    }
    builder.end_loop();
  }
  return std::move(builder).geometry(boundaries);
}

}  // namespace

std::optional<OutlinePieces> pieces_of(std::vector<Chain> from, std::vector<Chain> to) {
  if (!std::ranges::equal(from, to, correspond)) return {};
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (!from[i].open || from[i].points.front() < from[i].points.back()) continue;
    reverse(from[i]);
    reverse(to[i]);
  }
  return OutlinePieces{as_loops(from), as_loops(to)};
}

}  // namespace quadloop::adapt
