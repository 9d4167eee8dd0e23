#include "io/formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <system_error>

#include "io/cgns/cgns_file.hpp"
#include "io/cgns/cgns_names.hpp"
#include "io/files/output_path.hpp"
#include "io/files/reading/file_kind.hpp"
#include "io/fluent/fluent_file.hpp"
#include "io/fluent/fluent_zones.hpp"
#include "io/foam/foam_file.hpp"
#include "io/medit/medit_file.hpp"
#include "io/model/distribute.hpp"
#include "io/msh/msh_file.hpp"
#include "io/native/binary_file.hpp"
#include "io/native/native_file.hpp"
#include "io/su2/su2_csv_file.hpp"
#include "io/su2/su2_dat_file.hpp"
#include "io/su2/su2_file.hpp"
#include "io/su2/su2_ranges.hpp"
#include "io/ugrid/ugrid_file.hpp"
#include "io/ugrid/ugrid_plane_file.hpp"
#include "io/vtu/pvtu_file.hpp"
#include "io/vtu/pvtu_text.hpp"
#include "io/vtu/vtkhdf_file.hpp"
#include "io/vtu/vtu_file.hpp"
#include "io/vtu/vtu_ranges.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/suffix.hpp"
#include "mesher/mesh/variable_names.hpp"

namespace quadloop::io {

namespace {

std::vector<std::string> msh_group_names(const std::vector<std::string>& boundaries) {
  std::vector<std::string> names = boundaries;
  std::ranges::transform(boundaries, names.begin(), msh_group_name);
  return names;
}

/// Reads a format that the root reads alone, whole.
template <MeshOfFile (*read)(const std::string&)>
MeshOfFile read_at_root(const Communicator& comm, const std::string& path) {
  MeshOfFile whole;
  comm.together([&] {
    if (comm.is_root()) whole = read(path);
  });
  return distributed(comm, std::move(whole));
}

bool is_regular_file(const Communicator& comm, const std::string& path) {
  std::error_code failure;
  return comm.any(comm.is_root() && std::filesystem::is_regular_file(path, failure));
}

/// Reads a file of the usual form by ranges. Any other one, for which `by_ranges` throws, and a pipe, the
/// root reads alone, whole, also to name the first error.
template <LoadedMesh (*by_ranges)(const Communicator&, const std::string&),
          MeshOfFile (*whole)(const std::string&)>
MeshOfFile read_by_ranges(const Communicator& comm, const std::string& path) {
  if (is_regular_file(comm, path)) {
    try {
      return by_ranges(comm, path);
    } catch (const InputError&) {  // on all ranks
    }
  }
  return read_at_root<whole>(comm, path);
}

LoadedMesh read_su2_by_ranges(const Communicator& comm, const std::string& path) {
  return read_su2_ranges(comm, path);
}

/// Gmsh and Fluent files have the same suffix; a pipe is assumed to be Gmsh.
bool holds_fluent(const std::string& path) {
  std::error_code failure;
  return std::filesystem::is_regular_file(path, failure) && is_fluent(path);
}
MeshOfFile read_msh_or_fluent(const std::string& path) {
  return holds_fluent(path) ? read_fluent(path) : read_msh(path);
}

/// One for each version that is written; both are read under either name.
template <MshVersion version>
FileFormat msh_row(const std::string& name, FileFormat::BytesOfCell bytes) {
  return {.name = name,
          .program = "Gmsh",
          .places = {Content::mesh, Content::blocks, Content::block_names, Content::pairs, Content::nodes,
                     Content::mesh3d},
          .bytes_of_cell = bytes,
          .read = read_at_root<read_msh_or_fluent>,
          .write = [](OutputSet& outputs, const MeshStream& mesh,
                      const std::string& path) { write_msh(outputs, mesh, path, version); },
          .boundary_names = msh_group_names,
          .stores_lines = true};
}

BoundaryCondition mapbc_condition_in_file(BoundaryCondition condition) {
  return condition_of_mapbc(mapbc_condition(condition));
}

/// One for each byte order.
template <std::endian order>
FileFormat ugrid_row(const std::string& name) {
  return {.name = name,
          .program = "AFLR3",
          .places = {Content::blocks, Content::conditions, Content::mesh3d},
          .read = read_at_root<read_ugrid<order>>,
          .write = write_ugrid<order>,
          .boundary_names = mapbc_names,
          .condition_in_file = mapbc_condition_in_file,
          .file_beside = mapbc_path};
}

/// Medit's text format has the suffix of the native one; a pipe is assumed to be native.
MeshOfFile read_native_or_medit(const Communicator& comm, const std::string& path) {
  bool medit = false;
  comm.together([&] {
    std::error_code failure;
    medit = comm.is_root() && std::filesystem::is_regular_file(path, failure) && is_medit(path);
  });
  if (comm.any(medit)) return read_at_root<read_medit>(comm, path);
  return read_native(comm, path);
}

/// Written only if requested by name.
FileFormat medit_row() {
  return {.name = "medit",
          .program = "MMG, FreeFEM",
          .places = {Content::mesh, Content::blocks},
          .bytes_of_cell = {56, 36},
          .read = read_at_root<read_medit>,
          .write = write_medit,
          .boundary_names = medit_boundary_names,
          .stores_lines = true};
}

/// The native formats: text and binary.
std::vector<FileFormat> native_rows() {
  using enum Content;
  return {{.name = "mesh",
           .places = {mesh, solution, constants, blocks, block_names, layers, pairs, nodes},
           .by_default = true,
           .bytes_of_cell = {55, 32},
           .bytes_of_value = 19,
           .read = read_native_or_medit,
           .write = write_native,
           .stores_lines = true},
          {.name = "qmesh",
           .places = {mesh, solution, constants, blocks, block_names, conditions, layers, pairs, nodes},
           .bytes_of_cell = {31, 20},
           .bytes_of_value = 8,
           .read = [](const Communicator& comm, const std::string& path) -> MeshOfFile {
             return read_binary(comm, path);
           },
           .write = write_binary,
           .stores_lines = true}};
}

FileFormat cgns_row() {
  using enum Content;
  return {.name = "cgns",
          .places = {mesh, solution, blocks, block_names, conditions, layers, pairs, nodes, mesh3d},
          .by_default = true,
          .bytes_of_cell = {35, 22},
          .bytes_of_value = 8,
          .read = read_cgns,
          .write = [](OutputSet& outputs, const MeshStream& mesh,
                      const std::string& path) { write_cgns(outputs, mesh, path); },
          .boundary_names = cgns_boundary_names,
          .variable_names = cgns_variable_renames,
          .stores_lines = true,
          .single_block_name = false,
          .has_zones = true};
}

/// A single file; the list of pieces; HDF5, which is only written.
std::vector<FileFormat> vtk_rows() {
  using enum Content;
  return {{.name = "vtu",
           .places = {mesh, solution, blocks, block_names, layers, pairs, nodes, mesh3d},
           .bytes_of_cell = {69, 50},
           .bytes_of_value = 8,
           .without_values = "let the solver save values at points (in ParaView: Cell Data to Point Data)",
           .read = read_by_ranges<read_vtu_ranges, read_vtu>,
           .write = write_vtu,
           .stores_lines = true},
          {.name = "pvtu",
           .program = "VTK",
           .places = {mesh, solution, blocks, block_names, layers, pairs, nodes, mesh3d},
           .bytes_of_cell = {69, 50},
           .bytes_of_value = 8,
           .without_values = "let the solver save values at points (in ParaView: Cell Data to Point Data)",
           .read = read_at_root<read_pvtu>,
           .write = write_pvtu,
           .file_beside = pvtu_piece_path,
           .stores_lines = true},
          {.name = "vtkhdf",
           .program = "VTK",
           .places = {mesh, solution, blocks, block_names, layers, pairs, nodes, mesh3d},
           .bytes_of_cell = {69, 50},
           .bytes_of_value = 8,
           .write = write_vtkhdf,
           .variable_names = vtkhdf_variable_names,
           .stores_lines = true}};
}

FileFormat su2_row() {
  return {.name = "su2",
          .places = {Content::mesh, Content::blocks, Content::block_names, Content::pairs, Content::mesh3d},
          .bytes_of_cell = {65, 44},
          .read = read_by_ranges<read_su2_by_ranges, read_su2>,
          .write = write_su2,
          .boundary_names = su2_marker_names,
          .single_block_name = false,
          .has_zones = true};
}

FileFormat fluent_row() {
  using enum Content;
  return {.name = "fluent.msh",
          .program = "Fluent",
          .places = {mesh, blocks, block_names, conditions, mesh3d},
          .bytes_of_cell = {76, 49},
          .read = read_at_root<read_fluent>,
          .write = write_fluent,
          .boundary_names = fluent_zone_names,
          .condition_in_file =
              [](BoundaryCondition condition) { return condition_of_fluent(fluent_number(condition)); },
          .unknown_boundary = "a wall",
          .stores_lines = true};
}

FileFormat plane_ugrid_row() {
  return {.name = "ugrid",
          .program = "AFLR2",
          .places = {Content::mesh, Content::blocks, Content::conditions},
          .bytes_of_cell = {56, 36},
          .read = read_at_root<read_ugrid_plane>,
          .write = write_ugrid_plane,
          .boundary_names = mapbc_names,
          .condition_in_file = mapbc_condition_in_file,
          .unknown_boundary = "of type 0 in the .mapbc",
          .file_beside = plane_mapbc_path};
}

FileFormat foam_row() {
  using enum Content;
  return {.name = "polyMesh",
          .program = "OpenFOAM",
          .places = {mesh, blocks, block_names, conditions, pairs, mesh3d},
          .bytes_of_cell = {215, 151},
          .read = read_at_root<read_foam>,
          .write = write_foam,
          .boundary_names = foam_patch_names,
          .unknown_boundary = "a plain patch, no wall",
          .stores_interfaces = false,
          .stores_lines = true,
          .single_block_name = false,
          .is_folder = true};
}

/// Formats of solutions without a mesh.
std::vector<FileFormat> rows_of_solutions() {
  using enum Content;
  return {{.name = "csv",
           .program = "SU2",
           .places = {solution},
           .read_solution = read_su2_csv,
           .write_solution = write_su2_csv},
          {.name = "dat",
           .program = "SU2",
           .places = {solution},
           .read_solution = read_su2_dat,
           .write_solution = write_su2_dat}};
}

/// Returns the suffixes of formats in a sentence.
std::string suffixes_in_text(const std::vector<std::string>& names, const std::string& last) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " " + last + " " : ", ";
    text += format_named(names[i])->suffix();
  }
  return text;
}

}  // namespace

const std::vector<FileFormat>& file_formats() {
  static const std::vector<FileFormat> formats = [] {
    std::vector<FileFormat> all = native_rows();
    all.push_back(cgns_row());
    std::ranges::move(vtk_rows(), std::back_inserter(all));
    for (const FileFormat& row :
         {su2_row(), fluent_row(), msh_row<MshVersion::msh_2_2>("msh", {76, 54}),
          msh_row<MshVersion::msh_4_1>("msh41", {72, 47}), ugrid_row<std::endian::big>("b8.ugrid"),
          ugrid_row<std::endian::little>("lb8.ugrid"), plane_ugrid_row(), medit_row(), foam_row()})
      all.push_back(row);
    std::ranges::move(rows_of_solutions(), std::back_inserter(all));
    return all;
  }();
  return formats;
}

bool FileFormat::is_read() const { return read != nullptr || read_solution != nullptr; }

bool FileFormat::holds(Content content) const { return std::ranges::count(places, content) > 0; }

std::string renames_of_variables(const FileFormat& format, const Field& solution, const std::string& path) {
  if (format.variable_names == nullptr) return {};
  std::size_t renamed = 0;
  std::string first;
  for (const auto* names : {&solution.names, &solution.cells.names}) {
    const std::vector<std::string> written = format.variable_names(*names);
    for (std::size_t i = 0; i < names->size(); ++i) {
      if (written[i] == (*names)[i]) continue;
      if (renamed++ == 0) first = fmt::format("'{}', is '{}'", (*names)[i], written[i]);
    }
  }
  if (renamed == 0) return {};
  return fmt::format("{}: {} variable{} renamed, as this format cannot hold every name; the first, {} there",
                     path, renamed, renamed == 1 ? " is" : "s are", first);
}

void require_kind_of_suffix(const std::string& path) {
  const std::optional<FileKind> kind = kind_of_file(path);
  if (!kind || std::ranges::count(kind->suffixes, suffix_of(path)) > 0) return;
  throw InputError(fmt::format(
      "{}: is {}; {}", path, kind->what,
      kind->suffixes.empty() ? kind->cure : "give it a name that ends in " + kind->suffixes.front()));
}

void append_names(Field& solution, std::vector<std::string*>& names) {
  for (std::string& name : solution.names) names.push_back(&name);
  for (std::string& name : solution.cells.names) names.push_back(&name);
}

void require_distinct_variables(const Field& solution, const std::string& path) {
  require_distinct(solution.names, path);
  require_distinct(solution.cells.names, path);
}

const FileFormat* format_named(const std::string& name) {
  const auto found = std::ranges::find(file_formats(), name, &FileFormat::name);
  return found == file_formats().end() ? nullptr : &*found;
}

const FileFormat* format_of(const std::string& path) {
  std::filesystem::path file = path;
  if (!file.has_filename()) file = file.parent_path();  // a folder with a trailing slash
  const std::string name = small_letters(file.filename());
  const auto found = std::ranges::find_if(file_formats(), [&](const FileFormat& format) {
    const std::string ending = small_letters(format.name);
    const bool is_suffix = name.ends_with("." + ending) && name.size() > ending.size() + 1;
    return is_suffix || (format.is_folder && name == ending);
  });
  return found == file_formats().end() ? nullptr : &*found;
}

void require_possible_outputs(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    const FileFormat* const format = format_of(file);
    format != nullptr && format->is_folder ? require_possible_folder(file) : require_possible_output(file);
  }
}

std::vector<std::string> with_files_beside(const std::vector<std::string>& files, const std::string& format) {
  std::vector<std::string> all;
  for (const std::string& file : files) {
    const FileFormat* row = format.empty() ? format_of(file) : format_named(format);
    all.push_back(file);
    if (row != nullptr && row->file_beside != nullptr) all.push_back(row->file_beside(file));
  }
  return all;
}

const FileFormat& native_format() { return file_formats().front(); }

std::vector<std::string> default_formats() {
  std::vector<std::string> names;
  for (const FileFormat& format : file_formats()) {
    if (format.by_default) names.push_back(format.name);
  }
  return names;
}

std::vector<std::string> written_formats() {
  std::vector<std::string> names;
  for (const FileFormat& format : file_formats()) {
    if ((format.holds(Content::mesh) && format.write != nullptr) || format.write_solution != nullptr)
      names.push_back(format.name);
  }
  return names;
}

std::vector<std::string> formats_for(std::initializer_list<Content> contents) {
  std::vector<std::string> names;
  for (const FileFormat& format : file_formats()) {
    if (std::ranges::all_of(contents, [&](Content content) { return format.holds(content); }))
      names.push_back(format.name);
  }
  return names;
}

std::vector<std::string> read_formats_for(std::initializer_list<Content> contents) {
  std::vector<std::string> names = formats_for(contents);
  std::erase_if(names, [](const std::string& name) { return !format_named(name)->is_read(); });
  return names;
}

std::string suffixes_for(std::initializer_list<Content> contents, const std::string& last) {
  return suffixes_in_text(formats_for(contents), last);
}

std::string read_suffixes_for(std::initializer_list<Content> contents, const std::string& last) {
  return suffixes_in_text(read_formats_for(contents), last);
}

}  // namespace quadloop::io
