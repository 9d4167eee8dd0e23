#include "io/mesh_file.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>
#include <variant>

#include "io/formats.hpp"
#include "io/model/distribute.hpp"
#include "io/model/fixed_nodes.hpp"
#include "io/model/orient_mesh3d.hpp"
#include "io/model/repeated_rows.hpp"
#include "io/parts/part_index.hpp"
#include "io/parts/part_reader.hpp"
#include "io/stream/block_meshes.hpp"
#include "io/stream/stream_blocks.hpp"
#include "io/text/clean_names.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/suffix.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"

namespace quadloop::io {

namespace {

/// Returns the named format, else that of the suffix; null if it does not support meshes.
const FileFormat* mesh_format(const std::string& path, const std::string& name = {}) {
  const FileFormat* format = name.empty() ? format_of(path) : format_named(name);
  return format != nullptr && format->holds(Content::mesh) ? format : nullptr;
}

/// Returns the named format, else that of the suffix; null if it does not support 3D meshes.
const FileFormat* mesh3d_format(const std::string& path, const std::string& name = {}) {
  const FileFormat* format = name.empty() ? format_of(path) : format_named(name);
  return format != nullptr && format->holds(Content::mesh3d) ? format : nullptr;
}

void write_mesh3d(OutputSet& outputs, const MeshStream& mesh, const std::string& path,
                  const std::string& format) {
  const FileFormat* row = mesh3d_format(path, format);
  QUADLOOP_REQUIRE(row != nullptr, "a 3D mesh is written in a format that holds none");
  row->write(outputs, mesh, path);
}

void clean_up_names(std::vector<std::string*> names, std::optional<Field>& solution, const std::string& path,
                    std::vector<std::string>& warnings) {
  if (solution) append_names(*solution, names);
  std::ranges::move(clean_names(names, path), std::back_inserter(warnings));
  if (solution) require_distinct_variables(*solution, path);
}

void finish_reading(LoadedMesh& loaded, const std::string& path) {
  std::vector<std::string*> names;
  for (BoundaryEdges& boundary : loaded.mesh.boundaries) names.push_back(&boundary.name);
  for (StripLayers& strip : loaded.mesh.strips) names.push_back(&strip.name);
  for (NamedNode& node : loaded.mesh.named_nodes) names.push_back(&node.name);
  for (std::string& block : loaded.block_names) names.push_back(&block);
  clean_up_names(std::move(names), loaded.solution, path, loaded.warnings);
  if (loaded.blocks > 1) loaded.mesh.blocks = plane_blocks(loaded);
}

void finish_reading(FileMesh& mesh, const std::string& path) {
  std::vector<std::string*> names;
  for (FileBoundary& boundary : mesh.boundaries) names.push_back(&boundary.name);
  for (std::string& block : mesh.block_names) names.push_back(&block);
  clean_up_names(std::move(names), mesh.solution, path, mesh.warnings);
  if (const std::int64_t turned = orient_mesh3d(mesh); turned > 0)
    mesh.warnings.push_back(fmt::format("{}: {} inside out and reversed", path,
                                        turned == 1 ? "1 cell was" : fmt::format("{} cells were", turned)));
}

/// Data of a mesh that a format may not support.
struct MeshContent {
  std::vector<std::string> boundary_names, block_names = {};
  std::vector<BoundaryCondition> conditions;  ///< of the boundaries
  std::vector<std::string> interfaces = {};   ///< names of boundaries with an edge between two cells
  std::vector<std::string> lines = {};        ///< names of inner lines
  std::int64_t blocks = 1;
  const Field* solution = nullptr;
  bool has_layers = false, has_pairs = false;
  std::vector<std::string> nodes = {};  ///< names of named nodes
  bool knows_walls = false;             ///< a case determines the conditions, also if all are "none"

  bool knows_conditions() const {
    return knows_walls || std::ranges::any_of(conditions, [](BoundaryCondition condition) {
             return condition != BoundaryCondition::none;
           });
  }
};

template <class Boundaries>
MeshContent content_of(const Boundaries& boundaries) {
  MeshContent content;
  for (const auto& boundary : boundaries) {
    content.boundary_names.push_back(boundary.name);
    content.conditions.push_back(boundary.condition);
  }
  return content;
}

MeshContent content_of(const Mesh& mesh, const Field* solution) {
  MeshContent content = content_of(mesh.boundaries);
  content.has_layers = has_layers(mesh);
  content.has_pairs = !mesh.pairs.empty();
  for (const NamedNode& named : mesh.named_nodes) content.nodes.push_back(named.name);
  content.solution = solution;
  return content;
}

/// Returns, for each boundary, for each of its edges whether it has a cell on its right, too. *Collective.*
std::vector<std::vector<char>> edges_between_cells(const Communicator& comm, const Mesh& mesh) {
  std::vector<std::vector<char>> between;
  const std::vector<std::int64_t> right = cells_right_of_boundaries(comm, mesh);
  auto cell = right.begin();
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    std::vector<char>& flags = between.emplace_back();
    for (std::size_t i = 0; i < boundary.edges.size(); ++i) flags.push_back(*cell++ >= 0 ? 1 : 0);
  }
  return between;
}

/// *Collective.*
std::vector<std::string> names_of_interfaces(const Communicator& comm, const LoadedMesh& mesh) {
  if (mesh.blocks < 2) return {};
  std::vector<std::int64_t> own;  // numbers of boundaries
  for (std::int64_t number = 0; const std::vector<char>& flags : edges_between_cells(comm, mesh.mesh)) {
    if (std::ranges::count(flags, 1) > 0) own.push_back(number);
    ++number;
  }
  const std::vector<std::int64_t> all = comm.all_gather_values(std::span<const std::int64_t>(own));
  std::vector<std::string> names;
  for (std::int64_t number = 0; const BoundaryEdges& boundary : mesh.mesh.boundaries) {
    if (std::ranges::count(all, number++) > 0) names.push_back(boundary.name);
  }
  return names;
}

/// Returns a line that counts the boundaries whose names the format cannot store.
std::vector<std::string> renames_of(const std::vector<std::string>& names, const FileFormat& format,
                                    const std::string& path) {
  if (format.boundary_names == nullptr) return {};
  const std::vector<std::string> written = format.boundary_names(names);
  const auto first = std::ranges::mismatch(names, written);
  if (first.in1 == names.end()) return {};
  std::ptrdiff_t renamed = 0;
  for (std::size_t i = 0; i < names.size(); ++i) renamed += names[i] != written[i] ? 1 : 0;
  return {fmt::format(
      "{}: {} boundar{} renamed, as this format cannot hold every name; the first, '{}', is '{}' there", path,
      renamed, renamed == 1 ? "y is" : "ies are", *first.in1, *first.in2)};
}

/// Returns the condition that a boundary has in a file of the format.
BoundaryCondition condition_in(const FileFormat& format, BoundaryCondition condition) {
  if (!format.holds(Content::conditions)) return BoundaryCondition::none;
  return format.condition_in_file == nullptr ? condition : format.condition_in_file(condition);
}

/// Returns a line on the boundaries whose conditions the format cannot store, by condition; empty if there
/// are none. Between two cells no format has another condition for "none".
std::string lost_conditions(const MeshContent& content, const FileFormat& format, const std::string& path) {
  if (!content.knows_conditions()) return {};
  const bool stores_some = format.holds(Content::conditions);
  std::string list;
  for (const auto& [word, kind] : BoundaryCondition::words) {
    const BoundaryCondition condition = kind, written = condition_in(format, condition);
    std::vector<std::string> names;
    for (std::size_t b = 0; b < content.conditions.size() && written != condition; ++b) {
      const std::string& name = content.boundary_names[b];
      const bool is_open =
          condition == BoundaryCondition::none &&
          std::ranges::count(content.interfaces, name) + std::ranges::count(content.lines, name) > 0;
      if (content.conditions[b] == condition && !is_open) names.push_back(name);
    }
    if (names.empty()) continue;
    const std::string change = stores_some ? fmt::format("{} becomes {}", word, written.word()) : word;
    list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", change, some_names(names));
  }
  if (list.empty()) return {};
  return fmt::format("{}: this format cannot store {}: {}", path,
                     stores_some ? "all boundary conditions" : "boundary conditions, which are omitted",
                     list);
}

/// Appends a line if blocks have names of their own, not "domain" or "block_<number>", and the format cannot
/// store them.
void append_block_names(const FileFormat& format, const MeshContent& content, const std::string& path,
                        std::vector<std::string>& losses) {
  const bool blocks_are_kept = content.blocks == 1 || format.holds(Content::blocks);
  const bool names_are_kept =
      format.holds(Content::block_names) && (content.blocks > 1 || format.single_block_name);
  if (!blocks_are_kept || names_are_kept) return;
  std::vector<std::string> names;
  for (std::size_t b = 0; b < content.block_names.size(); ++b) {
    const std::string usual =
        usual_block_name(static_cast<std::int32_t>(content.blocks), static_cast<std::int32_t>(b));
    if (content.block_names[b] != usual) names.push_back(content.block_names[b]);
  }
  if (!names.empty())
    losses.push_back(fmt::format("{}: this format cannot store the names of blocks, which are omitted: {}",
                                 path, some_names(names)));
}

/// Appends lines on blocks, their names and their interfaces that the format cannot store.
void append_block_losses(const FileFormat& format, const MeshContent& content, const std::string& path,
                         std::vector<std::string>& losses) {
  if (content.blocks > 1 && !format.holds(Content::blocks))
    losses.push_back(path + ": the blocks are written as one");
  if (!content.interfaces.empty() && !format.stores_interfaces)
    losses.push_back(fmt::format(
        "{}: edges between two blocks are no patch in this format and are omitted: {}; OpenFOAM's "
        "'splitMeshRegions -cellZonesOnly' makes patches of them",
        path, some_names(content.interfaces)));
  if (!content.lines.empty() && !format.stores_lines)
    losses.push_back(fmt::format("{}: this format cannot store inner lines, which are omitted: {}", path,
                                 some_names(content.lines)));
  append_block_names(format, content, path, losses);
}

/// Sets the blocks and inner lines of a generated mesh.
void note_blocks(const Mesh& mesh, MeshContent& content) {
  content.blocks = std::max<std::int64_t>(1, std::ssize(mesh.blocks.names));
  content.block_names = mesh.blocks.names;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    if (boundary.between_blocks) content.interfaces.push_back(boundary.name);
    if (boundary.inner_line) content.lines.push_back(boundary.name);
  }
}

std::vector<std::string> losses_of(const MeshContent& content, const FileFormat& format,
                                   const std::string& path) {
  std::vector<std::string> losses = renames_of(content.boundary_names, format, path);
  const auto lose = [&](const char* what) { losses.push_back(path + ": " + what); };
  const Field* const solution = content.solution;
  if (solution != nullptr && !format.holds(Content::solution)) {
    lose("this format cannot store the solution, which is omitted");
  } else if (solution != nullptr && !solution->constants.empty() && !format.holds(Content::constants)) {
    lose("this format cannot store the constants of the solution, which are omitted");
  }
  if (solution != nullptr) {
    if (std::string renames = renames_of_variables(format, *solution, path); !renames.empty())
      losses.push_back(std::move(renames));
  }
  if (std::string lost = lost_conditions(content, format, path); !lost.empty())
    losses.push_back(std::move(lost));
  if (content.has_layers && !format.holds(Content::layers))
    lose("this format cannot store the number of layers, which is omitted");
  if (content.has_pairs && !format.holds(Content::pairs))
    lose("this format cannot store periodic pairs, which are omitted");
  const bool divides_nodes = format.has_zones && content.blocks > 1;
  if (!content.nodes.empty() && (!format.holds(Content::nodes) || divides_nodes))
    losses.push_back(fmt::format("{}: this format cannot store the names of nodes, which are omitted: {}",
                                 path, some_names(content.nodes)));
  append_block_losses(format, content, path, losses);
  if (format.unknown_boundary != nullptr && !content.knows_conditions() && !content.boundary_names.empty())
    losses.push_back(
        fmt::format("{}: the input does not specify which boundaries are walls; each is written as {}. A "
                    ".cgns file contains the conditions of the case: use it as input",
                    path, format.unknown_boundary));
  return losses;
}

/// Returns the mesh with all edges between two blocks in named boundaries; it is gathered for that.
/// *Collective.*
LoadedMesh with_interfaces(const Communicator& comm, const LoadedMesh& mesh) {
  LoadedMesh whole = gathered(comm, mesh);
  comm.together([&] {
    if (comm.is_root()) name_interfaces(whole);
  });
  return distributed(comm, std::move(whole));
}

}  // namespace

void require_readable_suffix(const std::string& path) {
  const FileFormat* const format = format_of(path);
  const bool is_read = format != nullptr && format->is_read();
  if ((is_read && format->holds(Content::mesh)) || is_part_index(path)) return;
  require_kind_of_suffix(path);
  std::error_code no_such_file;
  if (const std::string ours = path + "." + native_format().name; std::filesystem::exists(ours, no_such_file))
    throw InputError(path + ": is no mesh file; do you mean '" + ours + "'?");
  if (is_read && format->holds(Content::mesh3d))
    throw InputError(path + ": contains a 3D mesh, but a 2D mesh is required; give a " +
                     read_suffixes_for({Content::mesh}) + " file");
  if (std::filesystem::is_directory(path, no_such_file))
    throw InputError(path +
                     ": is a folder, not a mesh; name a mesh in it, such as cycle_00/mesh.mesh in the "
                     "folder of an adaptive run");
  throw InputError(path + ": no mesh is read from the format '" + suffix_of(path) + "'; give a " +
                   read_suffixes_for({Content::mesh}) + " file");
}

MeshOfFile read_mesh_file(const Communicator& comm, const std::string& path) {
  const FileFormat* const format = format_of(path);
  comm.together([&] {
    if (!comm.is_root()) return;
    require_kind_of_suffix(path);
    if (format == nullptr || format->read == nullptr) require_readable_suffix(path);
  });
  MeshOfFile mesh;
  if (is_part_index(path)) {
    comm.together([&] {
      if (comm.is_root()) mesh = read_parts(path);
    });
    mesh = distributed(comm, std::move(mesh));
  } else {
    mesh = format->read(comm, path);
  }
  if (LoadedMesh* const plane = std::get_if<LoadedMesh>(&mesh); plane != nullptr)
    separate_pairs(comm, *plane);
  comm.together([&] { std::visit([&](auto& read) { finish_reading(read, path); }, mesh); });
  return mesh;
}

LoadedMesh plane_of(const Communicator& comm, MeshOfFile mesh, const std::string& path) {
  if (std::holds_alternative<LoadedMesh>(mesh)) return std::get<LoadedMesh>(std::move(mesh));
  MeshOfFile plane;
  comm.together([&] {
    if (comm.is_root()) plane = plane_of(std::move(mesh), path);
  });
  return std::get<LoadedMesh>(distributed(comm, std::move(plane)));
}

LoadedMesh read_mesh(const Communicator& comm, const std::string& path) {
  return plane_of(comm, read_mesh_file(comm, path), path);
}

MeshOfFile read_mesh_file(const std::string& path) {
  return read_mesh_file(Communicator(MPI_COMM_SELF), path);
}

LoadedMesh read_mesh(const std::string& path) { return read_mesh(Communicator(MPI_COMM_SELF), path); }

void require_writable_suffix(const std::string& path) {
  if (mesh_format(path) != nullptr) return;
  if (const FileFormat* format = format_of(path); format != nullptr && format->holds(Content::mesh3d))
    throw InputError(path + ": has a format of 3D meshes, which `quadloop extrude` writes; use a " +
                     suffixes_for({Content::mesh}) + " file");
  throw InputError(path + ": no mesh is written in the format '" + suffix_of(path) + "'; name a " +
                   suffixes_for({Content::mesh}) + " file");
}

void write_mesh(OutputSet& outputs, const LoadedMesh& mesh, const std::string& path,
                const std::string& format) {
  const Communicator& comm = outputs.communicator();
  const FileFormat* row = mesh_format(path, format);
  QUADLOOP_REQUIRE(row != nullptr, "a mesh is written in a format that holds none");
  const bool has_zones = row->has_zones && mesh.blocks > 1,
             has_lines = row->stores_lines && !mesh.inner_curves.empty();
  if (!has_zones && !has_lines) return row->write(outputs, MeshStream(comm, mesh), path);
  LoadedMesh written = has_zones ? with_interfaces(comm, mesh) : mesh;
  if (has_lines) list_inner_curves(written);
  row->write(outputs, MeshStream(comm, written, has_lines ? EdgeChoice::all : EdgeChoice::boundaries), path);
}

void write_mesh_file(const Communicator& comm, const LoadedMesh& mesh, const std::string& path,
                     const std::string& format) {
  OutputSet outputs(comm);
  write_mesh(outputs, mesh, path, format);
  outputs.commit();
}

void write_mesh(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Field* solution,
                double gamma) {
  const FileFormat* format = format_of(path);
  QUADLOOP_REQUIRE(format != nullptr, "a mesh is written in a format that there is none of");
  std::optional<PlaneBlocks> blocks;
  if (!mesh.blocks.names.empty()) blocks = mesh.blocks;
  if (format->holds(Content::mesh))
    format->write(outputs,
                  MeshStream(outputs.communicator(), mesh, solution, std::move(blocks),
                             format->stores_lines ? EdgeChoice::all : EdgeChoice::boundaries),
                  path);
  if (format->write_solution != nullptr && solution != nullptr)
    format->write_solution(outputs, mesh, path, *solution, gamma);
}

std::vector<std::string> changes_in(const Mesh& mesh, const std::string& path, const std::string& format) {
  const FileFormat* row = mesh_format(path, format);
  if (row == nullptr) return {};
  MeshContent content = content_of(mesh.boundaries);
  content.knows_walls = true;
  note_blocks(mesh, content);
  std::vector<std::string> changes = renames_of(content.boundary_names, *row, path);
  if (std::string lost = lost_conditions(content, *row, path);
      row->holds(Content::conditions) && !lost.empty())
    changes.push_back(std::move(lost));
  append_block_losses(*row, content, path, changes);
  return changes;
}

std::vector<std::string> losses_in(const Communicator& comm, const LoadedMesh& mesh, const std::string& path,
                                   const std::string& format) {
  const FileFormat* row = mesh_format(path, format);
  if (row == nullptr) return {};
  MeshContent content = content_of(mesh.mesh, mesh.solution ? &*mesh.solution : nullptr);
  content.blocks = mesh.blocks;
  content.block_names = mesh.block_names;
  content.interfaces = names_of_interfaces(comm, mesh);
  for (const BoundaryEdges& curve : mesh.inner_curves) content.lines.push_back(curve.name);
  return losses_of(content, *row, path);
}

std::vector<std::string> losses_in(const FileMesh& mesh, const std::string& path, const std::string& format) {
  const FileFormat* row = mesh3d_format(path, format);
  if (row == nullptr) return {};
  MeshContent content = content_of(mesh.boundaries);
  content.blocks = mesh.has_blocks() ? std::ssize(mesh.block_names) : 1;
  if (mesh.has_blocks()) content.block_names = mesh.block_names;  // the name of a single block is not stored
  content.solution = mesh.solution ? &*mesh.solution : nullptr;
  return losses_of(content, *row, path);
}

std::vector<std::string> losses_in(const ExtrudedMesh& mesh, const std::string& path) {
  const FileFormat* row = mesh3d_format(path);
  if (row == nullptr) return {};
  std::vector<std::string> losses;
  for (const auto& [name, wanted] : {std::pair{&mesh.back, "back"}, std::pair{&mesh.front, "front"}}) {
    if (*name != wanted)
      losses.push_back(
          fmt::format("{}: a boundary is named '{}'; that end of the 3D mesh is '{}'", path, wanted, *name));
  }
  std::vector<BoundaryEdges> sides = mesh.plane.boundaries;
  std::erase_if(sides, &BoundaryEdges::inner_line);
  MeshContent content = content_of(sides);
  content.solution = mesh.solution;
  std::ranges::move(losses_of(content, *row, path), std::back_inserter(losses));
  if (!mesh.plane.pairs.empty() && !row->is_folder)
    losses.push_back(path + ": periodic pairs are written to a polyMesh only, and are omitted");
  if (!mesh.plane.named_nodes.empty())
    losses.push_back(path + ": the names of nodes are not written to a 3D mesh, and are omitted");
  if (sides.size() < mesh.plane.boundaries.size() && !row->is_folder)
    losses.push_back(path + ": inner lines are written to a polyMesh only, and are omitted");
  return losses;
}

std::vector<std::string> losses_in(const Mesh& mesh, const Field* solution, const std::string& path) {
  const FileFormat* row = mesh_format(path);
  if (row == nullptr) return {};
  MeshContent content = content_of(mesh, solution);
  content.knows_walls = true;
  note_blocks(mesh, content);
  return losses_of(content, *row, path);
}

void require_mesh3d_suffix(const std::string& path) {
  if (mesh3d_format(path) != nullptr) return;
  throw InputError(path + ": this format cannot store a 3D mesh; use a " + suffixes_for({Content::mesh3d}) +
                   " (a folder)");
}

void write_mesh(OutputSet& outputs, const ExtrudedMesh& mesh, const std::string& path,
                const std::string& format) {
  write_mesh3d(outputs, MeshStream(outputs.communicator(), mesh), path, format);
}

void write_mesh(OutputSet& outputs, const FileMesh& mesh, const std::string& path,
                const std::string& format) {
  write_mesh3d(outputs, MeshStream(outputs.communicator(), mesh), path, format);
}

std::vector<std::string> drop_interfaces(const Communicator& comm, LoadedMesh& mesh,
                                         const std::string& path) {
  if (mesh.blocks < 2) return {};
  const FileFormat* format = mesh3d_format(path);
  if (format != nullptr && format->has_zones) {
    mesh = with_interfaces(comm, mesh);
    return {};
  }
  const std::vector<std::vector<char>> between = edges_between_cells(comm, mesh.mesh);
  std::int64_t dropped = 0;
  std::vector<BoundaryEdges> kept;
  for (std::size_t b = 0; b < between.size(); ++b) {
    BoundaryEdges& boundary = mesh.mesh.boundaries[b];
    std::size_t edge = 0;
    dropped += std::ssize(boundary.edges);
    std::erase_if(boundary.edges, [&](const auto&) { return between[b][edge++] != 0; });
    dropped -= std::ssize(boundary.edges);
    if (comm.any(!boundary.edges.empty())) kept.push_back(std::move(boundary));
  }
  mesh.mesh.boundaries = std::move(kept);
  dropped = comm.sum(dropped);
  if (dropped == 0) return {};
  return {fmt::format("{}: the {} edges between two blocks are no patch", path, dropped)};
}

}  // namespace quadloop::io
