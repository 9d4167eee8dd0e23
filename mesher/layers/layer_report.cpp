#include "mesher/layers/layer_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <ranges>
#include <span>
#include <tuple>
#include <utility>

#include "mesher/base/id_vector.hpp"
#include "mesher/layers/layer_column.hpp"

namespace quadloop {

namespace {

constexpr double full = 0.985;
constexpr double thin_share = 0.5;  // fraction of the requested thickness below which a warning is issued

/// One column, known to all ranks.
struct Column {
  BoundaryId boundary;
  GlobalNodeId node;
  int layers = 0;
  double first = 0, growth = 0, share = 0, asked = 0;
  Point foot;
};

double share_at(const LayerFront& front, std::int32_t station) {
  return front.thickness[station] / front.line.asked(station);
}

/// Fraction of the requested thickness, interpolated between two stations.
double share_at(const LayerFront& front, const FrontPlace& place) {
  const double here = share_at(front, place.station);
  if (place.at_station()) return here;
  const double next = share_at(front, front.line.next(place.station));
  return 0.5 * ((here + place.share * (next - here)) + (next + place.rest * (here - next)));
}

/// Adds the columns of this rank's front edges of one boundary of the mesh outside.
void add_columns(const LayerFront& front, const FrontPlaces& places, const Mesh& outer, BoundaryId boundary,
                 std::vector<Column>& columns) {
  for (const auto& [from, to] : outer.boundaries[boundary.value()].edges) {
    const std::array nodes{from, to};
    const auto ends = places.locate_edge(outer.point(from), outer.point(to), boundary);
    if (!places.follows(ends[0], ends[1])) continue;
    for (const std::size_t k : {0, 1}) {
      const LayerColumn column = column_at(front, ends[k], outer.point(nodes[k]));
      columns.push_back({front.line[ends[k].station].layers, outer.global(nodes[k]),
                         size32(column.heights.reached) - 1, column.heights.first * column.cosine,
                         column.heights.growth, share_at(front, ends[k]), front.line.asked(ends[k].station),
                         column.foot});
    }
  }
}

/// The columns of this rank's front edges; a column may occur twice, or on two ranks. Columns on interfaces
/// are those at the nodes of their front.
std::vector<Column> own_columns(const LayerFront& front, const Mesh& outer) {
  const FrontPlaces places(front);
  std::vector<Column> columns;
  for (std::int32_t b = 0; b < size32(outer.boundaries); ++b)
    add_columns(front, places, outer, BoundaryId{b}, columns);
  if (front.on_interfaces)
    add_columns(front, FrontPlaces::on_interface_fronts(front), outer, front.interface_boundary(), columns);
  return columns;
}

/// All ranks' columns, each once, in an order independent of the partition. *Collective.*
std::vector<Column> all_columns(const Communicator& comm, const LayerFront& front, const Mesh& outer) {
  const std::vector<Column> own = own_columns(front, outer);
  std::vector<Column> columns = comm.all_gather_values(std::span<const Column>(own));
  const auto key = [](const Column& c) { return std::tuple(c.boundary, c.node, c.share, c.first, c.growth); };
  std::ranges::sort(columns, {}, key);
  const auto same = [](const Column& a, const Column& b) {
    return a.boundary == b.boundary && a.node == b.node;
  };
  columns.erase(std::unique(columns.begin(), columns.end(), same), columns.end());
  return columns;
}

double median_first(std::span<const Column> columns) {
  std::vector<double> firsts;
  for (const Column& column : columns) firsts.push_back(column.first);
  const auto middle = firsts.begin() + std::ssize(firsts) / 2;
  std::ranges::nth_element(firsts, middle);
  return *middle;
}

/// Statistics of the stations of one boundary.
struct WallStatistics {
  /// Length of wall between stations with the requested thickness; total length.
  double full_length = 0, length = 0;
  double first_least = std::numeric_limits<double>::infinity(), first_most = 0;  ///< requested first heights
  double thickness_least = std::numeric_limits<double>::infinity(), thickness_most = 0;  ///< requested

  double share_full() const { return length > 0 ? full_length / length : 1; }
};

using StatisticsOfWalls = IdVector<BoundaryId, WallStatistics>;

/// Statistics of all boundaries, in one pass over the stations.
StatisticsOfWalls statistics_of_walls(const LayerFront& front) {
  StatisticsOfWalls walls(front.line.geometry().boundaries().size());
  for (std::int32_t i = 0; i < front.line.size(); ++i) {
    WallStatistics& wall = walls[front.line[i].layers];
    wall.first_least = std::min(wall.first_least, front.line.spec(i).first);
    wall.first_most = std::max(wall.first_most, front.line.spec(i).first);
    wall.thickness_least = std::min(wall.thickness_least, front.line.asked(i));
    wall.thickness_most = std::max(wall.thickness_most, front.line.asked(i));
    if (!front.line.goes_on(i)) continue;
    wall.length += front.line.width(i);
    const double least = std::min(share_at(front, i), share_at(front, front.line.next(i)));
    if (least > full) wall.full_length += front.line.width(i);
  }
  return walls;
}

BoundaryLayerReport report_of(const LayerFront& front, BoundaryId id, const WallStatistics& wall,
                              std::span<const Column> columns) {
  const Boundary& boundary = front.line.geometry().boundary(id);
  const LayerSpec& spec = *boundary.layers;
  const auto worst = std::ranges::min_element(
      columns, {}, [](const Column& c) { return std::tuple(c.share, c.growth, c.foot.x, c.foot.y); });
  BoundaryLayerReport report;
  report.boundary = boundary.name;
  report.asked = spec.count;
  report.reached = std::ranges::min(columns, {}, &Column::layers).layers;
  report.columns = std::ssize(columns);
  report.first_asked = wall.first_least;
  report.first_asked_most = wall.first_most;
  report.y_plus = spec.y_plus;
  report.first_least = std::ranges::min(columns, {}, &Column::first).first;
  report.first_median = median_first(columns);
  report.growth_asked = spec.growth;
  report.growth_least = std::ranges::min(columns, {}, &Column::growth).growth;
  report.follows_flow = spec.follows_flow;
  report.thickness_asked = spec.follows_flow ? wall.thickness_least : layers_thickness(spec);
  report.thickness_asked_most = spec.follows_flow ? wall.thickness_most : report.thickness_asked;
  report.asked_at_least = spec.follows_flow ? worst->asked : report.thickness_asked;
  report.share_least = worst->share;
  report.share_full = wall.share_full();
  report.least = worst->foot;
  report.growth_at_least = worst->growth;
  return report;
}

/// A column on one side of a strip, as described by its lengths.
struct SideColumn {
  double first = 0, growth = 0, share = 0;
  Point foot;
};

SideColumn side_column(const LayerStrip& strip, std::size_t k, bool left) {
  const std::vector<Point>& across = strip.columns[k];
  const std::size_t foot = left ? across.size() - 1 - strip.layers : strip.layers;
  const auto at = [&](int layer) { return across[left ? foot + layer : foot - layer]; };
  SideColumn column{length(at(1) - at(0)), strip.spec.growth, 0, at(0)};
  double whole = column.first, before = column.first;
  for (int layer = 2; layer <= strip.layers; ++layer) {
    const double height = length(at(layer) - at(layer - 1));
    if (layer > strip.spec.equal) column.growth = std::min(column.growth, height / before);
    whole += before = height;
  }
  column.share = whole / strip.asked;
  return column;
}

}  // namespace

BoundaryLayerReport report_strip(const LayerStrip& strip) {
  std::vector<SideColumn> columns;
  for (std::size_t k = 0; k < strip.columns.size(); ++k) {
    for (const bool left : {false, true}) columns.push_back(side_column(strip, k, left));
  }
  const auto worst = std::ranges::min_element(
      columns, {}, [](const SideColumn& c) { return std::tuple(c.share, c.growth, c.foot.x, c.foot.y); });
  BoundaryLayerReport report;
  report.boundary = strip.name;
  report.share_least = worst->share;
  report.least = worst->foot;
  report.growth_at_least = worst->growth;
  report.asked = report.reached = strip.layers;
  report.columns = std::ssize(strip.columns);
  report.first_asked = report.first_asked_most = strip.spec.first;
  std::ranges::sort(columns, {}, &SideColumn::first);
  report.first_least = columns.front().first;
  report.first_median = columns[columns.size() / 2].first;
  report.growth_asked = strip.spec.growth;
  report.growth_least = std::ranges::min(columns, {}, &SideColumn::growth).growth;
  report.thickness_asked = report.thickness_asked_most = report.asked_at_least = strip.asked;
  report.share_full = static_cast<double>(std::ranges::count_if(
                          columns, [](const SideColumn& c) { return c.share > full; })) /
                      static_cast<double>(columns.size());
  return report;
}

LayerReport report_layers(const Communicator& comm, const LayerFront& front, const Mesh& outer) {
  const std::vector<Column> columns = all_columns(comm, front, outer);
  const StatisticsOfWalls walls = statistics_of_walls(front);
  LayerReport report;
  for (auto begin = columns.begin(); begin != columns.end();) {
    const BoundaryId boundary = begin->boundary;
    const auto end =
        std::find_if(begin, columns.end(), [&](const Column& c) { return c.boundary != boundary; });
    report.push_back(report_of(front, boundary, walls[boundary], std::span(begin, end)));
    begin = end;
  }
  for (const LayerStrip& strip : front.strips) report.push_back(report_strip(strip));
  return report;
}

std::vector<std::string> warnings_of(const LayerReport& report) {
  constexpr std::size_t most_named = 5;
  LayerReport thin;
  std::ranges::copy_if(report, std::back_inserter(thin),
                       [](const BoundaryLayerReport& row) { return row.share_least < thin_share; });
  std::ranges::stable_sort(thin, {}, &BoundaryLayerReport::share_least);
  std::vector<std::string> warnings;
  for (const BoundaryLayerReport& row : thin | std::views::take(most_named)) {
    warnings.push_back(fmt::format(
        "boundary '{}': near ({:.6g}, {:.6g}) the {} layers are {:.2g} thick in total, {:.2g} % of the "
        "requested {:.3g}, with the growth ratio {:.3g} instead of {:.3g}; {:.1f} % of the boundary has "
        "the full thickness. Layers are thinner at narrow gaps, at sharp turns and at rough parts of the "
        "geometry (close points with few decimals); reduce count or growth, or smooth the points",
        row.boundary, row.least.x, row.least.y, row.reached, row.share_least * row.asked_at_least,
        100 * row.share_least, row.asked_at_least, row.growth_at_least, row.growth_asked,
        100 * row.share_full));
  }
  if (thin.size() > most_named)
    warnings.push_back(
        fmt::format("layers are in places less than half as thick as requested on {} more of the boundaries; "
                    "the table at the end lists them all",
                    thin.size() - most_named));
  return warnings;
}

namespace {

/// The smallest leaf size that a boundary's layers need.
struct TargetLeaf {
  double size = std::numeric_limits<double>::infinity();
  Point at;
};

void add_warnings_of_walls(const LayerFront& front, double min, std::vector<std::string>& warnings) {
  constexpr std::size_t most_named = 5;
  const Geometry& outer = front.outer;
  IdVector<BoundaryId, TargetLeaf> wanted(outer.boundaries().size(), {});
  for (std::int32_t s = 0; s < outer.size(); ++s) {
    const std::int32_t station = front.station_of[s];
    if (station == WallLine::none || share_at(front, station) < thin_share) continue;
    const double size = leaf_over_last_layer * front.last_heights[s];
    const bool on_interface = front.on_interfaces && outer.boundary_of(s) == front.interface_boundary();
    const Geometry& g = front.line.geometry();
    TargetLeaf& least =
        wanted[on_interface ? g.boundary_of(front.line[station].segment) : outer.boundary_of(s)];
    if (size < std::min(min, least.size)) least = {size, outer.point(s)};
  }
  std::vector<BoundaryId> limited;
  for (const BoundaryId b : wanted.ids()) {
    if (wanted[b].size < min) limited.push_back(b);
  }
  std::ranges::stable_sort(limited, {}, [&](BoundaryId b) { return wanted[b].size; });
  for (const BoundaryId b : limited | std::views::take(most_named))
    warnings.push_back(
        fmt::format("boundary '{}': its last layer is {:.3g} high near ({:.6g}, {:.6g}) and requires cells "
                    "of at most {:.3g} beside it, but spacing.min = {:.6g} is larger; reduce spacing.min, or "
                    "use thicker or fewer layers",
                    outer.boundary(b).name, wanted[b].size / leaf_over_last_layer, wanted[b].at.x,
                    wanted[b].at.y, wanted[b].size, min));
  if (limited.size() > most_named)
    warnings.push_back(
        fmt::format("last layers are thinner than half of spacing.min = {:.6g} on {} more of the boundaries",
                    min, limited.size() - most_named));
}

/// Returns what to do about small cells beside a strip: at a trailing edge that is no feature point, as it
/// turns by less than its boundary's `corner`, the wall's columns do not meet those of the wake.
std::string advice_on(const LayerStrip& strip, const Geometry& geometry) {
  for (std::int32_t v = 0; v < geometry.size(); ++v) {
    const Boundary& boundary = geometry.boundary(geometry.boundary_of(v));
    if (!strip.root || geometry.point(v) != strip.columns[0][strip.layers]) continue;
    if (geometry.turn_degrees(v) > boundary.corner_degrees) continue;
    return fmt::format(
        "make corner = {:.6g} of boundary '{}' smaller than {:.6g}, the angle by which it turns at "
        "the trailing edge, so that this point becomes a node",
        boundary.corner_degrees, boundary.name, geometry.turn_degrees(v));
  }
  return "reduce spacing.min, or use thicker or fewer layers";
}

/// Warns where cells outside are much larger than those at a strip's end, which gives thin triangles.
void add_warning_of_strip(const LayerStrip& strip, const Geometry& geometry, double min,
                          std::vector<std::string>& warnings) {
  const auto least = std::ranges::min_element(strip.spacing);
  if (*least >= min) return;
  const Point at = strip.front[std::min<std::size_t>(least - strip.spacing.begin(), strip.front.size() - 1)];
  warnings.push_back(fmt::format(
      "{}the layers of {} require cells of {:.3g} beside them at ({:.6g}, {:.6g}), smaller than spacing.min "
      "= {:.6g}: triangles there will be thin; {}",
      strip.place, strip.name, *least, at.x, at.y, min, advice_on(strip, geometry)));
}

/// Warns of a base without layers of its own: its cells are as high as the columns behind it are wide.
void add_warning_of_base(const LayerStrip& strip, std::vector<std::string>& warnings) {
  constexpr double too_high = 1.5;
  if (strip.core == 0 || strip.base_layers() > 0) return;
  const std::size_t middle = strip.columns[0].size() / 2;
  const Point at = strip.columns[0][middle];
  const double height = length(strip.columns[1][middle] - at);
  if (height <= too_high * strip.spec.first) return;
  warnings.push_back(
      fmt::format("{}the blunt trailing edge at ({:.6g}, {:.6g}), where {} begins, is too narrow or too "
                  "slanted for layers on its base: cells there are {:.3g} high instead of first = {:.3g}; "
                  "reduce first, or remove this wake",
                  strip.place, at.x, at.y, strip.name, height, strip.spec.first));
}

/// Warns of a wake that does not continue the walls: their columns are squeezed on its inner side.
void add_warning_of_turn(const LayerStrip& strip, std::vector<std::string>& warnings) {
  constexpr double too_sharp = 15;
  if (strip.turn_degrees <= too_sharp) return;
  const Point at = strip.columns[0][strip.columns[0].size() / 2];
  warnings.push_back(fmt::format(
      "{}{} turns by {:.0f} degrees from the direction of the trailing edge near ({:.6g}, {:.6g}): the "
      "layers "
      "there are thin or their cells skewed; begin its path in the direction of the edge and bend it "
      "gradually, in steps of at most {} degrees",
      strip.place, strip.name, strip.turn_degrees, at.x, at.y, too_sharp));
}

void add_warning_of_length(const LayerStrip& strip, std::vector<std::string>& warnings) {
  if (!strip.shortened) return;
  const auto& [requested, left, before, at] = *strip.shortened;
  warnings.push_back(fmt::format(
      "{}{} ends at ({:.6g}, {:.6g}), after {:.3g} of its length of {:.3g}, as it comes near {}; reduce its "
      "length, or give it a path = [[x, y], ...] that passes beside it",
      strip.place, strip.name, at.x, at.y, left, requested, before));
}

}  // namespace

std::vector<std::string> size_warnings(const LayerFront& front, double min) {
  std::vector<std::string> warnings;
  add_warnings_of_walls(front, min, warnings);
  for (const LayerStrip& strip : front.strips) {
    add_warning_of_strip(strip, front.line.geometry(), min, warnings);
    add_warning_of_base(strip, warnings);
    add_warning_of_turn(strip, warnings);
    add_warning_of_length(strip, warnings);
  }
  return warnings;
}

}  // namespace quadloop
