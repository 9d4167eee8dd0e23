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
/// one.
void replace_geometry(const std::string& path, Settings& settings) {
  GeometryInput input{path, path, {}};
  if (!settings.files.empty()) {
    input.transform = settings.files.front().transform;
    input.unit = settings.files.front().unit;
  }
  settings.files = {input};
  settings.shapes.clear();
}

/// Whether the file has a far field of its own.
bool has_far_field(const std::string& path) {
  Warnings told_again_below;
  return std::ranges::count(io::read_geometry(path, told_again_below), "farfield", &Chain::name) > 0;
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

/// The geometry of a case, and what follows from all of it.
struct LoadedGeometry {
  Geometry geometry;
  CellSizes sizes;
};

/// Reads the geometry, and adds to `input` what its files and names give. On the first rank.
LoadedGeometry load_checked_geometry(const CaseArguments& arguments, CaseInput& input, Warnings& warnings) {
  Settings& settings = input.settings;
  if (!arguments.geometry.empty() && settings.far_field && has_far_field(arguments.geometry))
    settings.far_field.reset();
  Geometry geometry = load_geometry(settings, warnings, arguments.saved, &input.extents);
  require_layers_that_doubles_hold(geometry);
  input.part_formats =
      formats_of_parts(arguments.source.path, settings, geometry.block_names().size(), warnings);
  const CellSizes sizes = cell_sizes(settings, geometry);
  if (std::optional<Geometry> merged = short_edges_merged(geometry, sizes.min, warnings))
    geometry = std::move(*merged);
  const MeshOptions options = mesh_options(settings, geometry, sizes);
  if (std::optional<std::string> warning = unit_warning(input.extents, options, geometry))
    warnings.push_back(std::move(*warning));
  for (std::string& warning : spacing_warnings(options, geometry)) warnings.push_back(std::move(warning));
  return {std::move(geometry), sizes};
}

/// Appends the words that the first rank has appended to its list of `before` ones. *Collective.*
void append_of_first(const Communicator& comm, std::size_t before, Warnings& words) {
  const auto begin = words.begin() + static_cast<std::ptrdiff_t>(before);
  const Warnings added = broadcast_words(comm, {begin, words.end()});
  if (!comm.is_root()) words.insert(words.end(), added.begin(), added.end());
}

}  // namespace

CaseInput load_case(const Communicator& comm, const CaseArguments& arguments, Warnings& warnings) {
  CaseInput input;
  Settings& settings = input.settings;
  comm.together([&] {
    if (!arguments.source.text) require_case_file(arguments.source.path);
    settings = read_settings(arguments.source, arguments.assignments);
    if (!arguments.geometry.empty()) replace_geometry(arguments.geometry, settings);
  });
  warnings.insert(warnings.end(), settings.warnings.begin(), settings.warnings.end());
  const std::size_t known_to_all = warnings.size();
  std::optional<Geometry> of_first;
  std::vector<CellSizes> sizes(1);
  comm.on_first([&] {
    LoadedGeometry loaded = load_checked_geometry(arguments, input, warnings);
    of_first = std::move(loaded.geometry);
    sizes.front() = loaded.sizes;
  });
  append_of_first(comm, known_to_all, warnings);
  input.part_formats = broadcast_words(comm, input.part_formats);
  comm.broadcast(sizes);
  Geometry geometry = Geometry::once_per_node(comm, std::move(of_first));
  const MeshOptions options = mesh_options(settings, geometry, sizes.front());
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
