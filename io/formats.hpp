#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "io/loaded/loaded_mesh.hpp"
#include "io/loaded/loaded_solution.hpp"

namespace quadloop {

/// What a format may have a place for.
enum class Content {
  mesh,
  solution,
  constants,  ///< of the solution
  blocks,
  conditions  ///< of boundaries
};

/// A row of the table of formats. Whoever adds a format adds a folder and a row: commands, case keys and
/// messages list it by what it holds.
struct FileFormat {
  std::string name;             ///< the suffix without its dot
  std::string program;          ///< whose format it is, where the suffix does not tell; may be empty
  std::vector<Content> places;  ///< what it has a place for
  std::string without_values;   ///< what a user is to do where a file holds no solution

  /// The whole of a file with a mesh, or with a solution alone: one of the two is null. On the calling rank
  /// alone. Throws InputError.
  LoadedMesh (*read_mesh)(const std::string& path);
  LoadedSolution (*read_solution)(const std::string& path);

  /// A distributed mesh, and the solution (null: none) as far as there is a place for it; `gamma` is the
  /// ratio of specific heats of its gas. *Collective.* Throws OutputError.
  void (*write)(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Field* solution,
                double gamma);
  /// A mesh that the set's only rank holds whole; null where there is no place for one. Throws OutputError.
  void (*write_whole)(OutputSet& outputs, const LoadedMesh& whole, const std::string& path);

  /// The boundaries' names as a file has them; null: as they are.
  std::vector<std::string> (*boundary_names)(const std::vector<std::string>& names);

  bool holds(Content content) const;
};

/// The table.
const std::vector<FileFormat>& file_formats();

/// The format of this name, or the one that the path's suffix tells; null where it is none.
const FileFormat* format_named(const std::string& name);
const FileFormat* format_of(const std::string& path);

/// The names of all formats that have a place for each of these, in the order of the table.
std::vector<std::string> formats_for(std::initializer_list<Content> contents);

/// The same as suffixes in a sentence: ".mesh, .cgns or .vtu" for last = "or".
std::string suffixes_for(std::initializer_list<Content> contents, const std::string& last = "or");

}  // namespace quadloop
