#include "mesher/cut/cut_forest.hpp"

#include <sstream>

#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

Point centre_of(const Lattice& lattice, const Quadrant& q) { return lattice.corner(q.x + q.size() / 2, q.y + q.size() / 2); }

class ForestCutter {
 public:
  ForestCutter(const LeafGraph& graph, SizeTree& sizes, const ShiftedOutline& outline, const InsideTest& inside)
      : graph_{graph}, sizes_{sizes}, outline_{outline}, inside_{inside}, cutter_{outline, inside} {}

  CutForest run() {
    const auto count = static_cast<std::size_t>(graph_.local_end() - graph_.local_begin());
    result_.states.resize(count);
    result_.entry_of.assign(count, -1);
    for (std::int32_t leaf = graph_.local_begin(); leaf < graph_.local_end(); ++leaf) {
      const auto segments = sizes_.segments_in(graph_.leaf(leaf));
      if (segments.empty()) {
        state(leaf) = lies_inside(leaf) ? CutForest::State::inside : CutForest::State::outside;
      } else {
        cut(leaf, segments);
      }
    }
    begin_entry();
    return std::move(result_);
  }

 private:
  CutForest::State& state(std::int32_t leaf) { return result_.states[static_cast<std::size_t>(leaf - graph_.local_begin())]; }

  void begin_entry() {
    result_.entries.push_back({static_cast<std::int32_t>(result_.nodes.size()), static_cast<std::int32_t>(result_.triangles.size()),
                               static_cast<std::int32_t>(result_.quads.size()), static_cast<std::int32_t>(result_.outline.size())});
  }

  void cut(std::int32_t leaf, std::span<const std::int32_t> segments) {
    const Quadrant& q = graph_.leaf(leaf);
    const Box box = sizes_.lattice().box_of(q);
    const Point centre = centre_of(sizes_.lattice(), q);
    const unsigned hanging = graph_.around(leaf).finer;
    const auto done = [&](Detail detail) {
      return cutter_.cut(box, centre, hanging, segments, detail) && maker_.make(q, box, cutter_.result(), cells_);
    };
    if (!done(Detail::merged) && !done(Detail::full)) refuse(box, segments);
    state(leaf) = CutForest::State::cut;
    result_.entry_of[static_cast<std::size_t>(leaf - graph_.local_begin())] = static_cast<std::int32_t>(result_.entries.size());
    begin_entry();
    const CutLeaf& made = cutter_.result();
    result_.nodes.insert(result_.nodes.end(), made.nodes.begin(), made.nodes.end());
    result_.triangles.insert(result_.triangles.end(), cells_.triangles.begin(), cells_.triangles.end());
    result_.quads.insert(result_.quads.end(), cells_.quads.begin(), cells_.quads.end());
    result_.outline.insert(result_.outline.end(), made.outline.begin(), made.outline.end());
    half_inside_.push_back(made.half_inside);
    result_.followed += made.refined ? 1 : 0;
  }

  /// From the leaf to its left or below, which comes earlier along the curve; from a count of crossings where neither is at hand.
  bool lies_inside(std::int32_t leaf) {
    const Quadrant& q = graph_.leaf(leaf);
    const LeafGraph::Around& around = graph_.around(leaf);
    if (graph_.is_local(around.west) && around.west < leaf) {
      const Quadrant& west = graph_.leaf(around.west);
      return side_inside(around.west, LeafGraph::right, west.level < q.level && q.y != west.y);
    }
    if (graph_.is_local(around.south) && around.south < leaf) {
      const Quadrant& south = graph_.leaf(around.south);
      return side_inside(around.south, LeafGraph::top, south.level < q.level && q.x == south.x);
    }
    return inside_.contains(sizes_.lattice().corner(q.x, q.y));
  }

  /// Whether a half of a side, counter-clockwise, of a leaf that was dealt with lies inside.
  bool side_inside(std::int32_t leaf, int side, bool second_half) {
    if (state(leaf) != CutForest::State::cut) return state(leaf) == CutForest::State::inside;
    const auto entry = static_cast<std::size_t>(result_.entry_of[static_cast<std::size_t>(leaf - graph_.local_begin())]);
    return ((half_inside_[entry] >> (2 * side + (second_half ? 1 : 0))) & 1) != 0;
  }

  [[noreturn]] void refuse(const Box& box, std::span<const std::int32_t> segments) const {
    const Geometry& g = outline_.geometry();
    const std::string& first = g.boundary(g.boundary_of(segments.front())).name;
    const std::string& last = g.boundary(g.boundary_of(segments.back())).name;
    std::ostringstream message;
    message.precision(17);
    message << "boundary " << first << (first == last ? "" : " and boundary " + last) << " near (" << box.centre().x << ", " << box.centre().y
            << "): the outline comes so near to itself that double precision cannot part the two sides; move or remove points there";
    throw InputError(message.str());
  }

  const LeafGraph& graph_;
  SizeTree& sizes_;
  const ShiftedOutline& outline_;
  const InsideTest& inside_;
  LeafCutter cutter_;
  LeafCellMaker maker_;
  LeafCells cells_;
  CutForest result_;
  std::vector<std::uint8_t> half_inside_;
};

}  // namespace

CutForest cut_forest(const Communicator& comm, const LeafGraph& graph, SizeTree& sizes, const ShiftedOutline& outline, const InsideTest& inside) {
  CutForest result;
  comm.together([&] { result = ForestCutter(graph, sizes, outline, inside).run(); });
  return result;
}

bool ResolutionTest::unresolved(const Quadrant& q, std::span<const std::int32_t> segments) {
  const bool sound = cutter_.cut(lattice_->box_of(q), centre_of(*lattice_, q), 0, segments, Detail::merged);
  return !sound || cutter_.result().refined;
}

}  // namespace quadloop
