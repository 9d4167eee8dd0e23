#include "quadloop/case/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <span>
#include <utility>

#include "flow/postprocess/flow_quantities.hpp"
#include "io/formats.hpp"
#include "io/parts/part_files.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/suffix.hpp"
#include "mesher/layers/front/layer_front.hpp"
#include "mesher/sizes/proximity.hpp"
#include "quadloop/case/adapt_settings.hpp"
#include "quadloop/case/case_keys.hpp"
#include "quadloop/case/layer_settings.hpp"
#include "quadloop/case/mesh_settings.hpp"
#include "quadloop/case/pair_settings.hpp"
#include "quadloop/case/shape_settings.hpp"
#include "quadloop/case/smooth_settings.hpp"

namespace quadloop {

using io::CaseTable;

namespace {

ValueForm<std::string> prefix() {
  ValueForm<std::string> form = text();
  form.read = [](const CaseTable& table, const std::string& key) {
    const std::string name = *table.text(key), suffix = format_suffix_of(name);
    if (name.empty()) table.refuse(key, "is empty; name what the output files begin with");
    if (!suffix.empty())
      table.refuse(key, fmt::format("is '{}'; give it without {}, which is added", name, suffix));
    return name;
  };
  return form;
}

/// A list of distinct words.
ValueForm<std::vector<std::string>> words(const std::vector<std::string>& known) {
  ValueForm<std::vector<std::string>> form = texts(known);
  form.read = [read = form.read](const CaseTable& table, const std::string& key) {
    std::vector<std::string> once;
    for (const std::string& word : read(table, key)) {
      if (std::ranges::count(once, word) == 0) once.push_back(word);
    }
    return once;
  };
  return form;
}

void read_output_table(const CaseTable& table, Settings& settings) {
  output_keys().read(table, settings);
  if (settings.partitions > 0 && io::part_formats(settings.formats).empty())
    table.refuse("partitions",
                 "needs a format that parts are written in: \"mesh\", \"cgns\" or \"vtu\" in output.formats");
}

void read_design_table(const CaseTable& table, Settings& settings) {
  design_keys().read(table, settings);
  if (settings.morph_to && settings.mesh.mirror)
    table.refuse("morph_to",
                 "does not keep mirror images to the last bit, as mesh.mirror asks; take one out");
}

/// A metric-based mesh needs a number of nodes and a norm.
void require_norm_of_metric(const CaseTable& root, const Settings& settings) {
  if (settings.mesh.type != MeshType::metric || !settings.adapt || settings.adapt->norm) return;
  root.table("adapt")->refuse("norm",
                              "is missing: mesh.type = \"metric\" makes the L^p norm of the interpolation "
                              "error least for max_nodes nodes; give norm = 2 and max_nodes");
}

/// Calls `read` with the table if the case has it.
template <class Read>
void read_table(const CaseTable& root, const std::string& name, const Read& read) {
  if (const auto table = root.table(name)) read(*table);
}

void read_tables(const CaseTable& root, Settings& settings) {
  read_table(root, "spacing", [&](const CaseTable& table) { read_spacing_table(table, settings); });
  settings.flow = read_flow_table(root);
  if (settings.far_field)  // default; overridden by the case
    settings.outline.rules.push_back({"farfield",
                                      settings.far_field->spacing,
                                      {},
                                      BoundaryCondition::farfield,
                                      settings.far_field->where,
                                      false,
                                      true});
  read_table(root, "boundary", [&](const CaseTable& table) { read_boundary_tables(table, settings); });
  for (const CaseTable& source : root.tables("source"))
    settings.mesh.size.sources.push_back(read_source(source));
  for (const CaseTable& block : root.tables("block")) settings.outline.blocks.push_back(read_block(block));
  for (const CaseTable& line : root.tables("line")) read_line(line, settings);
  for (const CaseTable& table : root.tables("wake")) {
    const LayerLine wake = read_wake(table);
    (wake.without_layers ? settings.wakes_without_layers : settings.lines).push_back(wake);
  }
  for (const CaseTable& line : root.tables("layer_line"))
    settings.lines.push_back(read_layer_line(line, settings));
  read_table(root, "mesh", [&](const CaseTable& table) { read_mesh_table(table, settings); });
  if (settings.mesh.mirror) {
    require_mirrored_lines(settings.lines, *settings.mesh.mirror);
    require_mirrored_lines(settings.wakes_without_layers, *settings.mesh.mirror);
  }
  if (settings.half) require_lines_beside(settings.lines, settings.half->axis);
  read_table(root, "smooth", [&](const CaseTable& table) { read_smooth_table(table, settings); });
  settings.adapt = read_adapt_table(root);
  require_norm_of_metric(root, settings);
  require_variables_of_targets(root, settings);
  read_table(root, "design", [&](const CaseTable& table) { read_design_table(table, settings); });
  read_table(root, "solver", [&](const CaseTable& table) { read_solver_table(table, settings.solver); });
  read_table(root, "output", [&](const CaseTable& table) { read_output_table(table, settings); });
}

/// A setting that something else excludes: whether the case has it, and its name with the remedy.
using Excluded = std::pair<bool, const char*>;

/// Throws InputError for the first excluded setting of the case. `mesh` has what excludes it, the table of
/// this name at `where`.
void refuse_excluded(std::span<const Excluded> others, const std::string& where, const char* mesh,
                     const char* table) {
  for (const auto& [is_set, what] : others) {
    if (is_set)
      throw InputError(fmt::format("{}: a mesh {} cannot have {} or [[{}]]", where, mesh, what, table));
  }
}

/// Throws InputError for settings with which single points cannot stay nodes.
void require_fixed_points(const Settings& settings) {
  const std::vector<RequiredPoint>& points = settings.mesh.required_points;
  if (points.empty()) return;
  const Excluded others[] = {
      {settings.mesh.mirror.has_value(), "mirror images; remove mesh.mirror"},
      {settings.stretch.has_value(), "r-adaptation; remove it from [smooth]"},
      {settings.mesh.type == MeshType::metric, "anisotropic adaptation; set mesh.type to delaunay"},
      {settings.morph_to.has_value(), "morphing; remove design.morph_to"},
      {settings.partitions > 0, "partitions; remove output.partitions"}};
  refuse_excluded(others, points.front().where, "with single points as nodes", "line");
}

/// Throws InputError for settings that do not work with several blocks or inner lines yet.
void require_blocks_alone(const Settings& settings) {
  const AssembleOptions& outline = settings.outline;
  if (outline.blocks.empty() && outline.lines.empty()) return;
  const bool lines = !outline.lines.empty();
  const Excluded others[] = {
      {!settings.lines.empty() || !settings.wakes_without_layers.empty(),
       "wakes and free lines with layers; remove [[wake]] and [[layer_line]]"},
      {settings.mesh.mirror.has_value() || (!outline.blocks.empty() && settings.half),
       "mirror images; remove mesh.mirror"},
      {outline.unite_islands, "a union of islands; remove geometry.overlap"},
      {settings.stretch.has_value(), "r-adaptation; remove it from [smooth]"},
      {settings.mesh.type == MeshType::metric, "anisotropic adaptation; set mesh.type to delaunay"},
      {settings.adapt && !outline.blocks.empty() && settings.solver.kind == SolverSettings::Kind::euler,
       "the built-in solver in the loop; set solver.kind = \"command\""},
      {settings.adapt && settings.solver.kind != SolverSettings::Kind::command &&
           settings.solver.kind != SolverSettings::Kind::euler,
       "OpenFOAM or SU2 in the loop; set solver.kind = \"command\""}};
  refuse_excluded(others, lines ? outline.lines.front().where : outline.blocks.front().where,
                  lines ? "with inner lines" : "of several blocks", lines ? "line" : "block");
}

/// Returns warnings about keys of the case that have no effect.
Warnings unused_settings(const CaseTable& root, const Settings& settings) {
  Warnings warnings = root.warnings();
  for (const Warnings& more : {unused_flow(settings), forces_without_stream(settings.solver),
                               exits_into_vacuum(settings.solver, settings.outline.rules)})
    warnings.insert(warnings.end(), more.begin(), more.end());
  return warnings;
}

}  // namespace

const KeyTable<Settings>& title_keys() {
  static const KeyTable<Settings> keys{
      "", {key<&Settings::title>("title", text(), "A title for the reader. It has no effect on the mesh.")}};
  return keys;
}

const KeyTable<Settings>& design_keys() {
  static const KeyTable<Settings> keys{
      "design",
      {key<&Settings::morph_to>("morph_to", number({0, 1}),
                                "Smallest mesh quality at which a mesh is [morphed](../how-to/morph.md) to a "
                                "changed geometry; below it, the geometry is meshed again.",
                                {.fallback = "none"})}};
  return keys;
}

const KeyTable<Settings>& output_keys() {
  static const KeyTable<Settings> keys{
      "output",
      {key<&Settings::output_prefix>(
           "prefix", prefix(),
           "Prefix of the output files without suffix, relative to the current folder. `-o` overrides it. It "
           "does not apply to `adapt`, whose folder `-o` sets.",
           {.fallback = "name of the case file"}),
       key<&Settings::formats>(
           "formats", words(io::written_formats()),
           "Mesh formats: " + words_in_text(io::written_formats()) +
               "; `csv` and `dat` for the solution alone (the command `mesh` has none and reports this). "
               "`PREFIX.tree.h5` is always written. `adapt` writes the formats in each cycle, and `.mesh` "
               "and `.cgns` in any case.",
           {.example = "[\"vtu\", \"mesh\"]"}),
       key<&Settings::fields>(
           "fields", words(flow::quantity_names()),
           "Derived fields: " + words_in_text(flow::quantity_names()) +
               ". `solve` adds them to OUT. With the built-in solver, `adapt` adds them to all files of a "
               "cycle except `.mesh`, which is the restart file.",
           {.fallback = "none"}),
       key<&Settings::partitions>(
           "partitions", whole({0, 100000}),
           "Above 0: also write the mesh in this number of [partitions](formats.md#partitioned-meshes), one "
           "for each rank of a solver.",
           {.example = "2"})}};
  return keys;
}

Settings read_settings(const io::CaseSource& source, const std::vector<std::string>& assignments) {
  const CaseTable root = io::read_case(source, assignments);
  const std::string& case_path = source.path;
  refuse_unknown_keys(root, root_names());
  Settings settings;
  settings.output_prefix = std::filesystem::path(case_path).stem().string();
  settings.title = root.text("title").value_or("");
  read_table(root, "geometry",
             [&](const CaseTable& table) { read_geometry_table(table, case_path, settings); });
  for (const CaseTable& shape : root.tables("shape")) settings.shapes.push_back(read_shape(shape));
  if (settings.files.empty() && settings.shapes.empty())
    root.refuse("geometry",
                "needs an outline; name one, as in [geometry] file = \"outline.geom\", or add a [[shape]]");
  for (const CaseTable& pair : root.tables("pair")) {
    settings.outline.pairs.push_back(read_pair(pair));
    settings.mesh.pairs.push_back(settings.outline.pairs.back().pair);
  }
  read_tables(root, settings);
  require_blocks_alone(settings);
  require_fixed_points(settings);
  require_plain_pairs(settings);
  settings.solver.euler.mirror = settings.mesh.mirror;
  const bool is_built_in = settings.solver.kind == SolverSettings::Kind::euler;
  if (settings.flow && !is_built_in) settings.stream = settings.flow->stream();
  if (settings.adapt) settings.adapt->wall_flow = wall_flow(settings);
  settings.warnings = unused_settings(root, settings);
  settings.values = root.values({"title", "output.prefix", "output.partitions", "adapt.cycles", "adapt.until",
                                 "solver.timeout", "solver.ranks"});
  return settings;
}

const adapt::AdaptOptions& adapt_options(const Settings& settings, const std::string& case_path) {
  if (settings.adapt) return *settings.adapt;
  throw InputError(case_path +
                   ": has no table [adapt]; add it with the key `variable`, the variable that "
                   "the mesh is adapted to");
}

std::string format_suffix_of(const std::string& prefix) {
  const std::string suffix = std::filesystem::path(prefix).extension();
  return io::format_of(prefix) != nullptr || suffix_of(prefix) == ".h5" ? suffix : std::string();
}

namespace {

/// Returns the quadtree cell size that gives `gap` cells across the narrowest part of the domain, in powers
/// of two below `start`, or `floor`. The cells are smaller than twice that size.
double size_of_gaps(const Geometry& geometry, double gap, double start, double floor) {
  const Proximity proximity(geometry);
  double size = start;
  while (size > floor && proximity.narrow_parts(2 * gap * size).segments > 0) size /= 2;
  return size;
}

/// The cells of a mesh with a round far field, over the requested size. A circle cuts cells along their edges
/// and along their diagonals, so that the median edge on it is 1 / cos(22.5 degrees) = 1.08 cells long. With
/// smaller cells both the cells and the edges on the circle have the requested size within 4 %.
double cells_of_far_field(const Settings& settings) {
  constexpr double in_round_ones = 0.961;  // sqrt(cos(22.5 degrees))
  const bool is_round = settings.far_field && (settings.far_field->shape == FarFieldShape::circle ||
                                               settings.far_field->shape == FarFieldShape::rounded_front);
  return is_round ? in_round_ones : 1;
}

/// The size that the root of the quadtrees is to meet: the smallest that the case specifies for a boundary,
/// by its spacing or by its last layer, else spacing.max, else `smallest`.
double size_to_meet(const Settings& settings, const Geometry& geometry, double smallest) {
  double finest = std::numeric_limits<double>::infinity();
  for (const Boundary& boundary : geometry.boundaries()) {
    if (boundary.spacing > 0) finest = std::min(finest, boundary.spacing);
    if (boundary.layers)
      finest = std::min(finest, leaf_over_last_layer * layer_heights(*boundary.layers).back());
  }
  return std::isfinite(finest) ? finest : settings.max.value_or(smallest);
}

/// Adds the cell sizes of blocks to the sources.
void add_block_sizes(const Settings& settings, const Geometry& geometry, MeshOptions& options) {
  const std::vector<std::string>& names = geometry.block_names();
  for (const BlockRule& rule : settings.outline.blocks) {
    if (!rule.spacing) continue;
    const auto block = static_cast<std::int32_t>(std::ranges::find(names, rule.name) - names.begin());
    options.size.sources.push_back(
        {SizeSource::Block{rule.name, std::make_shared<OutlineRegion>(geometry, block)}, *rule.spacing,
         rule.where});
  }
}

}  // namespace

CellSizes cell_sizes(const Settings& settings, const Geometry& geometry) {
  const double side = std::max(geometry.box().width(), geometry.box().height());
  double smallest = side;
  for (std::int32_t s = 0; s < geometry.size(); ++s) {
    smallest = std::min(smallest, geometry.spacing_of(s));
    if (const double at_corner = geometry.corner_spacing_of(s); at_corner > 0)
      smallest = std::min(smallest, at_corner);
  }
  for (const SizeSource& source : settings.mesh.size.sources) smallest = std::min(smallest, source.spacing);
  for (const BlockRule& rule : settings.outline.blocks) {
    if (rule.spacing) smallest = std::min(smallest, *rule.spacing);
  }
  for (const LayerLine& wake : settings.wakes_without_layers) smallest = std::min(smallest, wake.spacing);
  const double aim = cells_of_far_field(settings) * size_to_meet(settings, geometry, smallest);
  if (!settings.min) smallest = std::min(smallest, leaf_wanted_by_layers(geometry, settings.lines));
  const double max = settings.max.value_or(std::max(side / 16, settings.min.value_or(0)));
  // Sizes halve, so the next one is at most as large as the requested size.
  const double floor = std::ldexp(side, -20);
  double min = settings.min.value_or(std::min(std::max(smallest / 2, floor), max / 2));
  if (!settings.min && settings.mesh.size.gap)
    min = size_of_gaps(geometry, *settings.mesh.size.gap, min, floor);
  return {min, max, std::clamp(aim, min, max)};
}

MeshOptions mesh_options(const Settings& settings, const Geometry& geometry, const CellSizes& sizes) {
  MeshOptions options = settings.mesh;
  add_block_sizes(settings, geometry, options);
  options.size.min = sizes.min;
  options.size.max = sizes.max;
  options.size.aim = sizes.aim;
  for (const PeriodicPair& pair : options.pairs) options.size.periods.push_back(pair.translation);
  return options;
}

}  // namespace quadloop
