#include "io/mesh_file.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <numeric>
#include <system_error>
#include <utility>

#include "io/formats.hpp"
#include "io/loaded/repeated_rows.hpp"
#include "io/parts/part_index.hpp"
#include "io/parts/part_reader.hpp"
#include "io/text/clean_names.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/suffix.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"

namespace quadloop {

namespace {

/// The one that is named, else that of the suffix; null where it holds no mesh.
const FileFormat* mesh_format(const std::string& path, const std::string& name = {}) {
  const FileFormat* format = name.empty() ? format_of(path) : format_named(name);
  return format != nullptr && format->holds(Content::mesh) ? format : nullptr;
}

void clean_names_of(LoadedMesh& loaded, const std::string& path) {
  std::vector<std::string*> names;
  for (BoundaryEdges& boundary : loaded.mesh.boundaries) names.push_back(&boundary.name);
  for (StripLayers& strip : loaded.mesh.strips) names.push_back(&strip.name);
  for (std::string& block : loaded.block_names) names.push_back(&block);
  if (loaded.solution) append_names(*loaded.solution, names);
  std::ranges::move(clean_names(names, path), std::back_inserter(loaded.warnings));
}

void append_losses(const FileFormat& format, const Mesh& mesh, const Field* solution, std::int32_t blocks,
                   const std::string& path, std::vector<std::string>& losses) {
  const auto& boundaries = mesh.boundaries;
  if (solution != nullptr && !format.holds(Content::solution)) {
    losses.push_back(path + ": this format has no place for the solution, which is left out");
  } else if (solution != nullptr && !solution->constants.empty() && !format.holds(Content::constants)) {
    losses.push_back(path + ": this format has no place for the solution's constants, which are left out");
  }
  if (solution != nullptr) {
    if (std::string renames = renames_of_variables(format, *solution, path); !renames.empty())
      losses.push_back(std::move(renames));
  }
  if (blocks > 1 && !format.holds(Content::blocks))
    losses.push_back(path + ": the blocks are written as one");
  if (!format.holds(Content::conditions) &&
      std::any_of(boundaries.begin(), boundaries.end(),
                  [](const BoundaryEdges& b) { return b.condition != "none"; }))
    losses.push_back(path + ": this format has no place for boundary conditions, which are left out");
  if (!format.holds(Content::layers) && has_layers(mesh))
    losses.push_back(path + ": this format has no place for the number of layers, which is left out");
}

/// A line where blocks have names of their own, not "domain" or "block_<number>", and the format none.
void append_block_names(const FileFormat& format, const LoadedMesh& whole, const std::string& path,
                        std::vector<std::string>& losses) {
  const bool blocks_are_kept = whole.blocks == 1 || format.holds(Content::blocks);
  const bool names_are_kept =
      format.holds(Content::block_names) && (whole.blocks > 1 || format.single_block_name);
  if (!blocks_are_kept || names_are_kept) return;
  std::vector<std::string> names;
  for (std::size_t b = 0; b < whole.block_names.size(); ++b) {
    const std::string usual = whole.blocks == 1 ? "domain" : fmt::format("block_{}", b + 1);
    if (whole.block_names[b] != usual) names.push_back(whole.block_names[b]);
  }
  if (!names.empty())
    losses.push_back(
        fmt::format("{}: this format has no place for the names of blocks, which are left out: {}", path,
                    some_names(names)));
}

}  // namespace

void require_readable_suffix(const std::string& path) {
  if (mesh_format(path) != nullptr || is_part_index(path)) return;
  require_kind_of_suffix(path);
  std::error_code no_such_file;
  if (const std::string ours = path + "." + native_format().name; std::filesystem::exists(ours, no_such_file))
    throw InputError(path + ": is no mesh file; do you mean '" + ours + "'?");
  if (const FileFormat* format = format_of(path); format != nullptr && format->holds(Content::solid))
    throw InputError(path + ": holds a 3D mesh, where one of two dimensions is wanted; give a " +
                     suffixes_for({Content::mesh}) + " file");
  throw InputError(path + ": no mesh is read from the format '" + suffix_of(path) + "'; give a " +
                   suffixes_for({Content::mesh}) + " file");
}

LoadedMesh read_mesh(const std::string& path) {
  require_kind_of_suffix(path);
  require_readable_suffix(path);
  LoadedMesh loaded = is_part_index(path) ? read_parts(path) : mesh_format(path)->read_mesh(path);
  clean_names_of(loaded, path);
  if (loaded.solution) require_distinct_variables(*loaded.solution, path);
  return loaded;
}

void require_writable_suffix(const std::string& path) {
  if (mesh_format(path) != nullptr) return;
  if (const FileFormat* format = format_of(path); format != nullptr && format->holds(Content::solid))
    throw InputError(path + ": is of a format of 3D meshes, which `quadloop extrude` writes; name a " +
                     suffixes_for({Content::mesh}) + " file");
  throw InputError(path + ": no mesh is written in the format '" + suffix_of(path) + "'; name a " +
                   suffixes_for({Content::mesh}) + " file");
}

void write_mesh(OutputSet& outputs, const LoadedMesh& whole, const std::string& path,
                const std::string& format) {
  const FileFormat* row = mesh_format(path, format);
  QUADLOOP_REQUIRE(row != nullptr, "a mesh is written in a format that holds none");
  if (row->write_blocks != nullptr) return row->write_blocks(outputs, whole, path);
  row->write_mesh(outputs, whole.mesh, path, whole.solution ? &*whole.solution : nullptr);
}

void write_mesh_of_root(const Communicator& comm, const LoadedMesh& whole, const std::string& path,
                        const std::string& format) {
  comm.together([&] {
    if (!comm.is_root()) return;
    const Communicator alone(MPI_COMM_SELF);
    OutputSet outputs(alone);
    write_mesh(outputs, whole, path, format);
    outputs.commit();
  });
}

void write_mesh(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Field* solution,
                double gamma) {
  const FileFormat* format = format_of(path);
  QUADLOOP_REQUIRE(format != nullptr, "a mesh is written in a format that there is none of");
  if (format->write_mesh != nullptr) format->write_mesh(outputs, mesh, path, solution);
  if (format->write_solution != nullptr && solution != nullptr)
    format->write_solution(outputs, mesh, path, *solution, gamma);
}

std::vector<std::string> renames_in(const Mesh& mesh, const std::string& path, const std::string& format) {
  const FileFormat* row = mesh_format(path, format);
  if (row == nullptr || row->boundary_names == nullptr) return {};
  std::vector<std::string> names;
  for (const BoundaryEdges& boundary : mesh.boundaries) names.push_back(boundary.name);
  const std::vector<std::string> written = row->boundary_names(names);
  const auto first = std::mismatch(names.begin(), names.end(), written.begin());
  if (first.first == names.end()) return {};
  const auto kept = std::inner_product(names.begin(), names.end(), written.begin(), std::ptrdiff_t{0},
                                       std::plus<>(), std::equal_to<>());
  const std::ptrdiff_t renamed = std::ssize(names) - kept;
  return {fmt::format(
      "{}: {} boundar{} renamed, as this format cannot hold every name; the first, '{}', is '{}' there", path,
      renamed, renamed == 1 ? "y is" : "ies are", *first.first, *first.second)};
}

std::vector<std::string> losses_in(const LoadedMesh& whole, const std::string& path,
                                   const std::string& format) {
  std::vector<std::string> losses = renames_in(whole.mesh, path, format);
  if (const FileFormat* row = mesh_format(path, format)) {
    append_losses(*row, whole.mesh, whole.solution ? &*whole.solution : nullptr, whole.blocks, path, losses);
    append_block_names(*row, whole, path, losses);
    const bool any_known = std::ranges::any_of(
        whole.mesh.boundaries, [](const BoundaryEdges& boundary) { return boundary.condition != "none"; });
    if (row->unknown_boundary != nullptr && !any_known && !whole.mesh.boundaries.empty())
      losses.push_back(
          fmt::format("{}: nothing says which boundaries are walls; each is written as {}. A .cgns "
                      "holds what the case says: convert that",
                      path, row->unknown_boundary));
  }
  return losses;
}

std::vector<std::string> losses_in(const Mesh& mesh, const Field* solution, const std::string& path) {
  std::vector<std::string> losses = renames_in(mesh, path);
  if (const FileFormat* row = mesh_format(path)) append_losses(*row, mesh, solution, 1, path, losses);
  return losses;
}

}  // namespace quadloop
