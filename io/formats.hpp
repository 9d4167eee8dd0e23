#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "io/model/loaded_solution.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop {

/// What a format may have a place for.
enum class Content {
  mesh,
  solution,
  constants,  ///< of the solution
  blocks,
  block_names,
  conditions,  ///< of boundaries
  layers,      ///< on boundaries: how many
  solid        ///< a 3D mesh
};

/// A row of the table of formats: a file holds a mesh of two dimensions or of three (some formats have both),
/// often with a solution, or a solution alone. Whoever
/// adds a format adds a folder and a row: commands, case keys and messages list it by what it has a place
/// for.
struct FileFormat {
  std::string name;             ///< the suffix without its dot; of a folder its own name, or the suffix of it
  std::string program = {};     ///< whose format it is, where the suffix does not tell
  std::vector<Content> places;  ///< what it has a place for
  bool by_default = false;      ///< written unless a case says otherwise, and in each cycle of a run
  /// What a user is to do where a mesh comes without a solution.
  std::string without_values = "let the solver append its variables, a row of values for each node";

  /// On the calling rank alone; null: no mesh is read. Throws InputError.
  MeshOfFile (*read)(const std::string& path) = nullptr;
  /// A mesh of the dimensions that there is a place for. *Collective.* Throws OutputError.
  void (*write)(OutputSet& outputs, const MeshStream& mesh, const std::string& path) = nullptr;
  /// The boundaries' names as a file has them; null: as they are.
  std::vector<std::string> (*boundary_names)(const std::vector<std::string>& names) = nullptr;

  /// Of a solution's variables those names that it cannot hold as a file has them, the others as they are;
  /// null: it holds all.
  std::vector<std::string> (*variable_names)(const std::vector<std::string>& names) = nullptr;
  /// What a boundary becomes that nothing is known of, where other programs take that for a statement; null:
  /// nothing.
  const char* unknown_boundary = nullptr;
  /// The second file that is written with one of this name; null: there is none.
  std::string (*file_beside)(const std::string& path) = nullptr;

  /// A solution alone, as above; `gamma` is the ratio of specific heats of its gas.
  LoadedSolution (*read_solution)(const std::string& path) = nullptr;
  void (*write_solution)(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Field& solution,
                         double gamma) = nullptr;

  bool single_block_name = true;  ///< whether names of blocks have a place also where there is only one
  bool is_folder = false;

  bool holds(Content content) const;
  std::string suffix() const { return (is_folder ? "" : ".") + name; }  ///< as sentences have it
};

/// The table.
const std::vector<FileFormat>& file_formats();

/// A line on variables whose names a format cannot hold; empty where there are none.
std::string renames_of_variables(const FileFormat& format, const Field& solution, const std::string& path);

/// Throws InputError where a file is by its first bytes of a kind that is not read under its suffix, and says
/// what it is.
void require_kind_of_suffix(const std::string& path);

/// Adds the names of all variables, of nodes and of cells, to a list for clean_names().
void append_names(Field& solution, std::vector<std::string*>& names);

/// Throws InputError where two variables, of nodes or of cells, have one name to the letter.
void require_distinct_variables(const Field& solution, const std::string& path);

/// The format of this name, or the one that the path's suffix tells; null where it is none.
const FileFormat* format_named(const std::string& name);
const FileFormat* format_of(const std::string& path);

/// Each file, and after it the one that is written beside it in its format: the named one, else that of its
/// suffix.
std::vector<std::string> with_files_beside(const std::vector<std::string>& files,
                                           const std::string& format = {});

/// Refuses those that cannot become a file, or a folder, of their format; what has no format is a file. Found
/// out before an hour of work goes into them. Throws OutputError.
void require_possible_outputs(const std::vector<std::string>& files);

/// The first row: the program's own, which keeps mesh and solution to the bit.
const FileFormat& native_format();

/// The names of those that are written by default, in the order of the table: the program's own first.
std::vector<std::string> default_formats();

/// The names of those in which a plane mesh, or its solution, is written.
std::vector<std::string> written_formats();

/// The names of all formats that have a place for each of these, in the order of the table.
std::vector<std::string> formats_for(std::initializer_list<Content> contents);

/// The same as suffixes in a sentence: ".mesh, .cgns or .vtu" for last = "or".
std::string suffixes_for(std::initializer_list<Content> contents, const std::string& last = "or");

}  // namespace quadloop
