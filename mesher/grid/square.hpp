#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <initializer_list>

namespace quadloop {

// The parts of a square are numbered from the bottom and the lower left corner, counter-clockwise.

enum class Side : std::uint8_t { bottom, right, top, left };
enum class Corner : std::uint8_t { south_west, south_east, north_east, north_west };
/// Of the grid edges at a grid vertex.
enum class Direction : std::uint8_t { east, north, west, south };

/// The place of a node in a square.
enum class Site : std::uint8_t {
  south_west,  ///< corners
  south_east,
  north_east,
  north_west,
  bottom_middle,  ///< middles of the sides: hanging nodes
  right_middle,
  top_middle,
  left_middle,
  on_bottom,  ///< elsewhere on the sides
  on_right,
  on_top,
  on_left,
  inside
};

inline constexpr std::array all_sides{Side::bottom, Side::right, Side::top, Side::left};
/// The sites that are grid vertices.
inline constexpr std::array grid_sites{Site::south_west, Site::south_east,    Site::north_east,
                                       Site::north_west, Site::bottom_middle, Site::right_middle,
                                       Site::top_middle, Site::left_middle};
/// The quarters of a square in the order of the space-filling curve (Morton order: row by row).
inline constexpr std::array corners_along_curve{Corner::south_west, Corner::south_east, Corner::north_west,
                                                Corner::north_east};

/// The index of a part in arrays with one entry per part.
template <class Part>
constexpr std::size_t index_of(Part part) {
  return static_cast<std::size_t>(part);
}
/// The index of a quarter in corners_along_curve.
constexpr int curve_index(Corner c) {
  const auto i = static_cast<int>(c);
  return i ^ i >> 1;
}
constexpr Corner corner_at(bool east, bool north) {
  return north ? (east ? Corner::north_east : Corner::north_west)
               : (east ? Corner::south_east : Corner::south_west);
}

constexpr bool is_vertical(Side s) { return s == Side::right || s == Side::left; }
constexpr bool is_vertical(Direction d) { return d == Direction::north || d == Direction::south; }
constexpr Side next(Side s) { return all_sides[(index_of(s) + 1) % 4]; }
constexpr Side opposite(Side s) { return all_sides[(index_of(s) + 2) % 4]; }

constexpr Site site_of(Corner c) { return grid_sites[index_of(c)]; }
constexpr Site start_of(Side s) { return grid_sites[index_of(s)]; }
constexpr Site middle_of(Side s) { return grid_sites[4 + index_of(s)]; }
/// Neither a corner nor the middle.
constexpr Site elsewhere_on(Side s) { return static_cast<Site>(8 + index_of(s)); }

constexpr bool is_corner(Site s) { return s <= Site::north_west; }
constexpr bool is_on_grid(Site s) { return s <= Site::left_middle; }
constexpr bool is_middle(Site s) { return is_on_grid(s) && !is_corner(s); }
/// The side of a middle or of a site elsewhere on a side.
constexpr Side side_of(Site s) { return all_sides[index_of(s) % 4]; }

/// A set of sides.
class SideSet {
 public:
  constexpr SideSet() = default;
  constexpr SideSet(std::initializer_list<Side> sides) {
    for (const Side s : sides) add(s);
  }
  constexpr void add(Side s) { bits_ = static_cast<std::uint8_t>(bits_ | 1U << index_of(s)); }
  constexpr bool contains(Side s) const { return (bits_ >> index_of(s) & 1) != 0; }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr int size() const { return std::popcount(bits_); }
  constexpr bool has_opposites() const { return (bits_ & bits_ >> 2) != 0; }
  friend constexpr SideSet operator&(SideSet a, SideSet b) {
    a.bits_ &= b.bits_;
    return a;
  }
  friend constexpr bool operator==(SideSet, SideSet) = default;

 private:
  std::uint8_t bits_ = 0;
};

/// The sides on which a site lies: two for a corner.
constexpr SideSet sides_of(Site s) {
  if (s == Site::inside) return {};
  return is_corner(s) ? SideSet{side_of(s), all_sides[(index_of(s) + 3) % 4]} : SideSet{side_of(s)};
}

/// The site that corresponds to s after a rotation that moves the bottom to the side `bottom`.
constexpr Site turned(Site s, Side bottom) {
  return s == Site::inside ? s
                           : static_cast<Site>(index_of(s) / 4 * 4 + (index_of(s) + index_of(bottom)) % 4);
}

/// Position of a grid site from the lower left corner, in half edges: 0 to 2.
struct Halves {
  int x = 0, y = 0;
};
inline constexpr std::array<Halves, grid_sites.size()> halves_of_sites{
    {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {2, 1}, {1, 2}, {0, 1}}};
constexpr Halves halves_of(Site s) { return halves_of_sites[index_of(s)]; }
/// Inverse of halves_of: the sites row by row; the square's middle is `inside`.
inline constexpr std::array<Site, 9> sites_by_halves{
    Site::south_west,   Site::bottom_middle, Site::south_east, Site::left_middle, Site::inside,
    Site::right_middle, Site::north_west,    Site::top_middle, Site::north_east};
constexpr Site site_at(Halves h) { return sites_by_halves[3 * h.y + h.x]; }

}  // namespace quadloop
