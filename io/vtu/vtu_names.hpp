#pragma once

// For io/vtu only.
#include <cstddef>
#include <string>
#include <vector>

#include "io/model/file_mesh.hpp"
#include "io/text/text_scanner.hpp"
#include "io/vtu/vtu_arrays.hpp"
#include "io/vtu/vtu_document.hpp"

namespace quadloop::io {

/// The names in the field data of files that this program has written.
struct VtuNames {
  std::vector<std::string> boundaries, blocks;
  bool has_layers = false;  ///< whether heights of layers are among the point data
};

/// Reads the names, and adds boundaries with their layers, blocks, strips, pairs and named nodes to the mesh.
/// Invalid numbers of layers are ignored. Throws InputError.
VtuNames read_vtu_names(const TextScanner& scan, const VtuDocument& document, const VtuNumbers& numbers,
                        FileMesh& mesh);

/// Whether an array is a variable of the solution at points, or in cells: there integers are marks.
bool is_nodal_variable(const VtuArray& array, const VtuNames& names);
bool is_cell_variable(const VtuArray& array);

/// Returns the name of the variable that a component of an array becomes. Throws InputError if the array has
/// more than 9.
std::string name_of_component(const TextScanner& scan, const VtuArray& array, std::size_t component);
/// Whether a component is omitted in a plane mesh if it is 0 everywhere.
inline bool is_third(const VtuArray& array, std::size_t component) {
  return component == 2 && array.components == 3;
}

}  // namespace quadloop::io
