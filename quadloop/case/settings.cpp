#include "quadloop/case/settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "flow/quantities/flow_quantities.hpp"
#include "io/formats.hpp"
#include "io/input/case_file.hpp"
#include "io/input/geometry_file.hpp"
#include "io/input/length_units.hpp"
#include "io/parts/part_files.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/nearest_word.hpp"
#include "mesher/base/suffix.hpp"
#include "mesher/geometry/boundary_conditions.hpp"
#include "mesher/layers/front/layer_front.hpp"
#include "mesher/sizes/proximity.hpp"
#include "quadloop/case/adapt_settings.hpp"
#include "quadloop/case/layer_settings.hpp"
#include "quadloop/case/smooth_settings.hpp"

namespace quadloop {

namespace {

/// One value for all files, or one for each.
template <class Value>
Value of_file(const CaseTable& table, const std::string& key, const std::vector<Value>& values,
              std::size_t file, std::size_t files, Value absent) {
  if (values.empty()) return absent;
  if (values.size() == 1) return values.front();
  if (values.size() != files) {
    table.refuse(key,
                 fmt::format("is a list of {}, but there are {} files; give one value, or one for each file",
                             values.size(), files));
  }
  return values[file];
}

/// Units of the files' coordinates: one, or one for each file.
std::vector<std::string> read_units(const CaseTable& table) {
  std::vector<std::string> units = table.texts("unit");
  for (const std::string& unit : units) {
    if (unit == "none" || unit == "file" || metres_in(unit)) continue;
    table.refuse("unit", fmt::format("is '{}', but must be \"none\", \"file\" or one of: {}", unit,
                                     fmt::join(length_unit_names(), ", ")));
  }
  return units;
}

void read_geometry_table(const CaseTable& root, const std::string& case_path, Settings& settings) {
  const auto table = root.table("geometry");
  if (!table)
    root.refuse("geometry", "is missing; name the outline, as in [geometry] file = \"outline.geom\"");
  const std::vector<std::string> files = table->texts("file");
  if (files.empty()) table->refuse("file", "is missing; name the outline, as in file = \"outline.geom\"");
  const auto scales = table->numbers_or_one("scale", Range::positive());
  const auto turns = table->numbers_or_one("rotate");
  const auto hinges = table->pairs("rotate_about");
  if (!hinges.empty() && turns.empty())
    table->refuse("rotate_about", "needs rotate, the angle in degrees, in the same table");
  const auto moves = table->pairs("translate");
  const std::vector<std::string> layers = table->texts("layers"), units = read_units(*table);
  if (!layers.empty() && std::ranges::none_of(files, has_layers_of_drawings))
    table->refuse("layers", "chooses layers of drawings and maps, but no file is one");
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto move = of_file(*table, "translate", moves, i, files.size(), {0, 0});
    const double turn = of_file(*table, "rotate", turns, i, files.size(), 0.0);
    const auto hinge = of_file(*table, "rotate_about", hinges, i, files.size(), {0, 0});
    const double scale = of_file(*table, "scale", scales, i, files.size(), 1.0);
    settings.files.push_back({(std::filesystem::path(case_path).parent_path() / files[i]).string(),
                              fmt::format("{}: 'geometry.file'", table->place("file")),
                              {scale, turn, {move[0], move[1]}, {hinge[0], hinge[1]}},
                              layers,
                              of_file(*table, "unit", units, i, files.size(), std::string("none"))});
  }
  if (const auto width = table->number("far_field", Range::positive())) {
    settings.far_field = FarField{*width, fmt::format("{}: 'geometry.far_field'", table->place("far_field"))};
  }
  settings.outline.join = table->number("join", {0, 0.1, true, false}).value_or(settings.outline.join);
  settings.outline.unite_islands = table->choice("overlap", {"error", "union"}) == "union";
  settings.inside = table->flag("inside");
  settings.mesh.may_vanish = table->choice("vanish", {"error", "allow"}) == "allow";
  table->finish();
}

void read_spacing_table(const CaseTable& root, Settings& settings) {
  const auto table = root.table("spacing");
  if (!table) return;
  SizeOptions& size = settings.mesh.size;
  settings.min = table->number("min", Range::positive());
  settings.max = table->number("max", Range::positive());
  size.gradation = table->number("gradation", {1, 2, true, false}).value_or(size.gradation);
  size.curvature = table->number("curvature", {0, 180, true, false});
  size.gap = table->number("gap", {0, 1000, true, false});
  settings.outline.default_corner_degrees =
      table->number("corner", {0, 180}).value_or(settings.outline.default_corner_degrees);
  table->finish();
  if (settings.min && settings.max && *settings.min > *settings.max) {
    table->refuse("min", fmt::format("is {}, but must not be above spacing.max, which is {}", *settings.min,
                                     *settings.max));
  }
}

void read_rules(const CaseTable& root, LayerSettings& layer_settings, Settings& settings) {
  const auto tables = root.table("boundary");
  if (!tables) return;
  for (const std::string& name : tables->table_names()) {
    const auto table = *tables->table(name);
    BoundaryRule rule;
    rule.pattern = name;
    rule.where = fmt::format("{}: [{}]", table.place(), tables->full_name(name));
    rule.spacing = table.number("spacing", Range::positive());
    rule.corner_degrees = table.number("corner", {0, 180});
    rule.corner_spacing = table.number("corner_spacing", Range::positive());
    if (const auto layers = table.table("layers")) rule.layers = layer_settings.read(*layers);
    rule.condition = table.choice("bc", condition_words());
    if (const auto pressure = table.number("pressure", Range::positive())) {
      if (rule.condition != "outflow")
        table.refuse("pressure", "needs bc = \"outflow\" in the same table; elsewhere there is none to set");
      settings.solver.pressures.push_back({name, *pressure});
    }
    if (const auto temperature = table.number("wall_temperature", Range::positive())) {
      if (rule.condition != "wall")
        table.refuse("wall_temperature",
                     "needs bc = \"wall\" in the same table; elsewhere there is none to set");
      settings.solver.wall_temperatures.push_back({name, *temperature});
    }
    if (const auto wall = table.choice("wall", wall_words())) {
      if (rule.condition != "wall")
        table.refuse("wall", "needs bc = \"wall\" in the same table; elsewhere there is none to describe");
      rule.condition = *wall + "_wall";
    }
    table.finish();
    settings.outline.rules.push_back(std::move(rule));
  }
}

void read_boundary_tables(const CaseTable& root, LayerSettings& layer_settings, Settings& settings) {
  if (settings.far_field) {
    settings.outline.rules.push_back(
        {"farfield", {}, {}, "farfield", settings.far_field->where, false, true});  // unless the case says
                                                                                    // other
  }
  read_rules(root, layer_settings, settings);
}

constexpr double largest_coordinate = 1e100;

SizeSource read_source(const CaseTable& table) {
  SizeSource source;
  source.where = table.place();
  const auto box = table.numbers("box", 4);
  const auto disc = table.numbers("disc", 3);
  const auto line = table.numbers("line", 4);
  if (int{box.has_value()} + int{disc.has_value()} + int{line.has_value()} != 1) {
    throw InputError(table.place() +
                     ": a [[source]] needs exactly one of box = [x0, x1, y0, y1], disc = [x, y, radius], "
                     "line = [x0, y0, x1, y1]");
  }
  if (box) {
    const auto& b = *box;
    if (!(b[0] < b[1] && b[2] < b[3]))
      table.refuse("box", "must be [x0, x1, y0, y1] with x0 < x1 and y0 < y1");
    source.shape = Box{{b[0], b[2]}, {b[1], b[3]}};
  } else if (disc) {
    if (!((*disc)[2] > 0)) table.refuse("disc", "must be [x, y, radius] with a radius above 0");
    source.shape = SizeSource::Disc{{(*disc)[0], (*disc)[1]}, (*disc)[2]};
  } else {
    source.shape = SizeSource::Line{{(*line)[0], (*line)[1]}, {(*line)[2], (*line)[3]}};
  }
  for (const auto& [key, numbers] : {std::pair{"box", box}, {"line", line}, {"disc", disc}}) {
    const bool huge = numbers && std::any_of(numbers->begin(), numbers->end(),
                                             [](double v) { return std::abs(v) > largest_coordinate; });
    if (huge) table.refuse(key, "has a number beyond 1e100; no geometry reaches that far");
  }
  const auto spacing = table.number("spacing", Range::positive());
  if (!spacing) table.refuse("spacing", "is missing; a [[source]] needs the spacing that it asks for");
  source.spacing = *spacing;
  table.finish();
  return source;
}

void read_mesh_table(const CaseTable& root, Settings& settings) {
  const auto table = root.table("mesh");
  if (!table) return;
  const auto type = table->choice("type", {"hybrid", "delaunay", "metric"});
  if (type == "delaunay") settings.mesh.type = MeshType::delaunay;
  if (type == "metric") settings.mesh.type = MeshType::metric;
  if (table->choice("quads", {"all", "parallel"}) == "parallel") settings.mesh.quads = QuadChoice::parallel;
  if (const auto axis = table->choice("mirror", {"x", "y"})) {
    if (type == "metric" && !table->has("half"))
      table->refuse("mirror",
                    "keeps no mesh of type = \"metric\" symmetric; mesh one half of it: add half = \"axis\"");
    settings.mesh.mirror = *axis == "x" ? MirrorAxis::x : MirrorAxis::y;
  }
  if (const auto name = table->text("half")) {
    if (!settings.mesh.mirror)
      table->refuse("half", "needs mirror = \"x\" or \"y\" in the same table: of what it is the half");
    const bool is_word = std::ranges::all_of(*name, [](unsigned char c) { return c > ' ' && c != 127; });
    if (name->empty() || name->front() == '#' || !is_word)
      table->refuse("half",
                    "is no name for a boundary; name the one along the axis by a word without blanks");
    settings.half = HalfDomain{*settings.mesh.mirror, *name};
    settings.mesh.mirror.reset();  // the half is no image of itself
    settings.outline.rules.insert(settings.outline.rules.begin(),
                                  {*name, {}, {}, "symmetry", table->place("half"), false, true});
  }
  settings.mesh.snap = table->number("snap", {0, 0.5, false, true}).value_or(settings.mesh.snap);
  if (const auto root_values = table->numbers("root", 5)) {
    const auto& r = *root_values;
    const bool whole = r[3] == std::floor(r[3]) && r[4] == std::floor(r[4]) && r[3] >= 1 && r[4] >= 1 &&
                       r[3] <= 1024 && r[4] <= 1024;
    if (!(r[2] > 0) || !whole) {
      table->refuse("root",
                    "must be [x0, y0, tree edge, trees along x, trees along y] with an edge above 0 and "
                    "whole numbers of trees from 1 to 1024");
    }
    settings.mesh.size.root = RootOptions{{r[0], r[1]}, r[2], static_cast<int>(r[3]), static_cast<int>(r[4])};
  }
  table->finish();
}

/// A list of words, each once; one that is not among the known is refused: "but there are: ...".
std::vector<std::string> read_words(const CaseTable& table, const std::string& key,
                                    const std::vector<std::string>& known, const char* of_known) {
  std::vector<std::string> words;
  for (const std::string& word : table.texts(key)) {
    if (std::ranges::count(known, word) == 0)
      table.refuse(key, fmt::format("holds '{}', but {}: {}{}", word, of_known, fmt::join(known, ", "),
                                    guess_for(word, known)));
    if (std::ranges::count(words, word) == 0) words.push_back(word);
  }
  return words;
}

void read_output_table(const CaseTable& root, const std::string& case_path, Settings& settings) {
  settings.output_prefix = std::filesystem::path(case_path).stem().string();
  settings.formats = default_formats();
  const auto table = root.table("output");
  if (!table) return;
  settings.output_prefix = table->text("prefix").value_or(settings.output_prefix);
  if (settings.output_prefix.empty())
    table->refuse("prefix", "is empty; name what the output files begin with");
  if (const std::string suffix = format_suffix_of(settings.output_prefix); !suffix.empty()) {
    table->refuse("prefix",
                  fmt::format("is '{}'; give it without {}, which is added", settings.output_prefix, suffix));
  }
  if (table->has("formats"))
    settings.formats = read_words(*table, "formats", written_formats(), "this version writes");
  if (table->has("fields")) settings.fields = read_words(*table, "fields", quantity_names(), "there are");
  if (const auto parts = table->number("partitions", {0, 100000})) {
    if (*parts != std::floor(*parts))
      table->refuse("partitions", "must be a whole number, 0 or more; 0 writes no parts");
    settings.partitions = static_cast<std::int32_t>(*parts);
    if (settings.partitions > 0 && part_formats(settings.formats).empty())
      table->refuse("partitions",
                    "needs a format that parts are written in: \"mesh\", \"cgns\" or \"vtu\" "
                    "in output.formats");
  }
  table->finish();
}

void read_design_table(const CaseTable& root, Settings& settings) {
  const auto table = root.table("design");
  if (!table) return;
  settings.morph_to = table->number("morph_to", {0, 1});
  if (settings.morph_to && settings.mesh.mirror)
    table->refuse("morph_to",
                  "does not keep mirror images to the last bit, as mesh.mirror asks; take one out");
  table->finish();
}

/// A mesh that follows a metric wants to be told how many nodes it may have, and what counts.
void require_norm_of_metric(const CaseTable& root, const Settings& settings) {
  if (settings.mesh.type != MeshType::metric || !settings.adapt || settings.adapt->norm) return;
  root.table("adapt")->refuse("norm",
                              "is missing: mesh.type = \"metric\" makes the L^p norm of the interpolation "
                              "error least for max_nodes nodes; give norm = 2 and max_nodes");
}

/// Other solvers, and flows in time, are not ended early.
void require_solver_of_passes(const CaseTable& root, const Settings& settings) {
  if (!settings.adapt || settings.adapt->passes == 0) return;
  if (settings.solver.kind != SolverSettings::Kind::euler)
    root.table("adapt")->refuse("passes",
                                "needs the built-in solver, which can end flows early; leave it out");
  if (settings.solver.euler.time == EulerOptions::Time::accurate)
    root.table("adapt")->refuse("passes", "needs a steady flow, which can be ended early; leave it out");
}

}  // namespace

Settings read_settings(const std::string& case_path, const std::vector<std::string>& assignments) {
  const CaseTable root = read_case(case_path, assignments);
  Settings settings;
  settings.title = root.text("title").value_or("");
  read_geometry_table(root, case_path, settings);
  read_spacing_table(root, settings);
  const auto flow = read_flow_table(root);
  LayerSettings layer_settings(flow);
  read_boundary_tables(root, layer_settings, settings);
  for (const CaseTable& source : root.tables("source"))
    settings.mesh.size.sources.push_back(read_source(source));
  settings.lines = layer_settings.read_lines(root);
  read_mesh_table(root, settings);
  if (settings.mesh.mirror) require_mirrored_lines(settings.lines, *settings.mesh.mirror);
  if (settings.half) require_lines_beside(settings.lines, settings.half->axis);
  read_smooth_table(root, settings);
  settings.adapt = read_adapt_table(root);
  require_norm_of_metric(root, settings);
  require_variables_of_targets(root, settings);
  read_design_table(root, settings);
  read_solver_table(root, settings.solver);
  require_solver_of_passes(root, settings);
  settings.solver.euler.mirror = settings.mesh.mirror;
  settings.warnings = layer_settings.unused(settings.solver);
  if (flow && settings.solver.kind != SolverSettings::Kind::euler) settings.stream = flow->stream();
  if (settings.adapt) settings.adapt->wall_flow = layer_settings.wall_flow(settings.solver);
  for (std::string& warning : idle_wall_temperatures(settings.solver))
    settings.warnings.push_back(std::move(warning));
  for (std::string& warning : forces_without_stream(settings.solver))
    settings.warnings.push_back(std::move(warning));
  for (std::string& warning : exits_into_vacuum(settings.solver, settings.outline.rules))
    settings.warnings.push_back(std::move(warning));
  read_output_table(root, case_path, settings);
  root.finish();
  settings.values = root.values({"title", "output.prefix", "output.partitions", "adapt.cycles", "adapt.until",
                                 "solver.timeout", "solver.ranks"});
  return settings;
}

const AdaptOptions& adapt_options(const Settings& settings, const std::string& case_path) {
  if (settings.adapt) return *settings.adapt;
  throw InputError(case_path + ": has no table [adapt]; it says from what the mesh is to be adapted");
}

std::string format_suffix_of(const std::string& prefix) {
  const std::string suffix = std::filesystem::path(prefix).extension();
  return format_of(prefix) != nullptr || suffix_of(prefix) == ".h5" ? suffix : std::string();
}

namespace {

/// The size down to which leaves must be split for `gap` of them across the narrowest part of the domain, in
/// powers of two below `start`, or `floor`. The leaves then are smaller than twice that.
double size_of_gaps(const Geometry& geometry, double gap, double start, double floor) {
  const Proximity proximity(geometry);
  double size = start;
  while (size > floor && proximity.narrow_parts(2 * gap * size).segments > 0) size /= 2;
  return size;
}

}  // namespace

MeshOptions mesh_options(const Settings& settings, const Geometry& geometry) {
  MeshOptions options = settings.mesh;
  const double side = std::max(geometry.box().width(), geometry.box().height());
  double smallest = side;
  for (std::int32_t s = 0; s < geometry.size(); ++s) {
    smallest = std::min(smallest, geometry.spacing_of(s));
    if (const double at_corner = geometry.corner_spacing_of(s); at_corner > 0)
      smallest = std::min(smallest, at_corner);
  }
  for (const SizeSource& source : settings.mesh.size.sources) smallest = std::min(smallest, source.spacing);
  if (!settings.min) smallest = std::min(smallest, leaf_wanted_by_layers(geometry, settings.lines));
  const double max = settings.max.value_or(std::max(side / 16, settings.min.value_or(0)));
  options.size.max = max;
  // Leaf sizes halve: so there is one at most as large as asked for.
  const double floor = std::ldexp(side, -20);
  options.size.min = settings.min.value_or(std::min(std::max(smallest / 2, floor), max / 2));
  if (!settings.min && options.size.gap)
    options.size.min = size_of_gaps(geometry, *options.size.gap, options.size.min, floor);
  return options;
}

}  // namespace quadloop
