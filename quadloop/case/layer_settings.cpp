#include "quadloop/case/layer_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ranges>
#include <string_view>

#include "io/text/text_scanner.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/id_vector.hpp"

namespace quadloop {

namespace {

constexpr int most_layers = 1000;

int read_number_of_layers(const CaseTable& table, const std::string& key) {
  const double count = table.number(key, {1, most_layers}).value_or(1);
  if (count != std::floor(count)) table.refuse(key, "must be a whole number of layers");
  return static_cast<int>(count);
}

void read_growth(const CaseTable& table, LayerSpec& spec) {
  if (!table.has("growth")) return;
  const std::vector<double> growth = table.numbers_or_one("growth", {1, 2, true, false});
  if (growth.empty() || growth.size() > 2 || growth.front() > growth.back())
    table.refuse("growth", "must be a number, or two of which the second is not less");
  spec.growth = growth.front();
  spec.growth_to = growth.back();
}

void read_count(const CaseTable& table, LayerSpec& spec) {
  const auto thickness = table.number("thickness", Range::positive());
  const bool has_count = table.has("count");
  if (thickness && has_count)
    table.refuse("thickness", "stands beside count, which says as much; give one of them");
  if (!thickness && !has_count)
    table.refuse("count", "is missing: how many layers, or with thickness how thick they are together");
  if (!thickness) {
    spec.count = read_number_of_layers(table, "count");
    return;
  }
  if (*thickness < spec.first)
    table.refuse("thickness",
                 fmt::format("is {}, less than the first layer's height of {}", *thickness, spec.first));
  spec.count = layers_within(spec, *thickness, most_layers + 1);
  if (spec.count > most_layers)
    table.refuse("thickness", fmt::format("takes more than {} layers; let them grow faster", most_layers));
}

std::vector<Point> read_path(const CaseTable& table) {
  std::vector<Point> path;
  for (const std::vector<double>& point : table.pairs("path")) {
    path.push_back({point[0], point[1]});
    if (path.size() > 1 && path[path.size() - 2] == path.back())
      table.refuse("path",
                   fmt::format("has the point ({}, {}) twice in a row", path.back().x, path.back().y));
  }
  return path;
}

double read_line_spacing(const CaseTable& table) {
  const auto spacing = table.number("spacing", Range::positive());
  if (!spacing) table.refuse("spacing", "is missing: the length of cells along the line");
  return *spacing;
}

LayerLine read_wake(const CaseTable& table) {
  LayerLine wake;
  wake.where = table.place();
  wake.from = table.texts("from");
  std::erase(wake.from, "");
  if (wake.from.empty())
    table.refuse(
        "from",
        "is missing: the boundary whose edge, sharp or blunt, the wake begins at, or a list of those "
        "that meet there");
  if (const auto at = table.numbers("at", 2)) wake.at = Point{(*at)[0], (*at)[1]};
  wake.path = read_path(table);
  const auto length = table.number("length", Range::positive());
  if (length.has_value() != wake.path.empty())
    table.refuse("length", "or path must be given, and not both: how far the wake goes on, or where");
  wake.length = length.value_or(0);
  wake.spacing = read_line_spacing(table);
  table.finish();
  return wake;
}

std::vector<Point> image_of(MirrorAxis axis, std::vector<Point> path) {
  for (Point& p : path) p = image_of(axis, p);
  return path;
}

std::string text_of(const std::vector<Point>& path) {
  std::string text;
  for (const Point p : path) text += fmt::format("{}[{}, {}]", text.empty() ? "" : ", ", p.x, p.y);
  return "[" + text + "]";
}

}  // namespace

void LayerSettings::read_first_height(const CaseTable& layers, LayerSpec& spec) {
  if (!layers.has("first"))
    layers.refuse("first", "is missing: the height of the layer at the wall, or \"yplus:1\"");
  if (!layers.is_text("first")) {
    spec.first = *layers.number("first", Range::positive());
    return;
  }
  constexpr std::string_view head = "yplus:";
  const std::string text = *layers.text("first");
  const bool is_y_plus = text.starts_with(head) &&
                         parse_real(std::string_view(text).substr(head.size()), spec.y_plus) &&
                         std::isfinite(spec.y_plus) && spec.y_plus > 0;
  if (!is_y_plus)
    layers.refuse("first", fmt::format("is '{}', but must be a height above 0, or \"yplus:1\" with any "
                                       "number above 0 in the place of 1",
                                       text));
  if (!flow_)
    layers.refuse("first", fmt::format("is '{}', which needs a Reynolds number: write a table [flow] with "
                                       "reynolds = 1e6, and reference_length unless that is 1",
                                       text));
  used_ = true;
  spec.first = height_of_y_plus(spec.y_plus, flow_conditions(layers));
}

FlowConditions LayerSettings::flow_conditions(const CaseTable& layers) const {
  if (!flow_->reynolds || *flow_->reynolds < FlowSettings::least_reynolds)
    layers.refuse("first",
                  fmt::format("asks for a y+, for which 'flow.reynolds' must be {} or more; it {}",
                              FlowSettings::least_reynolds,
                              flow_->reynolds ? fmt::format("is {}", *flow_->reynolds) : "is missing"));
  return {*flow_->reynolds, flow_->reference_length};
}

LayerSpec LayerSettings::read(const CaseTable& layers) {
  const LayerSpec spec = read_keys(layers);
  layers.finish();
  return spec;
}

LayerSpec LayerSettings::read_keys(const CaseTable& layers) {
  LayerSpec spec;
  read_first_height(layers, spec);
  read_growth(layers, spec);
  spec.equal = read_number_of_layers(layers, "equal");
  read_count(layers, spec);
  if (spec.equal > spec.count)
    layers.refuse("equal",
                  fmt::format("is {}, more than the {} layers that there are", spec.equal, spec.count));
  return spec;
}

LayerLine LayerSettings::read_layer_line(const CaseTable& table) {
  LayerLine line;
  line.where = table.place();
  line.path = read_path(table);
  if (line.path.size() < 2) table.refuse("path", "must have two points at least");
  line.spacing = read_line_spacing(table);
  line.layers = read_keys(table);
  line.layers->y_plus = 0;  // there is no friction to follow
  table.finish();
  return line;
}

std::vector<LayerLine> LayerSettings::read_lines(const CaseTable& root) {
  std::vector<LayerLine> lines;
  for (const CaseTable& wake : root.tables("wake")) lines.push_back(read_wake(wake));
  for (const CaseTable& line : root.tables("layer_line")) lines.push_back(read_layer_line(line));
  return lines;
}

std::optional<WallFlow> LayerSettings::wall_flow(const SolverSettings& solver) const {
  if (!flow_ || !used_) return {};
  if (solver.kind == SolverSettings::Kind::euler && solver.euler.viscosity > 0)
    return WallFlow{solver.euler.viscosity, 1};
  return WallFlow{flow_->viscosity(), flow_->density};
}

Warnings LayerSettings::unused(const SolverSettings& solver) const {
  const bool tells_stream = flow_ && flow_->pressure && solver.kind != SolverSettings::Kind::euler;
  if (!flow_ || used_ || tells_stream) return {};
  return {flow_->where + ": [flow] does nothing, as no boundary's layers have a first = \"yplus:1\""};
}

namespace {

/// Whether a path has points on both sides of an axis, or on it.
bool reaches(MirrorAxis axis, const std::vector<Point>& path) {
  const auto [lowest, highest] = std::ranges::minmax(path, {}, [axis](Point p) { return side_of(axis, p); });
  return side_of(axis, lowest) <= 0 && side_of(axis, highest) >= 0;
}

}  // namespace

void require_lines_beside(const std::vector<LayerLine>& lines, MirrorAxis axis) {
  for (const LayerLine& line : lines) {
    if (line.from.empty() && reaches(axis, line.path))
      throw InputError(fmt::format(
          "{}: this [[layer_line]] reaches the {}-axis, where mesh.half ends the domain; let it end "
          "before the axis, or remove mesh.half: a symmetric mesh may have lines on the axis and "
          "across it",
          line.where, name_of(axis)));
  }
}

void require_mirrored_lines(std::vector<LayerLine>& lines, MirrorAxis axis) {
  for (LayerLine& line : lines) {
    const std::vector<Point> image = image_of(axis, line.path);
    const auto is_image = [&](const LayerLine& other) {
      return other.path == image && other.spacing == line.spacing && other.layers == line.layers;
    };
    if (std::ranges::any_of(lines, is_image)) continue;
    if (line.from.empty() && std::ranges::equal(image, line.path | std::views::reverse)) {
      line.across = axis;
      continue;
    }
    const char* const what = line.from.empty() ? "layer_line" : "wake";
    if (reaches(axis, line.path))
      throw InputError(
          fmt::format("{}: this [[{}]] reaches the {}-axis but is not symmetric about it, as mesh.mirror "
                      "requires; place it on the axis, make its path symmetric ([[layer_line]] only), or end "
                      "it before the axis and add its mirror image",
                      line.where, what, name_of(axis)));
    throw InputError(
        fmt::format("{}: this [[{}]] has no mirror image in the {}-axis, as mesh.mirror wants; add one that "
                    "is alike but for its "
                    "path = {}, the points in this order",
                    line.where, what, name_of(axis), text_of(image)));
  }
}

void require_layers_that_doubles_hold(const Geometry& geometry) {
  constexpr double steps = 0x1p-42;  // a thousand steps between doubles, as columns want some for their tilt
  IdVector<BoundaryId, double> largest(geometry.boundaries().size(), 0);
  for (std::int32_t v = 0; v < geometry.size(); ++v) {
    const Point p = geometry.point(v);
    double& value = largest[geometry.boundary_of(v)];
    value = std::max({value, std::abs(p.x), std::abs(p.y)});
  }
  for (const BoundaryId b : largest.ids()) {
    const Boundary& boundary = geometry.boundary(b);
    if (!boundary.layers || boundary.layers->first >= steps * largest[b]) continue;
    throw InputError(
        fmt::format("boundary {}: a first layer of {} is too thin for coordinates as large as {}: "
                    "numbers do not hold it; move the geometry nearer to the origin, or make it "
                    "thicker than {:.2g}",
                    boundary.name, boundary.layers->first, largest[b], 1.05 * steps * largest[b]));
  }
}

}  // namespace quadloop
