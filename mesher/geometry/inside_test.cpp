#include "mesher/geometry/inside_test.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>

namespace quadloop {

namespace {

namespace bg = boost::geometry;
using Corner = bg::model::point<double, 2, bg::cs::cartesian>;
using Extent = bg::model::box<Corner>;
using Entry = std::pair<Extent, std::int32_t>;

}  // namespace

struct InsideTest::Index {
  bg::index::rtree<Entry, bg::index::quadratic<16>> tree;
};

InsideTest::InsideTest(const ShiftedOutline& outline) : outline_{&outline} {}
InsideTest::~InsideTest() = default;

bool InsideTest::contains(Point p) const {
  const Geometry& g = outline_->geometry();
  if (!index_) {
    std::vector<Entry> entries;
    for (std::int32_t s = 0; s < g.size(); ++s) {
      Box box;
      box.include(g.point(s));
      box.include(g.point(g.next(s)));
      entries.push_back({Extent{{box.low.x, box.low.y}, {box.high.x, box.high.y}}, s});
    }
    index_ = std::make_unique<Index>();
    index_->tree = decltype(index_->tree)(entries);
  }
  int winding = 0;
  const auto count = [&](const Entry& entry) {
    const std::int32_t s = entry.second;
    const bool up = outline_->beyond_y(g.next(s), p.y);
    if (up == outline_->beyond_y(s, p.y)) return;
    if (outline_->has_left(s, p) != up) winding += up ? -1 : 1;  // the ray meets it to the left of p
  };
  const Extent ray{{g.box().low.x, p.y}, {p.x, p.y}};
  index_->tree.query(bg::index::intersects(ray), boost::make_function_output_iterator(count));
  return winding > 0;
}

}  // namespace quadloop
