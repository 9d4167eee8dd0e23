#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "io/model/loaded_solution.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop::io {

/// Data that a format may support.
enum class Content {
  mesh,
  solution,
  constants,  ///< of the solution
  blocks,
  block_names,
  conditions,  ///< of boundaries
  layers,      ///< number of layers on boundaries
  pairs,       ///< periodic pairs of boundaries
  nodes,       ///< named nodes
  mesh3d       ///< a 3D mesh
};

/// An entry of the table of formats: a file contains a 2D or 3D mesh (some formats support both), often with
/// a solution, or a solution alone. To add a format, add a folder and an entry: commands, case keys and
/// messages list it by its supported data.
struct FileFormat {
  std::string name;             ///< suffix without its dot; for a folder its name, or its suffix
  std::string program = {};     ///< program of the format, if the suffix does not tell
  std::vector<Content> places;  ///< supported data
  bool by_default = false;      ///< written by default, and in each cycle of a run
  /// Approximate size of a plane mesh in bytes for each quadrilateral, if most cells are, and each triangle,
  /// with numbers of six digits and without a solution.
  struct BytesOfCell {
    double quad = 0, triangle = 0;
  } bytes_of_cell = {};
  double bytes_of_value = 0;  ///< approximate size of a value of a solution
  /// What the user should do if a mesh has no solution.
  std::string without_values = "let the solver append its variables, a row of values for each node";

  /// Reads a mesh: a plane one is distributed, in the order of the file, a 3D mesh is whole on the root.
  /// Null: no mesh is read from this format. Throws InputError on all ranks. *Collective.*
  MeshOfFile (*read)(const Communicator& comm, const std::string& path) = nullptr;
  /// Writes a mesh of a supported dimension. Throws OutputError. *Collective.*
  void (*write)(OutputSet& outputs, const MeshStream& mesh, const std::string& path) = nullptr;
  /// Returns the boundaries' names in the file; null: unchanged.
  std::vector<std::string> (*boundary_names)(const std::vector<std::string>& names) = nullptr;

  /// Returns the variable names of a solution, with those that cannot be stored replaced by their names in
  /// the file; null: all can be stored.
  std::vector<std::string> (*variable_names)(const std::vector<std::string>& names) = nullptr;
  /// Returns the condition that a file of this format has for a boundary of a given one; null: the same.
  BoundaryCondition (*condition_in_file)(BoundaryCondition condition) = nullptr;
  /// Condition that other programs assume for a boundary without one; null: none.
  const char* unknown_boundary = nullptr;
  /// Returns the second file that is written with one of this name; null: there is none.
  std::string (*file_beside)(const std::string& path) = nullptr;

  /// As above for a solution alone, of which each rank gets an even share of the rows; `gamma` is the ratio
  /// of specific heats of its gas.
  LoadedSolution (*read_solution)(const Communicator& comm, const std::string& path) = nullptr;
  void (*write_solution)(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Field& solution,
                         double gamma) = nullptr;

  bool stores_interfaces = true;  ///< whether boundaries between two blocks can be stored
  bool stores_lines = false;      ///< whether inner lines can be stored, beside the boundaries
  bool single_block_name = true;  ///< whether the name of a single block can be stored
  bool has_zones = false;         ///< whether each block has its own nodes, and both the faces between them
  bool is_folder = false;

  bool holds(Content content) const;
  bool is_read() const;                                                 ///< or only written
  std::string suffix() const { return (is_folder ? "" : ".") + name; }  ///< for use in sentences
};

/// Returns the table.
const std::vector<FileFormat>& file_formats();

/// Returns a line on variables whose names a format cannot store; empty if there are none.
std::string renames_of_variables(const FileFormat& format, const Field& solution, const std::string& path);

/// Throws InputError if a file is, by its first bytes, of a kind that is not read under its suffix; the
/// message names the kind.
void require_kind_of_suffix(const std::string& path);

/// Appends the names of all variables, nodal and cell, to a list for clean_names().
void append_names(Field& solution, std::vector<std::string*>& names);

/// Throws InputError if two variables, nodal or cell, have identical names.
void require_distinct_variables(const Field& solution, const std::string& path);

/// Return the format of this name, or that of the path's suffix; null if there is none.
const FileFormat* format_named(const std::string& name);
const FileFormat* format_of(const std::string& path);

/// Returns each file, followed by the second file of its format, if any: the named format, else that of the
/// suffix.
std::vector<std::string> with_files_beside(const std::vector<std::string>& files,
                                           const std::string& format = {});

/// Rejects outputs that cannot become a file, or a folder, of their format, before any work; a path without a
/// format is a file. Throws OutputError.
void require_possible_outputs(const std::vector<std::string>& files);

/// Returns the first entry: the native format, which stores mesh and solution bitwise.
const FileFormat& native_format();

/// Returns the names of the formats written by default, in the order of the table: the native one first.
std::vector<std::string> default_formats();

/// Returns the names of the formats for plane meshes, or their solutions.
std::vector<std::string> written_formats();

/// Returns the names of all formats that support all of these, in the order of the table.
std::vector<std::string> formats_for(std::initializer_list<Content> contents);

/// Returns those of them that are also read.
std::vector<std::string> read_formats_for(std::initializer_list<Content> contents);

/// Return the same as suffixes in a sentence: ".mesh, .cgns or .vtu" for last = "or".
std::string suffixes_for(std::initializer_list<Content> contents, const std::string& last = "or");
std::string read_suffixes_for(std::initializer_list<Content> contents, const std::string& last = "or");

}  // namespace quadloop::io
