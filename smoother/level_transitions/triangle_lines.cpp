#include "smoother/level_transitions/triangle_lines.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <type_traits>

namespace quadloop::smoother {

namespace {

using Step = std::array<int, 2>;

/// A kind of node near a line where halved squares of two sizes meet. Unit of length: edge of the smaller
/// squares.
struct Role {
  std::array<Step, 9> neighbours;  ///< counter-clockwise around the node; unused entries are {}
  Point move;
};
/// The kinds of nodes of all lines whose corners are at least one square apart, except for one node in two
/// hundred. The moves maximise the sum of the quality 4 sqrt(3) area / (sum of squared edges) over the
/// triangles around, in meshes around an airfoil and a coast, such that no triangle has a quality much below
/// .84 or an angle below 34 degrees, and all stay Delaunay. The mean quality is .902 (.840 without moves);
/// the minima are .785 and 32 degrees.
constexpr std::array<Role, 15> roles{{
    // on a straight line: hanging nodes; other nodes of the line; nodes across the larger squares
    {{{{-2, -1}, {0, -1}, {1, 0}, {0, 1}, {-2, 1}}}, {-0.455, 0}},
    {{{{-2, 0}, {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}}}, {0.06, 0}},
    {{{{-2, -1}, {0, -2}, {2, 0}, {0, 2}, {-2, 1}, {-2, 0}}}, {-0.605, 0}},
    {{{{-2, -2}, {0, -2}, {2, -2}, {2, 0}, {1, 2}, {0, 2}, {-1, 2}, {-2, 0}}}, {0, 0.205}},
    // at corners of the larger squares' region: hanging nodes; nodes across a square with two of these
    {{{{-2, -1}, {0, -1}, {1, 0}, {0, 1}, {-1, 1}}}, {-0.265, 0}},
    {{{{-2, -1}, {-1, -2}, {0, -2}, {1, -2}, {2, 0}, {0, 2}, {-2, 0}}}, {-0.255, -0.65}},
    {{{{-2, -2}, {0, -2}, {1, -2}, {2, -1}, {2, 0}, {2, 1}, {0, 2}, {-2, 2}, {-2, 0}}}, {0.145, -0.175}},
    {{{{-2, -1}, {-1, -2}, {0, -2}, {2, 0}, {0, 2}, {-2, 0}}}, {-0.44, -0.44}},
    {{{{-2, -2}, {0, -2}, {1, -2}, {2, -1}, {2, 0}, {2, 2}, {0, 2}, {-2, 2}, {-2, 0}}}, {0.095, -0.095}},
    {{{{-2, -2}, {0, -2}, {2, -1}, {2, 0}, {2, 1}, {1, 2}, {0, 2}, {-1, 2}, {-2, 0}}}, {0.245, 0.245}},
    {{{{-2, -1}, {-1, -2}, {0, -2}, {1, -2}, {2, 0}, {0, 2}, {-2, 1}, {-2, 0}}}, {-0.435, -0.435}},
    // at corners of the smaller squares' region: the corner itself; nodes across the larger squares beside it
    {{{{-2, -2}, {0, -2}, {1, 0}, {1, 1}, {0, 1}, {-2, 0}}}, {-0.25, -0.25}},
    {{{{-2, 0}, {0, -2}, {1, 0}, {1, 1}, {0, 1}}}, {-0.035, -0.035}},
    {{{{-2, -2}, {0, -2}, {1, -2}, {2, 0}, {2, 2}, {0, 2}, {-2, 2}, {-2, 0}}}, {-0.115, -0.065}},
    {{{{-2, -1}, {0, -2}, {2, 0}, {0, 2}, {-2, 0}}}, {-0.355, -0.125}},
}};

/// A counter-clockwise triangle. `places`: 3 i + j for each corner, where i and j are 0, 1 or 2 for the lower
/// end, the middle and the upper end of the triangle's bounding box in x and y; then whether the box is twice
/// as high as wide (0), square (1) or twice as wide as high (2).
struct Shape {
  std::array<unsigned, 3> places;
  unsigned aspect;
};

/// The codes of the shape, seen from each of its corners.
constexpr std::array<std::size_t, 3> codes_of(const Shape& shape) {
  const auto& [a, b, c] = shape.places;
  const auto code = [&](unsigned own, unsigned next, unsigned previous) {
    return ((std::size_t{shape.aspect} * 9 + own) * 9 + next) * 9 + previous;
  };
  return {code(a, b, c), code(b, c, a), code(c, a, b)};
}

/// Pseudo-random numbers of the codes, so that the sum of a few numbers identifies the codes.
consteval auto all_numbers() {
  std::array<std::uint64_t, 3 * 9 * 9 * 9> numbers{};
  std::uint64_t state = 0;
  for (std::uint64_t& number : numbers) {  // SplitMix64
    number = state += 0x9e3779b97f4a7c15U;
    number = (number ^ (number >> 30U)) * 0xbf58476d1ce4e5b9U;
    number = (number ^ (number >> 27U)) * 0x94d049bb133111ebU;
    number ^= number >> 31U;
  }
  return numbers;
}
constexpr auto numbers = all_numbers();

constexpr Shape shape_of(const std::array<Step, 3>& corners) {
  Shape shape{};
  Step low{corners[0]}, high{corners[0]};
  for (const Step& c : corners) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      low[axis] = std::min(low[axis], c[axis]);
      high[axis] = std::max(high[axis], c[axis]);
    }
  }
  const int width = high[0] - low[0], height = high[1] - low[1];
  for (std::size_t k = 0; k < 3; ++k)
    shape.places[k] =
        static_cast<unsigned>(6 * (corners[k][0] - low[0]) / width + 2 * (corners[k][1] - low[1]) / height);
  shape.aspect = width == height ? 1 : width > height ? 2 : 0;
  return shape;
}

/// The eight symmetries of the square; the last four are mirror images.
constexpr int images = 8;
template <class Vector>
constexpr Vector image_of(Vector v, int image) {
  auto [x, y] = v;
  if (image >= 4) x = -x;
  for (int quarter = 0; quarter < image % 4; ++quarter) std::tie(x, y) = std::tuple(-y, x);
  return {x, y};
}

/// An image of a kind of node: the sum of the numbers of the triangles around it, and its move.
struct Pattern {
  std::uint64_t sum = 0;
  Point move;
};

constexpr std::uint64_t sum_round(const Role& role, int image) {
  const auto end = std::find(role.neighbours.begin(), role.neighbours.end(), Step{});
  const auto size = static_cast<std::size_t>(end - role.neighbours.begin());
  std::uint64_t sum = 0;
  for (std::size_t k = 0; k < size; ++k) {
    const Step a = image_of(role.neighbours[k], image), b = image_of(role.neighbours[(k + 1) % size], image);
    sum += numbers[codes_of(image < 4 ? shape_of({{{}, a, b}}) : shape_of({{{}, b, a}}))[0]];
  }
  return sum;
}

consteval auto all_patterns() {
  std::array<Pattern, images * roles.size()> patterns{};
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    const Role& role = roles[i / images];
    patterns[i] = {sum_round(role, i % images), image_of(role.move, i % images)};
  }
  std::sort(patterns.begin(), patterns.end(), [](const auto& a, const auto& b) { return a.sum < b.sum; });
  return patterns;
}
constexpr auto patterns = all_patterns();

/// Index into the patterns by the upper 8 bits of the sum; sums are distributed evenly.
constexpr unsigned shift = 56;
consteval auto all_starts() {
  std::array<std::uint8_t, 257> starts{};
  for (const Pattern& pattern : patterns) ++starts[(pattern.sum >> shift) + 1];
  for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
  return starts;
}
constexpr auto starts = all_starts();

/// The move for a sum; zero if no pattern has it.
Point move_for(std::uint64_t sum) {
  const std::size_t part = sum >> shift;
  for (std::size_t i = starts[part]; i < starts[part + 1]; ++i) {
    if (patterns[i].sum == sum) return patterns[i].move;
  }
  return {};
}

/// Relative to a box: coordinates read from a file are on the grid up to rounding.
constexpr double relative_rounding = 1e-6;
constexpr double least_side = 1e-300;  ///< length of a box's side

bool near(double a, double b, double whole) { return std::abs(a - b) <= relative_rounding * whole; }

/// The range of three coordinates.
struct Extent {
  double low, length;
};
Extent extent_of(double a, double b, double c) {
  const double low = std::min(std::min(a, b), c);
  return {low, std::max(std::max(a, b), c) - low};
}

/// The nearest of the known shapes to a triangle. Branch-free, as consecutive triangles differ: `fits` is
/// found by products and sums of comparisons.
struct FittedShape {
  Shape shape;
  bool fits;
};

/// Returns 0, 1 or 2 for the nearest of the lower end, the middle and the upper end of the extent.
unsigned nearest_place(double from_low, const Extent& extent) {
  return unsigned{4 * from_low >= extent.length} + unsigned{4 * from_low >= 3 * extent.length};
}

FittedShape shape_of(const std::array<Point, 3>& p, const Extent& x, const Extent& y) {
  FittedShape found{{{}, unsigned{4 * x.length >= 3 * y.length} + unsigned{2 * x.length >= 3 * y.length}},
                    false};
  unsigned fits = unsigned{x.length > least_side} &
                  unsigned{near(2 * x.length, (1U << found.shape.aspect) * y.length, y.length)};
  for (std::size_t k = 0; k < 3; ++k) {
    const double right = p[k].x - x.low, up = p[k].y - y.low;
    const unsigned column = nearest_place(right, x), row = nearest_place(up, y);
    found.shape.places[k] = 3 * column + row;
    fits &= unsigned{near(2 * right, column * x.length, x.length)} &
            unsigned{near(2 * up, row * y.length, y.length)};
  }
  found.fits = fits != 0;
  return found;
}

}  // namespace

TriangleLines::TriangleLines(const HaloMesh& mesh, const NodeFlags& near)
    : mesh_{mesh}, near_{near}, round_(mesh.owned_nodes()) {
  mesh.for_each_cell([&](const auto& nodes) {
    if constexpr (std::tuple_size_v<std::remove_cvref_t<decltype(nodes)>> == 3) look_at(nodes);
  });
  for (const HaloEdge& edge : mesh.edges_in_place()) {
    for (const NodeId node : {edge.from, edge.to}) {
      if (mesh.owns(node)) round_[node] = {};
    }
  }
}

/// Sums at nodes that are not flagged `near` are incomplete and unused.
void TriangleLines::look_at(const std::array<NodeId, 3>& nodes) {
  if (!any_flagged(near_, nodes)) return;
  const std::array<Point, 3> p{mesh_.point(nodes[0]), mesh_.point(nodes[1]), mesh_.point(nodes[2])};
  const Extent x = extent_of(p[0].x, p[1].x, p[2].x), y = extent_of(p[0].y, p[1].y, p[2].y);
  const auto [shape, fits] = shape_of(p, x, y);
  const std::array<std::size_t, 3> codes = codes_of(shape);
  const double edge = fits && shape.aspect != 1 ? std::min(x.length, y.length) : 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!mesh_.owns(nodes[k])) continue;
    Surroundings& s = round_[nodes[k]];
    s.sum += fits ? numbers[codes[k]] : 1;
    s.edge = std::max(s.edge, edge);
  }
}

/// Returns zero where the node is on no level line.
Point TriangleLines::move_of(NodeId node) const {
  const Surroundings& s = round_[node];
  return s.edge * move_for(s.sum);
}

}  // namespace quadloop::smoother
