#include "adapt/transfer/overlap/overlap_integrals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "mesher/base/parallel/exchange.hpp"

namespace quadloop::adapt {

namespace {

using Triangle = std::array<Point, 3>;

/// Overlaps smaller than this fraction of the smaller triangle may be rounding errors; their values do not
/// affect the range.
constexpr double sliver = 1e-12;

Box box_of_triangle(const Triangle& triangle) {
  Box box;
  for (const Point p : triangle) box.include(p);
  return box;
}

/// Sends triangles and their data to all ranks whose parts of the plane they meet.
class ToPartition {
 public:
  ToPartition(const Communicator& comm, const CurvePartition& shares, std::span<const Triangle> triangles)
      : exchange_{comm, find_ranks(shares, triangles)} {}

  template <class Rows>
  auto deliver(const Rows& rows, std::size_t width = 1) const {
    std::vector<std::ranges::range_value_t<Rows>> out;
    for (const std::size_t triangle : items_) {
      const auto row = rows.begin() + triangle * width;
      out.insert(out.end(), row, row + width);
    }
    return exchange_.deliver(out, width);
  }
  std::span<const Exchange::Source> sources() const { return exchange_.sources(); }

 private:
  std::vector<int> find_ranks(const CurvePartition& shares, std::span<const Triangle> triangles) {
    std::vector<int> ranks, meeting;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      shares.ranks_meeting(box_of_triangle(triangles[i]), meeting);
      ranks.insert(ranks.end(), meeting.begin(), meeting.end());
      items_.insert(items_.end(), meeting.size(), i);
    }
    return ranks;
  }

  std::vector<std::size_t> items_;  ///< before the exchange, which fills it
  Exchange exchange_;
};

/// Partial sums of area and values; sent as a row of doubles.
struct Sum {
  double area = 0;
  std::vector<CoveredValue> values;

  explicit Sum(std::size_t width) : values(width, nothing) {}

  void add(double more, std::span<const CoveredValue> others) {
    area += more;
    for (std::size_t k = 0; k < values.size(); ++k) {
      CoveredValue& value = values[k];
      value.integral += others[k].integral;
      value.slope = value.slope + others[k].slope;
      value.smallest = std::min(value.smallest, others[k].smallest);
      value.largest = std::max(value.largest, others[k].largest);
    }
  }

  static constexpr double none = std::numeric_limits<double>::infinity();
  static constexpr CoveredValue nothing{0, {}, none, -none};
};

/// Header of a contribution to a new triangle, sent to the rank that owns the triangle.
struct PartHeader {
  std::int64_t item = 0;    ///< the new triangle, by its local index on its rank
  std::int64_t number = 0;  ///< of the old triangle; 0 if the contributions of all are summed
  double area = 0;
};

/// The box without its border: most triangles that meet a triangle's box in a grid only touch it.
Box without_border(const Box& box) {
  constexpr double far = std::numeric_limits<double>::infinity();
  return {{std::nextafter(box.low.x, far), std::nextafter(box.low.y, far)},
          {std::nextafter(box.high.x, -far), std::nextafter(box.high.y, -far)}};
}

}  // namespace

struct OldTriangles::Parts {
  std::vector<PartHeader> headers;
  std::vector<CoveredValue> values;
  std::vector<int> ranks;

  void add(const PartHeader& header, std::span<const CoveredValue> of_part, int rank) {
    headers.push_back(header);
    values.insert(values.end(), of_part.begin(), of_part.end());
    ranks.push_back(rank);
  }
};

OldTriangles::OldTriangles(const Communicator& comm, const CurvePartition& shares, const BrokenField& field,
                           const BafflePlaces* baffles)
    : comm_{comm}, shares_{shares}, baffles_{baffles} {
  const ToPartition to_partition(comm, shares, field.triangles);
  field_.width = field.width;
  field_.triangles = to_partition.deliver(field.triangles);
  field_.numbers = to_partition.deliver(field.numbers);
  field_.at_corners = to_partition.deliver(field.at_corners, 3 * field.width);
  tree_ = BoxTree(size32(field_.triangles),
                  [&](std::int32_t old) { return box_of_triangle(field_.triangles[old]); });
}

/// Adds the contributions to a rank's new triangle within this rank's part of the plane. Complete integrals
/// over own triangles are stored.
void OldTriangles::cut(const Triangle& triangle, std::int64_t item, int rank, OverlapIntegrals& own,
                       Parts& parts) {
  const Box box = box_of_triangle(triangle);
  if (!(box.low == last_.low && box.high == last_.high)) look_up(box);
  const bool all_here = meeting_.size() == 1;
  Sum sum(field_.width);
  for (const std::int32_t old : candidates_) {
    if (!all_here && !is_mine(box, box_of_triangle(field_.triangles[old]))) continue;
    const TriangleOverlap overlap = overlap_of(triangle, field_.triangles[old]);
    if (!(overlap.area > 0)) continue;
    if (baffles_ != nullptr && baffles_->across(triangle[0] + overlap.centroid)) continue;
    fill(old, triangle, overlap, std::min(area_of(triangle), area_of(field_.triangles[old])));
    if (all_here)
      sum.add(overlap.area, row_);
    else
      parts.add({item, field_.numbers[old], overlap.area}, row_, rank);
  }
  if (!(sum.area > 0)) return;
  if (rank == comm_.rank())
    own.set(item, sum.area, sum.values);
  else
    parts.add({item, 0, sum.area}, sum.values, rank);
}

/// Finds the ranks whose parts the box meets, and the old triangles that it meets, in the order of their
/// numbers. Kept, as the halves of a quadrilateral have the same box.
void OldTriangles::look_up(const Box& box) {
  last_ = box;
  shares_.ranks_meeting(box, meeting_);
  candidates_.clear();
  tree_.for_each_meeting(without_border(box), [&](std::int32_t old) { candidates_.push_back(old); });
  std::ranges::sort(candidates_, {}, [&](std::int32_t old) { return field_.numbers[old]; });
}

bool OldTriangles::is_mine(const Box& a, const Box& b) const {
  return shares_.rank_of({std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y)}) == comm_.rank();
}

/// Writes the old triangle's integrals over the overlap to row_.
void OldTriangles::fill(std::size_t old, const Triangle& cut, const TriangleOverlap& overlap,
                        double smaller_area) {
  const auto& [a, b, c] = field_.triangles[old];
  const Point first = b - a, second = c - a, off = overlap.centroid + (cut[0] - a);
  const double twice_area = cross(first, second);
  const bool bounds = overlap.area > sliver * smaller_area;
  row_.assign(field_.width, Sum::nothing);
  for (std::size_t k = 0; k < field_.width; ++k) {
    const double at_a = field_.row(old, 0)[k], at_b = field_.row(old, 1)[k], at_c = field_.row(old, 2)[k];
    const double d_first = at_b - at_a, d_second = at_c - at_a;
    const Point gradient{(d_first * second.y - d_second * first.y) / twice_area,
                         (d_second * first.x - d_first * second.x) / twice_area};
    const auto [low, high] = std::minmax({at_a, at_b, at_c});
    const double share_b = cross(off, second) / twice_area, share_c = cross(first, off) / twice_area;
    const double value = std::clamp(at_a + share_b * d_first + share_c * d_second, low, high);
    row_[k] = {overlap.area * value, overlap.area * gradient, bounds ? low : Sum::none,
               bounds ? high : -Sum::none};
  }
}

/// Sums the contributions of other ranks in the order of the old triangles' numbers.
void OldTriangles::add_up(const Parts& parts, OverlapIntegrals& integrals) const {
  const std::size_t width = integrals.width;
  const Exchange exchange(comm_, parts.ranks);
  const std::vector<PartHeader> headers = exchange.deliver(parts.headers);
  const std::vector<CoveredValue> values = exchange.deliver(parts.values, width);
  std::vector<std::size_t> order(headers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return std::tuple(headers[i].item, headers[i].number); });
  for (std::size_t i = 0; i < order.size();) {
    const std::int64_t item = headers[order[i]].item;
    Sum sum(width);
    for (; i < order.size() && headers[order[i]].item == item; ++i)
      sum.add(headers[order[i]].area, std::span(values).subspan(order[i] * width, width));
    integrals.set(item, sum.area, sum.values);
  }
}

OverlapIntegrals OldTriangles::integrate(std::span<const Triangle> new_triangles) {
  const ToPartition to_partition(comm_, shares_, new_triangles);
  std::vector<std::int64_t> items(new_triangles.size());
  std::iota(items.begin(), items.end(), std::int64_t{0});
  const std::vector<Triangle> triangles = to_partition.deliver(new_triangles);
  items = to_partition.deliver(items);
  OverlapIntegrals integrals{field_.width, std::vector<double>(new_triangles.size(), 0),
                             std::vector<CoveredValue>(new_triangles.size() * field_.width)};
  Parts parts;
  for (const Exchange::Source& source : to_partition.sources()) {
    for (std::size_t i = source.begin; i < source.end; ++i)
      cut(triangles[i], items[i], source.rank, integrals, parts);
  }
  add_up(parts, integrals);
  return integrals;
}

}  // namespace quadloop::adapt
