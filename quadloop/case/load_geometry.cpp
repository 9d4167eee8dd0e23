#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <set>

#include "io/input/geometry_file.hpp"
#include "io/text/length_units.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/id_vector.hpp"
#include "mesher/base/nearest_word.hpp"
#include "mesher/geometry/assemble/curved_chain.hpp"
#include "mesher/geometry/assemble/mirrored_outline.hpp"
#include "mesher/layers/front/layer_end_error.hpp"
#include "mesher/layers/front/wall_runs.hpp"
#include "quadloop/case/pair_settings.hpp"
#include "quadloop/case/settings.hpp"

namespace quadloop {

namespace {

/// Returns the box of the far field of the saved tree, if its root is one of that size.
Box saved_far_field(const Box& box, const TreeAttributes& saved) {
  constexpr double rounding = 1e-9;
  const Box root = root_box(saved);
  const bool is_root = std::abs(box.width() - root.width()) <= rounding * root.width() &&
                       std::abs(box.height() - root.height()) <= rounding * root.height();
  return is_root ? root : box;
}

/// Records bounding box and unit of a file. Throws InputError if the file must declare a unit and does not.
void note_extent(const GeometryInput& input, const std::vector<Chain>& chains, FileExtent& extent) {
  extent.path = input.path;
  extent.box = box_of(chains);
  if (input.unit == "none") return;
  extent.metres = input.unit == "file" ? extent.declared.metres : *io::metres_in(input.unit);
  if (extent.metres > 0) return;
  throw InputError(fmt::format(
      "{}: geometry.unit = \"file\", but the file declares no unit of length{}; name its unit, as in unit = "
      "\"mm\", or leave unit out to take the coordinates as they stand",
      input.path,
      extent.declared.name.empty() ? "" : fmt::format(" that is known ('{}')", extent.declared.name)));
}

/// Throws InputError for an entry of geometry.layers that matches no layer of any file.
void require_layers(const std::vector<GeometryInput>& files, const std::set<std::string>& known) {
  for (const std::string& pattern : files.front().choice.layers) {
    if (std::ranges::any_of(known, [&](const std::string& name) { return io::matches_layer(pattern, name); }))
      continue;
    const std::vector<std::string> names(known.begin(), known.end());
    throw InputError(fmt::format("{}: geometry.layers: no layer matches '{}'; the layers are: {}{}",
                                 files.front().where, pattern, first_few(names), guess_for(pattern, names)));
  }
}

/// Where the coordinates have a unit.
Transform in_metres(Transform transform, const FileExtent& extent) {
  if (extent.metres > 0) transform.scale *= extent.metres;
  return transform;
}

/// Warns about conditions of boundaries that lie in the dropped half only.
void warn_of_conditions_left_out(const Geometry& whole, const Geometry& half,
                                 const IdVector<BoundaryId, BoundaryId>& images, Warnings& warnings) {
  for (const BoundaryId b : ids_below(BoundaryId{size32(whole.boundaries())})) {
    const Boundary& left_out = whole.boundary(b);
    if (!images[b].valid()) continue;
    const Boundary& image = whole.boundary(images[b]);
    const bool stands = std::ranges::count(half.boundaries(), left_out.name, &Boundary::name) > 0;
    if (stands || left_out.condition == image.condition) continue;
    warnings.push_back(
        fmt::format("mesh.half: boundary '{}' (bc {}) is in the half left out; its mirror image '{}' "
                    "(bc {}) stands for it",
                    left_out.name, left_out.condition.word(), image.name, image.condition.word()));
  }
}

}  // namespace

namespace {

/// The names of the blocks beside a boundary, in their order.
std::set<std::string> blocks_beside(const Geometry& geometry, const Boundary& boundary) {
  std::set<std::string> names;
  for (std::int32_t s = 0; geometry.has_blocks() && s < geometry.size(); ++s) {
    if (geometry.boundary(geometry.boundary_of(s)).name == boundary.name)
      names.insert(geometry.block_names()[geometry.block_of(s)]);
  }
  return names;
}

/// Throws InputError for layers in a block that is not beside their boundary.
void require_blocks_of_layers(const Settings& settings, const Geometry& geometry) {
  for (const Boundary& boundary : geometry.boundaries()) {
    if (!boundary.layers || boundary.layers_in.empty()) continue;
    const std::set<std::string> beside = blocks_beside(geometry, boundary);
    if (beside.contains(boundary.layers_in)) continue;
    const auto rule = std::ranges::find(settings.outline.rules, std::optional(boundary.layers_in),
                                        &BoundaryRule::layers_in);
    throw InputError(fmt::format("{}: layers_in = \"{}\": {}", rule->where, boundary.layers_in,
                                 beside.empty()
                                     ? "the case has no [[block]]; remove this key"
                                     : fmt::format("no block of this name is beside boundary '{}'; name {}",
                                                   boundary.name, fmt::join(beside, " or "))));
  }
}

/// Throws InputError, with the table that gives the layers, where they cannot end on an inner line or on a
/// boundary between two blocks.
void require_ends_of_layers(const Settings& settings, const Geometry& geometry) {
  if (!geometry.has_twins()) return;
  try {
    wall_runs(geometry);
  } catch (const LayerEndError& error) {
    const auto gives = [&](const BoundaryRule& rule) {
      return rule.layers && matches(rule.pattern, error.boundary());
    };
    const auto named = [&](const BoundaryRule& rule) {
      return rule.layers && rule.pattern == error.boundary();
    };
    const auto& rules = settings.outline.rules;
    auto rule = std::ranges::find_if(rules, named);
    if (rule == rules.end()) rule = std::ranges::find_if(rules, gives);
    throw InputError(fmt::format("{}: {}", rule->where, error.what()));
  }
}

/// The blocks on the two sides of a boundary, if it lies between two.
std::optional<std::array<std::string, 2>> blocks_of_interface(const Geometry& geometry,
                                                              const Boundary& boundary) {
  for (std::int32_t s = 0; geometry.has_blocks() && s < geometry.size(); ++s) {
    if (geometry.boundary(geometry.boundary_of(s)).name != boundary.name) continue;
    if (geometry.twin(s) < 0 || geometry.is_inner_line(s)) return std::nullopt;
    const std::int32_t one = geometry.block_of(s), other = geometry.block_of(geometry.twin(s));
    return std::array{geometry.block_names()[std::min(one, other)],
                      geometry.block_names()[std::max(one, other)]};
  }
  return std::nullopt;
}

/// Throws InputError for conditions that need an outside, on boundaries between two blocks; warns of walls.
void check_conditions_of_interfaces(const Settings& settings, const Geometry& geometry, Warnings& warnings) {
  for (const Boundary& boundary : geometry.boundaries()) {
    const BoundaryCondition condition = boundary.condition;
    if (condition == BoundaryCondition::none || condition == BoundaryCondition::interface) continue;
    const auto blocks = blocks_of_interface(geometry, boundary);
    if (!blocks) continue;
    const std::string text = fmt::format("boundary '{}' lies between the blocks '{}' and '{}'", boundary.name,
                                         blocks->front(), blocks->back());
    const std::string remedy = fmt::format("set bc = \"interface\" in [boundary.{}]", boundary.name);
    if (condition.is_wall()) {
      warnings.push_back(
          fmt::format("{}: bc = \"wall\" makes it a wall in both; if it is none, {}", text, remedy));
      continue;
    }
    const auto rule = std::ranges::find_if(settings.outline.rules, [&](const BoundaryRule& one) {
      return one.condition == condition && matches(one.pattern, boundary.name);
    });
    throw InputError(fmt::format("{}: {}, where bc = \"{}\" is not possible; {}", rule->where, text,
                                 condition.word(), remedy));
  }
}

}  // namespace

Geometry load_geometry(const Settings& settings, Warnings& warnings,
                       const std::optional<TreeAttributes>& saved, std::vector<FileExtent>* extents) {
  std::vector<Chain> chains;
  std::set<std::string> layers;
  AssembleOptions options = settings.outline;
  for (const GeometryInput& input : settings.files) {
    std::error_code no_such_file;
    if (!std::filesystem::exists(input.path, no_such_file)) {
      throw InputError(fmt::format(
          "{}: there is no file '{}'; check the name, which is relative to the case file's folder",
          input.where, input.path));
    }
    FileExtent extent;
    std::vector<Chain> of_file = io::read_geometry(input.path, warnings, input.choice, &extent.declared);
    note_extent(input, of_file, extent);
    layers.insert(extent.declared.layers.begin(), extent.declared.layers.end());
    if (extents != nullptr) extents->push_back(extent);
    const Transform transform = in_metres(input.transform, extent);
    if (input.spline) {
      for (Chain& chain : of_file) {
        if (chain.curves.empty()) join_by_splines(chain, options.default_corner_degrees);
      }
    }
    apply(transform, of_file);
    if (!settings.inside && io::is_airfoil_file(input.path)) {
      for (const Chain& chain : of_file) options.bodies.push_back(chain.name);
    }
    std::move(of_file.begin(), of_file.end(), std::back_inserter(chains));
  }
  if (!settings.files.empty()) require_layers(settings.files, layers);
  for (const auto& [chain, is_body, spline] : settings.shapes) {
    chains.push_back(chain);
    if (spline) join_by_splines(chains.back(), options.default_corner_degrees);
    if (is_body && !settings.inside) options.bodies.push_back(chain.name);
  }
  const std::optional<MirrorAxis> axis = settings.half ? settings.half->axis : settings.mesh.mirror;
  if (axis) fit_to_mirror(chains, *axis, warnings);
  if (settings.far_field) {
    const auto& [shape, radius, spacing, where] = *settings.far_field;
    const Box box = far_field_box(chains, shape, radius, where);
    add_far_field(chains, shape, saved ? saved_far_field(box, *saved) : box, where);
    options.far_field = where;
  }
  Geometry geometry = assemble(std::move(chains), options, warnings);
  require_no_conditions(settings, geometry);
  require_blocks_of_layers(settings, geometry);
  require_ends_of_layers(settings, geometry);
  check_conditions_of_interfaces(settings, geometry, warnings);
  if (!axis) return geometry;
  const IdVector<BoundaryId, BoundaryId> images = require_mirror_images(geometry, *axis);
  if (!settings.half) return geometry;
  for (const Boundary& boundary : geometry.boundaries()) {
    if (boundary.name == settings.half->boundary)
      throw InputError(fmt::format(
          "mesh.half: the geometry has a boundary '{}' already; give the axis another name", boundary.name));
  }
  options = settings.outline;
  for (auto& rule : options.rules)
    rule.must_match = false;  // each has matched already; a name may be in the dropped half
  Geometry half = assemble(half_outline(geometry, *axis, settings.half->boundary), options, warnings);
  warn_of_conditions_left_out(geometry, half, images, warnings);
  return half;
}

}  // namespace quadloop
