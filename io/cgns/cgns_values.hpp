#pragma once

// For io/cgns only.
#include <cstdint>
#include <span>
#include <vector>

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

}  // namespace quadloop::io
