#pragma once

// For io/cgns only.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/cgns/cgns_contents.hpp"
#include "io/cgns/cgns_handle.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/field.hpp"

namespace quadloop::io {

/// A zone of an open file, with its declared numbers of nodes and cells.
struct CgnsZone {
  const CgnsFile& file;
  int base = 1, zone = 1;
  cgsize_t nodes = 0, cells = 0;
};

/// Reads the solution of a zone: the first at the vertices, and the first in the cells. `elements` are, for
/// each kind of cells, its element numbers in the zone; rows are ordered by kind, then in the order of these.
/// Throws InputError.
Field read_cgns_values(const CgnsZone& zone, std::span<const std::vector<std::int64_t>> elements);

/// Returns the names of the variables that read_cgns_values() reads, and appends their arrays. `path` is that
/// of the zone; `cells` are in its sections: if these are not as many as declared, or unknown, values in
/// cells cannot be read by ranges. Throws InputError.
Field note_cgns_values(const CgnsZone& zone, const std::string& path, std::int64_t cells,
                       CgnsContents& contents);

}  // namespace quadloop::io
