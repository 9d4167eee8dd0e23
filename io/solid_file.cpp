#include "io/solid_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <system_error>
#include <utility>

#include "io/formats.hpp"
#include "io/text/clean_names.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/topology.hpp"
#include "mesher/solid/orient_solid.hpp"

namespace quadloop {

namespace {

/// The one that is named, else that of the suffix; null where it holds no 3D mesh.
const FileFormat* solid_format(const std::string& path, const std::string& name = {}) {
  const FileFormat* format = name.empty() ? format_of(path) : format_named(name);
  return format != nullptr && format->holds(Content::solid) ? format : nullptr;
}

void write_stream(OutputSet& outputs, const SolidStream& stream, const std::string& path,
                  const std::string& name) {
  const FileFormat* format = solid_format(path, name);
  QUADLOOP_REQUIRE(format != nullptr, "a 3D mesh is written in a format that holds none");
  format->write_solid(outputs, stream, path);
}

/// A line on the solution, on names of its variables and on those of patches, where the format cannot hold
/// them.
void append_losses(const FileFormat& format, const std::vector<std::string>& names, const Field* solution,
                   const std::string& path, std::vector<std::string>& losses) {
  if (solution != nullptr && !format.solution_in_solid)
    losses.push_back(path + ": this format has no place for the solution, which is left out");
  if (solution != nullptr) {
    if (std::string renames = renames_of_variables(format, *solution, path); !renames.empty())
      losses.push_back(std::move(renames));
  }
  if (format.patch_names == nullptr) return;
  const std::vector<std::string> written = format.patch_names(names);
  const auto first = std::ranges::mismatch(names, written);
  if (first.in1 == names.end()) return;
  losses.push_back(
      fmt::format("{}: this format cannot hold every boundary's name; the first, '{}', is '{}' there", path,
                  *first.in1, *first.in2));
}

/// A line where no boundary has a condition and the format makes a statement of that.
template <class Boundaries>
void append_unknown(const FileFormat& format, const Boundaries& boundaries, const std::string& path,
                    std::vector<std::string>& losses) {
  const bool any_known =
      std::ranges::any_of(boundaries, [](const auto& boundary) { return boundary.condition != "none"; });
  if (format.unknown_boundary == nullptr || any_known || boundaries.empty()) return;
  losses.push_back(
      fmt::format("{}: nothing says which boundaries are walls; each is written as {}. A .cgns holds what "
                  "the case says: begin with that",
                  path, format.unknown_boundary));
}

void clean_solid_names(SolidMesh& mesh, const std::string& path) {
  std::vector<std::string*> names;
  for (SolidPatch& patch : mesh.patches) names.push_back(&patch.name);
  for (std::string& block : mesh.block_names) names.push_back(&block);
  if (mesh.solution) append_names(*mesh.solution, names);
  std::ranges::move(clean_names(names, path), std::back_inserter(mesh.warnings));
}

}  // namespace

void require_solid_suffix(const std::string& path) {
  if (solid_format(path) != nullptr) return;
  throw InputError(path + ": no 3D mesh is written in this format; name a " + suffixes_for({Content::solid}) +
                   " (a folder)");
}

void write_solid(OutputSet& outputs, const ExtrudedMesh& mesh, const std::string& path,
                 const std::string& format) {
  write_stream(outputs, SolidStream(outputs.communicator(), mesh), path, format);
}

void write_solid(OutputSet& outputs, const SolidMesh& mesh, const std::string& path,
                 const std::string& format) {
  write_stream(outputs, SolidStream(outputs.communicator(), mesh), path, format);
}

std::optional<SolidMesh> read_solid(const std::string& path) {
  require_kind_of_suffix(path);
  const FileFormat* format = solid_format(path);
  std::error_code failure;
  const bool in_place = format != nullptr && (std::filesystem::is_regular_file(path, failure) ||
                                              format->is_folder || !format->holds(Content::mesh));
  std::optional<SolidMesh> solid;
  if (in_place) solid = format->read_solid(path);
  if (!solid) return solid;
  clean_solid_names(*solid, path);
  if (solid->solution) require_distinct_variables(*solid->solution, path);
  if (const std::int64_t turned = orient_solid(*solid); turned > 0)
    solid->warnings.push_back(fmt::format("{}: {} inside out and turned", path,
                                          turned == 1 ? "1 cell was" : fmt::format("{} cells were", turned)));
  return solid;
}

std::vector<std::string> drop_interfaces(LoadedMesh& whole, const std::string& path) {
  if (whole.blocks < 2) return {};
  const EdgeTable table(whole.mesh);
  std::size_t dropped = 0;
  for (BoundaryEdges& boundary : whole.mesh.boundaries) {
    dropped += std::erase_if(boundary.edges, [&](const std::array<NodeId, 2>& edge) {
      return table.cell_left_of(edge[0], edge[1]) >= 0 && table.cell_left_of(edge[1], edge[0]) >= 0;
    });
  }
  std::erase_if(whole.mesh.boundaries, [](const BoundaryEdges& boundary) { return boundary.edges.empty(); });
  const FileFormat* format = solid_format(path);
  const bool holds_blocks = format != nullptr && format->blocks_in_solid;
  std::string loss = holds_blocks ? "" : "the blocks are written as one";
  if (dropped > 0)
    loss += fmt::format("{}the {} edges between {} are no patch", holds_blocks ? "" : "; ", dropped,
                        holds_blocks ? "two blocks" : "them");
  if (loss.empty()) return {};
  return {path + ": " + loss};
}

std::vector<std::string> losses_in(const ExtrudedMesh& mesh, const std::string& path) {
  const FileFormat* format = solid_format(path);
  if (format == nullptr) return {};
  std::vector<std::string> losses;
  for (const auto& [name, wanted] : {std::pair{&mesh.back, "back"}, std::pair{&mesh.front, "front"}}) {
    if (*name != wanted)
      losses.push_back(
          fmt::format("{}: a boundary is named '{}'; that end of the 3D mesh is '{}'", path, wanted, *name));
  }
  std::vector<std::string> names;
  for (const BoundaryEdges& boundary : mesh.plane.boundaries) names.push_back(boundary.name);
  append_losses(*format, names, mesh.solution, path, losses);
  append_unknown(*format, mesh.plane.boundaries, path, losses);
  return losses;
}

std::vector<std::string> losses_in(const SolidMesh& mesh, const std::string& path, const std::string& name) {
  const FileFormat* format = solid_format(path, name);
  if (format == nullptr) return {};
  std::vector<std::string> names, losses;
  for (const SolidPatch& patch : mesh.patches) names.push_back(patch.name);
  if (mesh.block_names.size() > 1 && !format->blocks_in_solid)
    losses.push_back(path + ": the blocks are written as one");
  append_losses(*format, names, mesh.solution ? &*mesh.solution : nullptr, path, losses);
  const auto has_condition = [](const SolidPatch& patch) { return patch.condition != "none"; };
  if (!format->conditions_in_solid && std::ranges::any_of(mesh.patches, has_condition))
    losses.push_back(path + ": this format has no place for boundary conditions, which are left out");
  append_unknown(*format, mesh.patches, path, losses);
  return losses;
}

}  // namespace quadloop
