#pragma once

// For io/cgns, and quadloop-reader (io/reader), a separate process.
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/files/placed_array.hpp"
#include "io/model/file_mesh.hpp"
#include "io/model/serialize_mesh.hpp"

namespace quadloop::io {

/// A list of numbers in a CGNS file, which any rank can read if it is one piece of the file. An unknown count
/// means that it cannot be read by ranges.
struct CgnsArray : PlacedArray {
  CgnsArray() = default;
  explicit CgnsArray(std::string path_in_file, std::int64_t count_of_numbers = unknown)
      : path{std::move(path_in_file)} {
    count = count_of_numbers;
  }

  std::string path;  ///< of its node, "/Base/Zone/..."
};

/// A section of triangles or quadrilaterals.
struct CgnsSection {
  CellKind kind = CellKind::triangle;
  std::int64_t cells = 0;
  std::int64_t first_row = 0;  ///< of its cells in arrays of cell values
  CgnsArray nodes;             ///< numbered from 1
};

/// What a CGNS file contains.
struct CgnsContents {
  FileMesh mesh;           ///< by ranges: without points, cells, their blocks, and values
  bool by_ranges = false;  ///< whether what the mesh lacks is in the arrays below
  std::int64_t nodes = 0;
  std::vector<CgnsArray> coordinates;          ///< two or three
  std::vector<CgnsSection> sections;           ///< in the order of the file
  std::vector<CgnsArray> values, cell_values;  ///< one for each variable
};

/// Calls `visit(array)` for all arrays.
template <class ContentsOrConst, class Visit>
void for_each_array(ContentsOrConst& contents, const Visit& visit) {
  for (auto& array : contents.coordinates) visit(array);
  for (auto& section : contents.sections) visit(section.nodes);
  for (auto& array : contents.values) visit(array);
  for (auto& array : contents.cell_values) visit(array);
}

template <class Pipe>
void pass_fields(Pipe& pipe, CgnsArray& array) {
  pass(pipe, array.path, array.count, array.place, array.number, array.big_endian);
}

template <class Pipe>
void pass_fields(Pipe& pipe, CgnsSection& section) {
  pass(pipe, section.kind, section.cells, section.first_row, section.nodes);
}

template <class Pipe>
void pass_fields(Pipe& pipe, CgnsContents& contents) {
  pass(pipe, contents.mesh, contents.by_ranges, contents.nodes, contents.coordinates, contents.sections,
       contents.values, contents.cell_values);
}

}  // namespace quadloop::io
