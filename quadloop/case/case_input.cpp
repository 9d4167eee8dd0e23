#include "quadloop/case/case_input.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "adapt/remesh/demands/restart.hpp"
#include "generate/digests.hpp"
#include "io/input/geometry_file.hpp"
#include "io/parts/part_files.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/free_memory.hpp"
#include "mesher/base/suffix.hpp"
#include "mesher/build/short_edges.hpp"
#include "quadloop/case/layer_settings.hpp"

namespace quadloop {

namespace {

/// Rejects a geometry file given in place of a case file, a likely slip.
void require_case_file(const std::string& path) {
  if (std::ranges::count(io::geometry_suffixes(), suffix_of(path)) > 0) {
    throw InputError(path + ": is an outline, not a case file; write a case file with file = \"" + path +
                     "\" in its table [geometry]");
  }
}

/// Replaces the case's geometry files and shapes by `path`, with the placement of the first file, if there is
/// one. It may bring its own far field.
void replace_geometry(const std::string& path, Settings& settings, Warnings& warnings) {
  GeometryInput input{path, path, {}};
  if (!settings.files.empty()) {
    input.transform = settings.files.front().transform;
    input.unit = settings.files.front().unit;
  }
  settings.files = {input};
  settings.shapes.clear();
  if (!settings.far_field) return;
  for (const Chain& chain : io::read_geometry(path, warnings)) {
    if (chain.name == "farfield") settings.far_field.reset();
    if (!settings.far_field) return;
  }
}

/// Returns the formats of the case in which partitions of a mesh with these blocks are written. Throws
/// InputError if there is none; warns about CGNS if there are others.
std::vector<std::string> formats_of_parts(const std::string& case_path, const Settings& settings,
                                          std::size_t blocks, Warnings& warnings) {
  if (settings.partitions == 0) return {};
  std::vector<std::string> formats = io::part_formats(settings.formats, blocks);
  if (formats == io::part_formats(settings.formats)) return formats;
  const std::string reason = fmt::format(
      "{}: 'output.partitions': a CGNS partition has one zone and cannot hold the {} blocks of this mesh; ",
      case_path, blocks);
  if (formats.empty()) throw InputError(reason + "add \"mesh\" or \"vtu\" to output.formats");
  warnings.push_back(reason +
                     fmt::format("the partitions are written as .{} only", fmt::join(formats, ", .")));
  return formats;
}

}  // namespace

CaseInput load_case(const CaseArguments& arguments, Warnings& warnings) {
  if (!arguments.source.text) require_case_file(arguments.source.path);
  CaseInput input;
  Settings& settings = input.settings;
  settings = read_settings(arguments.source, arguments.assignments);
  if (!arguments.geometry.empty()) {
    Warnings told_again_below;
    replace_geometry(arguments.geometry, settings, told_again_below);
  }
  warnings.insert(warnings.end(), settings.warnings.begin(), settings.warnings.end());
  Geometry geometry = load_geometry(settings, warnings, arguments.saved, &input.extents);
  require_layers_that_doubles_hold(geometry);
  input.part_formats =
      formats_of_parts(arguments.source.path, settings, geometry.block_names().size(), warnings);
  const MeshOptions options = mesh_options(settings, geometry);
  if (std::optional<Geometry> merged = short_edges_merged(geometry, options.size.min, warnings))
    geometry = std::move(*merged);
  if (std::optional<std::string> warning = unit_warning(input.extents, options, geometry))
    warnings.push_back(std::move(*warning));
  for (std::string& warning : spacing_warnings(options, geometry)) warnings.push_back(std::move(warning));
  const std::uint64_t digest = case_digest(options, settings.lines, settings.wakes_without_layers);
  input.mesh.emplace(MeshInput{std::move(geometry), options, settings.smooth, digest, settings.lines,
                               settings.stretch, settings.wakes_without_layers});
  if (arguments.saved) adapt::keep_root(*arguments.saved, *input.mesh);
  return input;
}

MeshLimit mesh_limit(const Communicator& comm, const std::optional<double>& max_cells) {
  MeshLimit limit;
  limit.ranks = comm.size();
  if (max_cells)
    limit.cells = *max_cells;
  else
    limit.bytes = free_memory_of_all(comm);
  return limit;
}

}  // namespace quadloop
