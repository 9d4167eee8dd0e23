#include "quadloop/case/layer_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ranges>
#include <string_view>

#include "io/text/text_scanner.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/id_vector.hpp"
#include "mesher/geometry/boundary_conditions.hpp"
#include "quadloop/case/first_height.hpp"

namespace quadloop {

namespace {

constexpr int most_layers = 1000;

/// Returns the flow conditions for a y+.
FlowConditions conditions_of_y_plus(const io::CaseTable& table, const std::string& key,
                                    const std::string& text) {
  const auto flow = read_flow_table(table.root());
  if (!flow)
    table.refuse(key, fmt::format("is '{}', which needs a Reynolds number: write a table [flow] with "
                                  "reynolds = 1e6, and reference_length unless that is 1",
                                  text));
  if (!flow->reynolds || *flow->reynolds < FlowSettings::least_reynolds)
    table.refuse(key, fmt::format("requires 'flow.reynolds' of at least {} for a y+; it {}",
                                  FlowSettings::least_reynolds,
                                  flow->reynolds ? fmt::format("is {}", *flow->reynolds) : "is missing"));
  return {*flow->reynolds, flow->reference_length};
}

FirstHeight read_first_height(const io::CaseTable& table, const std::string& key) {
  if (!table.is_text(key)) return {*table.number(key, io::Range::positive())};
  constexpr std::string_view head = "yplus:";
  const std::string text = *table.text(key);
  double y_plus = 0;
  const bool is_y_plus = text.starts_with(head) &&
                         io::parse_real(std::string_view(text).substr(head.size()), y_plus) &&
                         std::isfinite(y_plus) && y_plus > 0;
  if (!is_y_plus)
    table.refuse(key,
                 fmt::format("is '{}', but must be a height above 0, or \"yplus:1\" with any number above "
                             "0 in the place of 1",
                             text));
  return {height_of_y_plus(y_plus, conditions_of_y_plus(table, key, text)), y_plus};
}

LayersThickness read_thickness(const io::CaseTable& table, const std::string& key) {
  if (!table.is_text(key)) return {*table.number(key, io::Range::positive())};
  if (const std::string text = *table.text(key); text != "flow")
    table.refuse(key, fmt::format("is '{}', but must be a number above 0 or \"flow\"", text));
  return {0, true};
}

GrowthRange read_growth(const io::CaseTable& table, const std::string& key) {
  const std::vector<double> growth = table.numbers_or_one(key, {1, 2, true, false});
  if (growth.empty() || growth.size() > 2 || growth.front() > growth.back())
    table.refuse(key, "must be a number, or two of which the second is not less");
  return {growth.front(), growth.back()};
}

std::vector<Point> read_path(const io::CaseTable& table, const std::string& key) {
  std::vector<Point> path;
  for (const std::vector<double>& point : table.pairs(key)) {
    path.push_back({point[0], point[1]});
    if (path.size() > 1 && path[path.size() - 2] == path.back())
      table.refuse(key, fmt::format("has the point ({}, {}) twice in a row", path.back().x, path.back().y));
  }
  return path;
}

WakeCourse read_course(const io::CaseTable& table, const std::string& key) {
  if (!table.is_text(key)) return {read_path(table, key)};
  table.known_word(key, *table.text(key), {"flow"});
  return {{}, true};
}

WakeSpacing read_wake_spacing(const io::CaseTable& table, const std::string& key) {
  const std::vector<double> sizes = table.numbers_or_one(key, io::Range::positive());
  if (sizes.empty() || sizes.size() > 2 || sizes.front() > sizes.back())
    table.refuse(key, "must be a number above 0, or two of which the second is not less");
  return {sizes.front(), sizes.back()};
}

ValueForm<std::vector<Point>> path() { return {"`[[x, y], ...]`", "[[1, 1], [2, 2]]", read_path}; }

/// Combines the keys read from a table to layers.
LayerSpec layers_of(const io::CaseTable& table, const LayerKeys& keys) {
  LayerSpec spec{keys.first.height, keys.growth.low, keys.growth.high,
                 keys.count,        keys.equal,      keys.first.y_plus};
  spec.follows_flow = keys.thickness.follows_flow;
  if (const double thickness = keys.thickness.least; thickness > 0) {
    if (keys.count > 0) table.refuse("thickness", "stands beside count; give one of them");
    if (thickness < spec.first)
      table.refuse("thickness",
                   fmt::format("is {}, less than the first layer's height of {}", thickness, spec.first));
    spec.count = layers_within(spec, thickness, most_layers + 1);
    if (spec.count > most_layers)
      table.refuse("thickness", fmt::format("takes more than {} layers; let them grow faster", most_layers));
  }
  if (spec.equal > spec.count)
    table.refuse("equal",
                 fmt::format("is {}, more than the {} layers that there are", spec.equal, spec.count));
  return spec;
}

ValueForm<LayerSpec> layers() {
  return {"table", "{ first = 1e-3, count = 5 }", [](const io::CaseTable& table, const std::string& key) {
            LayerKeys keys;
            const io::CaseTable below = *table.table(key);
            layer_keys().read(below, keys);
            return layers_of(below, keys);
          }};
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

const KeyTable<LayerKeys>& layer_keys() {
  static const KeyTable<LayerKeys> keys{
      "boundary.NAME.layers",
      {key<&LayerKeys::first>(
           "first", ValueForm<FirstHeight>{"number, above 0, or `\"yplus:1\"`", "1e-3", read_first_height},
           "Height of the first layer, normal to the wall, or that of an estimated y+, which requires "
           "[`[flow]`](#flow).",
           {.unit = "length", .required = {{"the height of the layer at the wall, or \"yplus:1\""}}}),
       key<&LayerKeys::growth>(
           "growth", ValueForm<GrowthRange>{"number, above 1 and at most 2, or two", "1.3", read_growth},
           "Growth ratio of successive layers. `[1.1, 1.5]`: the ratio starts at the first value and rises, "
           "after five layers by 0.05 per layer, to the second.",
           {.fallback = "1.2"}),
       key<&LayerKeys::count>(
           "count", whole({1, most_layers}), "Number of layers. Alternative to `thickness`.",
           {.required = {{"how many layers, or with thickness how thick they are together", "no thickness"},
                         {"how many layers share the thickness of the boundary layer",
                          "thickness = \"flow\""}}}),
       key<&LayerKeys::thickness>(
           "thickness", ValueForm<LayersThickness>{"number, above 0, or `\"flow\"`", "0.02", read_thickness},
           "Total thickness instead of `count`: the smallest number of layers that reaches it. The last "
           "layer may exceed it. `\"flow\"`, for walls, beside `count`: `adapt` adjusts the thickness to the "
           "boundary layer in the solution ([layers](../explanation/layers.md#thickness-from-the-flow)). The "
           "first mesh has the thickness of `first`, `growth` and `count`.",
           {.unit = "length"}),
       key<&LayerKeys::equal>("equal", whole({1, most_layers}),
                              "Number of layers of the first height before the growth begins.",
                              {.example = "2"})}};
  return keys;
}

const KeyTable<WakeKeys>& wake_keys() {
  static const KeyTable<WakeKeys> keys{
      "wake",
      {key<&WakeKeys::line, &LayerLine::from>(
           "from", texts(),
           "The boundary at whose sharp or blunt trailing edge the wake begins; a list if several boundaries "
           "meet there. With layers in the wake they have layers too.",
           {.example = "\"box\"",
            .required =
                {{"the boundary whose edge, sharp or blunt, the wake begins at, or a list of those that "
                  "meet there"}}}),
       key<&WakeKeys::line, &LayerLine::at>(
           "at", point(),
           "A point near the trailing edge, if `from` has several. The nearest edge is used, "
           "at most 1/20 of the extent of the boundary away.",
           {.fallback = "none"}),
       key<&WakeKeys::line, &LayerLine::length>(
           "length", number(io::Range::positive()), "Length of a wake without points.",
           {.unit = "length",
            .needs = {{"no path or path = \"flow\""}},
            .required = {{"how far the wake goes on, or with path where", "no path or path = \"flow\""}}}),
       key<&WakeKeys::course>(
           "path", ValueForm<WakeCourse>{"`[[x, y], ...]` or `\"flow\"`", "[[1, 1], [2, 2]]", read_course},
           "The points of the wake line behind the trailing edge, which is not listed; or `\"flow\"`: the "
           "streamline from the trailing edge in the solution of the previous cycle, see "
           "[boundary layers](../how-to/boundary-layers.md#wakes-that-follow-the-flow).",
           {.fallback = "straight"}),
       key<&WakeKeys::spacing>(
           "spacing", ValueForm<WakeSpacing>{"number, above 0, or two", "0.1", read_wake_spacing},
           "Target cell length along the line. Without layers: cells that intersect the line are no larger "
           "than this; `[0.001, 0.004]`: the size at the trailing edge and, growing linearly, at the end of "
           "the length.",
           {.unit = "length", .required = {{"the length of cells along the line"}}}),
       key<&WakeKeys::has_layers>(
           "layers", flag(),
           "`false`: the wake has no layers; the cells along its line have the size `spacing`. See "
           "[boundary layers](../how-to/boundary-layers.md#wakes-without-layers).",
           {.example = "false"})}};
  return keys;
}

const KeyTable<LayerLineKeys>& layer_line_keys() {
  static const KeyTable<LayerLineKeys> keys{
      "layer_line",
      joined<LayerLineKeys>(
          {{key<&LayerLineKeys::line, &LayerLine::path>("path", path(), "The points of the line.",
                                                        {.required = {{"the points of the line"}}}),
            key<&LayerLineKeys::line, &LayerLine::spacing>(
                "spacing", number(io::Range::positive()), "Target cell length along the line.",
                {.unit = "length", .required = {{"the length of cells along the line"}}})},
           layer_keys().keys_of<&LayerLineKeys::layers>()})};
  return keys;
}

std::vector<std::pair<const char*, BoundaryCondition>> values_of_wall() {
  return {BoundaryCondition::wall_words.begin(), BoundaryCondition::wall_words.end()};
}

const KeyTable<BoundaryKeys>& boundary_keys() {
  static const KeyTable<BoundaryKeys> keys{
      "boundary.NAME",
      {key<&BoundaryKeys::rule, &BoundaryRule::spacing>(
           "spacing", number(io::Range::positive()),
           "Largest cell size on this boundary. An edge between two feature points (a blunt trailing edge) "
           "also requests its own length, down to `spacing.min`.",
           {.unit = "length", .fallback = "point spacing of the geometry"}),
       key<&BoundaryKeys::rule, &BoundaryRule::corner_degrees>(
           "corner", number({0, 180}), "Feature angle of this boundary.",
           {.unit = "degrees", .fallback = "`spacing.corner`"}),
       key<&BoundaryKeys::rule, &BoundaryRule::corner_spacing>(
           "corner_spacing", number(io::Range::positive()),
           "Largest size of cells at a sharp corner of this boundary, where it turns by more than `corner`.",
           {.unit = "length", .fallback = "none"}),
       key<&BoundaryKeys::rule, &BoundaryRule::condition>(
           "bc", choice(values_of_bc()),
           "Boundary condition for the solver. Between two blocks only `wall` and `interface` are possible.",
           {.fallback = "`none`"}),
       key<&BoundaryKeys::wall>("wall", choice(values_of_wall()),
                                "Kind of wall, for formats that distinguish them (CGNS, `.mapbc`). The "
                                "built-in solver uses `viscosity` instead.",
                                {.fallback = "none", .needs = {{"bc = \"wall\""}}}),
       key<&BoundaryKeys::rule, &BoundaryRule::layers>(
           "layers", layers(),
           "Boundary layers, `{ first = 1e-5, growth = 1.2, count = 30 }`; see below and "
           "[layers](../explanation/layers.md).",
           {.fallback = "none"}),
       key<&BoundaryKeys::rule, &BoundaryRule::layers_in>(
           "layers_in", text(),
           "The block in which this boundary has its layers, if it lies between two blocks or bounds "
           "several.",
           {.fallback = "all blocks beside it", .example = "\"fluid\"", .needs = {{"layers"}}}),
       key<&BoundaryKeys::pressure>(
           "pressure", number(io::Range::positive()),
           "Static back pressure divided by the free-stream pressure.",
           {.fallback = "none: supersonic outflow, choked where subsonic", .needs = {{"bc = \"outflow\""}}}),
       key<&BoundaryKeys::wall_temperature>(
           "wall_temperature", number(io::Range::positive()),
           "Wall temperature divided by the free-stream temperature in a viscous flow.",
           {.fallback = "adiabatic",
            .needs = {{"bc = \"wall\""},
                      {"solver.viscosity > 0 or solver.reynolds", "", "solver.kind = \"euler\"", true}}})}};
  return keys;
}

void read_boundary_tables(const io::CaseTable& boundaries, Settings& settings) {
  for (const std::string& name : boundaries.keys()) {
    const auto table = *boundaries.table(name);
    BoundaryKeys keys;
    boundary_keys().read(table, keys);
    BoundaryRule& rule = keys.rule;
    rule.pattern = name;
    rule.where = fmt::format("{}: [{}]", table.place(), boundaries.full_name(name));
    if (keys.wall) rule.condition = *keys.wall;
    if (keys.pressure) settings.solver.pressures.push_back({name, *keys.pressure});
    if (keys.wall_temperature) settings.solver.wall_temperatures.push_back({name, *keys.wall_temperature});
    settings.wants_y_plus = settings.wants_y_plus || (rule.layers && rule.layers->y_plus > 0);
    settings.outline.rules.push_back(std::move(rule));
  }
}

LayerLine read_wake(const io::CaseTable& table) {
  WakeKeys keys;
  wake_keys().read(table, keys);
  LayerLine wake = std::move(keys.line);
  wake.where = table.place();
  wake.path = std::move(keys.course.points);
  wake.follows_flow = keys.course.follows_flow;
  wake.without_layers = !keys.has_layers;
  wake.spacing = keys.spacing.at_edge;
  if (wake.without_layers) wake.spacing_at_end = keys.spacing.at_end;
  if (keys.has_layers && keys.spacing.at_end != keys.spacing.at_edge)
    table.refuse("spacing", "is two sizes, which only a wake with layers = false can have; give one");
  std::erase(wake.from, "");
  if (wake.from.empty()) table.refuse("from", "is empty; name the boundary that the wake begins at");
  return wake;
}

LayerLine read_layer_line(const io::CaseTable& table, Settings& settings) {
  LayerLineKeys keys;
  keys.line.where = table.place();
  layer_line_keys().read(table, keys);
  if (keys.line.path.size() < 2) table.refuse("path", "must have two points at least");
  settings.wants_y_plus = settings.wants_y_plus || keys.layers.first.y_plus > 0;
  if (keys.layers.thickness.follows_flow)
    table.refuse("thickness",
                 "is 'flow', but this line has no wall with a boundary layer; give a number, or "
                 "count alone");
  keys.layers.first.y_plus = 0;  // no wall friction to follow
  keys.line.layers = layers_of(table, keys.layers);
  return keys.line;
}

std::optional<adapt::WallFlow> wall_flow(const Settings& settings) {
  const SolverSettings& solver = settings.solver;
  if (!settings.flow || !settings.wants_y_plus) return {};
  if (solver.kind == SolverSettings::Kind::euler && solver.euler.viscosity > 0)
    return adapt::WallFlow{solver.euler.viscosity, 1};
  const double density = settings.flow->density, speed = settings.flow->speed;
  return adapt::WallFlow{settings.flow->viscosity(), density, 0.5 * density * speed * speed};
}

Warnings unused_flow(const Settings& settings) {
  const bool is_external = settings.solver.kind != SolverSettings::Kind::euler;
  if (!settings.flow || settings.wants_y_plus || (settings.flow->pressure && is_external)) return {};
  return {settings.flow->where + ": [flow] does nothing, as no boundary's layers have a first = \"yplus:1\""};
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
      return other.path == image && other.spacing == line.spacing && other.layers == line.layers &&
             other.follows_flow == line.follows_flow && other.spacing_at_end == line.spacing_at_end;
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
  constexpr double steps = 0x1p-42;  // 1024 floating-point steps: a margin for the tilt of columns
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
